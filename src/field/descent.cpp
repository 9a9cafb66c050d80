#include "descent.hpp"

#include <cmath>

#include "hexfield/base/parallel.hpp"

namespace hexfield {
namespace {

constexpr std::size_t remembered = 8;
constexpr double stiffness = 20.0 / 3;  // of a frame against turns
constexpr double enough = 1e-4;         // share of the predicted decrease that a step must reach

NodeSpaces<3, 1> spaces_of(const std::vector<NodeConstraint>& constraints) {
  return NodeSpaces<3, 1>(constraints, [](const NodeConstraint& c) { return c.direction; });
}

// a += factor b, on the owned nodes
void add(std::vector<double>& a, double factor, const std::vector<double>& b, std::size_t n) {
  parallel_for(n, 8192, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) a[k] += factor * b[k];
  });
}

}  // namespace

Descent::Descent(const Hierarchy& hierarchy, const std::vector<NodeConstraint>& constraints,
                 const std::vector<NodeConstraint>& root_constraints, double max_turn, NodeFrames frames)
    : hierarchy_(hierarchy),
      constraints_(constraints),
      spaces_(spaces_of(constraints)),
      multigrid_(hierarchy, spaces_, spaces_of(root_constraints)),
      max_turn_(max_turn),
      frames_(std::move(frames)),
      gradient_(3 * hierarchy.graph().local(), 0.0),
      direction_(gradient_.size(), 0.0) {
  energy_ = energy_and_gradient(hierarchy.graph(), constraints_, frames_, gradient_);
}

// The two loops of the method: direction = -(approximate inverse Hessian) gradient.
void Descent::direct() {
  const NodeGraph& graph = hierarchy_.graph();
  const std::size_t n = 3 * graph.owned();
  std::vector<double> q = gradient_;
  std::vector<double> shares(history_.size());
  for (std::size_t k = history_.size(); k-- > 0;) {
    shares[k] = dot(graph, 3, history_[k].turn, q) / history_[k].curvature;
    add(q, -shares[k], history_[k].change, n);
  }
  multigrid_.cycle(q, direction_);
  for (std::size_t k = 0; k < n; ++k) direction_[k] /= stiffness;
  for (std::size_t k = 0; k < history_.size(); ++k) {
    const double share = shares[k] - dot(graph, 3, history_[k].change, direction_) / history_[k].curvature;
    add(direction_, share, history_[k].turn, n);
  }
  for (std::size_t k = 0; k < n; ++k) direction_[k] = -direction_[k];
}

void Descent::limit_turns() {
  for (std::size_t i = 0; i < hierarchy_.graph().owned(); ++i) {
    Eigen::Map<Vec3> d(direction_.data() + 3 * i);
    const double angle = d.norm();
    if (angle > max_turn_) d *= max_turn_ / angle;
  }
}

bool Descent::search(double longest) {
  const NodeGraph& graph = hierarchy_.graph();
  const double slope = dot(graph, 3, gradient_, direction_);
  if (!(slope < 0)) return false;
  std::vector<double> gradient(gradient_.size(), 0.0);
  double t = longest;
  for (int tries = 0; tries < 12; ++tries) {
    NodeFrames next = turned(graph, frames_, direction_, t);
    const double energy = energy_and_gradient(graph, constraints_, next, gradient);
    if (energy <= energy_ + enough * t * slope) {
      Pair pair{direction_, gradient, 0};
      for (double& v : pair.turn) v *= t;
      add(pair.change, -1, gradient_, 3 * graph.owned());
      pair.curvature = dot(graph, 3, pair.turn, pair.change);
      const double size = dot(graph, 3, pair.change, pair.change) * dot(graph, 3, pair.turn, pair.turn);
      if (pair.curvature > 1e-6 * std::sqrt(size)) history_.push_back(std::move(pair));
      if (history_.size() > remembered) history_.pop_front();
      frames_ = std::move(next);
      gradient_.swap(gradient);
      energy_ = energy;
      return true;
    }
    // The parabola through both energies and the slope, kept between a tenth and a half.
    const double lowest = -slope * t * t / (2 * (energy - energy_ - slope * t));
    t = std::isfinite(lowest) ? std::min(0.5 * t, std::max(0.1 * t, lowest)) : 0.5 * t;
  }
  return false;
}

bool Descent::step() {
  direct();
  limit_turns();
  if (search(1)) return true;
  if (history_.empty()) return false;
  history_.clear();
  direct();
  limit_turns();
  return search(1);
}

}  // namespace hexfield
