#include "rounding.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace hexfield {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Equal values of different runs may differ by rounding noise; a choice between candidates must not.
constexpr double margin = 1e-7;
constexpr int max_dives = 40;

double evaluate(const LinearForm& form, const VectorXd& w) {
  double sum = 0;
  for (const auto& [v, c] : form) sum += static_cast<double>(c) * w[v];
  return sum;
}

class Rounder {
 public:
  Rounder(const RoundingCost& cost, const VectorXd& w0, const std::vector<Spacing>& spacings)
      : s_(cost.schur),
        w0_(w0),
        spacings_(spacings),
        penalty_(1e4 * std::max(s_.diagonal().maxCoeff(), 1e-300)),
        priority_(Eigen::VectorXi::Zero(w0.size())) {}

  std::optional<VectorXd> run() {
    for (int k = 0; k < max_dives; ++k) {
      VectorXd w = w0_;
      if (!dive(w)) continue;
      improve(w);
      return w;
    }
    return std::nullopt;
  }

 private:
  double cost(const VectorXd& w) const { return (w - w0_).dot(s_ * (w - w0_)); }
  bool feasible(const VectorXd& w, double tolerance) const {
    return std::all_of(spacings_.begin(), spacings_.end(),
                       [&](const Spacing& s) { return evaluate(s.form, w) >= 1 - tolerance; });
  }

  // Minimiser over the free entries of w of the cost plus a penalty on spacings below 1 (active sets).
  void relax(VectorXd& w, const std::vector<char>& fixed) const {
    std::vector<Index> free;
    for (Index k = 0; k < w.size(); ++k)
      if (fixed[static_cast<std::size_t>(k)] == 0) free.push_back(k);
    if (free.empty()) return;
    std::vector<char> active(spacings_.size(), 0);
    for (int round = 0; round < 60; ++round) {
      MatrixXd a = s_;
      VectorXd g = s_ * (w - w0_);
      for (std::size_t i = 0; i < spacings_.size(); ++i) {
        if (active[i] == 0) continue;
        const double gap = evaluate(spacings_[i].form, w) - 1;
        for (const auto& [p, c] : spacings_[i].form) {
          g[p] += penalty_ * static_cast<double>(c) * gap;
          for (const auto& [q, d] : spacings_[i].form)
            a(p, q) += penalty_ * static_cast<double>(c) * static_cast<double>(d);
        }
      }
      MatrixXd block = a(free, free);
      block.diagonal().array() += 1e-12 * s_.diagonal().maxCoeff();
      const VectorXd step = block.ldlt().solve(g(free));
      for (std::size_t k = 0; k < free.size(); ++k) w[free[k]] -= step[static_cast<Index>(k)];
      bool changed = false;
      for (std::size_t i = 0; i < spacings_.size(); ++i) {
        const char now = evaluate(spacings_[i].form, w) < 1 - 1e-9;
        changed = changed || now != active[i];
        active[i] = now;
      }
      if (!changed) return;
    }
  }

  // Free variable to round next: those that made earlier dives fail first, then the closest to an integer.
  Index choose(const VectorXd& w, const std::vector<char>& fixed) const {
    Index next = -1;
    double best = 1;
    for (Index k = 0; k < w.size(); ++k) {
      if (fixed[static_cast<std::size_t>(k)] != 0) continue;
      const double distance = std::abs(w[k] - std::nearbyint(w[k]));
      const int lead = next < 0 ? 1 : priority_[k] - priority_[next];
      if (lead > 0 || (lead == 0 && distance < best - margin)) next = k, best = distance;
    }
    return next;
  }

  // Rounds one variable after the other; false when one fits neither way, whose rivals then gain priority.
  bool dive(VectorXd& w) {
    std::vector<char> fixed(static_cast<std::size_t>(w.size()), 0);
    relax(w, fixed);
    for (Index k = choose(w, fixed); k >= 0; k = choose(w, fixed)) {
      fixed[static_cast<std::size_t>(k)] = 1;
      const double nearest = std::floor(w[k] + 0.5 + margin);
      const double other = nearest > w[k] ? nearest - 1 : nearest + 1;
      bool fits = false;
      for (double choice : {nearest, other}) {
        VectorXd trial = w;
        trial[k] = choice;
        relax(trial, fixed);
        fits = feasible(trial, 0.01);
        if (fits) {
          w = trial;
          break;
        }
        blame(trial);
      }
      if (!fits) {
        ++priority_[k];
        return false;
      }
    }
    return feasible(w, 1e-9);
  }
  void blame(const VectorXd& w) {
    for (const Spacing& s : spacings_)
      if (evaluate(s.form, w) < 0.99)
        for (const auto& entry : s.form) ++priority_[entry.first];
  }

  bool try_step(VectorXd& w, const VectorXd& step) const {
    const VectorXd trial = w + step;
    if (cost(trial) >= cost(w) * (1 - margin) - 1e-300 || !feasible(trial, 1e-9)) return false;
    w = trial;
    return true;
  }
  void improve(VectorXd& w) const {
    const Index n = w.size();
    for (int round = 0; round < 20; ++round) {
      bool moved = false;
      for (Index i = 0; i < n; ++i)
        for (double a : {1.0, -1.0}) {
          VectorXd step = VectorXd::Zero(n);
          step[i] = a;
          moved = try_step(w, step) || moved;
          for (Index j = i + 1; j < n && n <= 100; ++j)
            for (double b : {1.0, -1.0}) {
              step[j] = b;
              moved = try_step(w, step) || moved;
              step[j] = 0;
            }
        }
      if (!moved) return;
    }
  }

  const MatrixXd& s_;
  const VectorXd& w0_;
  const std::vector<Spacing>& spacings_;
  double penalty_;
  Eigen::VectorXi priority_;
};

}  // namespace

std::optional<VectorXd> round_integers(const RoundingCost& cost, const VectorXd& w0,
                                       const std::vector<Spacing>& spacings) {
  if (w0.size() == 0) return w0;
  return Rounder(cost, w0, spacings).run();
}

}  // namespace hexfield
