#include "hexfield/quantize/quantization.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "programs.hpp"
#include "separation.hpp"

namespace hexfield {

using namespace quantize;

namespace {

constexpr int max_rounds = 100;

double real_volume(const BlockComplex& complex) {
  double sum = 0;
  for (const auto& block : complex.blocks) {
    double volume = 1;
    for (std::size_t k = 0; k < 3; ++k)
      volume *= std::ldexp(static_cast<double>(block.high[k] - block.low[k]), -complex.grid_exponent);
    sum += volume;
  }
  return sum;
}

class Quantizer {
 public:
  Quantizer(const BlockComplex& complex, const QuantizeOptions& options)
      : complex_(complex),
        options_(options),
        scale_(std::cbrt(options.target_hexes / real_volume(complex))),
        critical_(critical_set(complex)),
        system_(bundle_system(complex, scale_)),
        program_{system_, {}, options.method == QuantizeMethod::positive ? 1 : 0, options.min_layers} {
    for (const ArcSum& s : critical_.statics) add_row(s);
  }

  Quantization run() {
    bool found = false;
    if (options_.method == QuantizeMethod::pump) found = by_pump();
    if (options_.method == QuantizeMethod::ilp) found = by_ilp();
    if (!found) by_positive();
    result_.scale = scale_;
    result_.objective = program_.objective(x_);
    result_.lengths = system_.on_arcs(x_);
    result_.hexes = count_hexes(complex_, result_.lengths);
    return std::move(result_);
  }

 private:
  bool add_row(const ArcSum& arcs) {
    ArcSum row = system_.on_bundles(arcs);
    if (row.empty() || !known_.insert(row).second) return false;
    program_.rows.push_back(std::move(row));
    return true;
  }

  // Searches coincidences of x_; false when there are none that are new.
  bool separate() {
    SeparationSearch search(complex_, critical_);
    bool fresh = false;
    ++result_.rounds;
    clean_ = true;
    for (const Separation& s : search.run(system_.on_arcs(x_))) {
      clean_ = false;
      const bool added = add_row(s.cut);
      fresh = fresh || added;
      result_.separations += added;
    }
    return fresh;
  }

  bool by_ilp() {
    double gap = 0.05;
    for (int round = 0; round < max_rounds; ++round) {
      const auto solved = solve_ilp(program_, gap, options_.time_limit);
      if (!solved) return false;
      x_ = solved->x;
      result_.proven_optimal = solved->proven;
      if (separate()) continue;
      if (!clean_) return false;
      if (gap < 1e-3) {
        result_.method = QuantizeMethod::ilp;
        return true;
      }
      gap = 1e-6;
    }
    return false;
  }

  bool by_pump() {
    x_.assign(system_.num_bundles(), 0);
    bool thorough = false;
    for (int round = 0; round < max_rounds; ++round) {
      SheetPump pump(program_);
      if (!program_.violated(x_).empty() && !pump.repair(x_)) {
        const auto solved = solve_ilp(program_, 0.5, options_.time_limit);
        if (!solved) return false;
        x_ = solved->x;
      }
      pump.descend(x_, thorough);
      result_.sheets += pump.pumped();
      if (separate()) {
        thorough = false;
        continue;
      }
      if (!clean_) return false;
      if (thorough) {
        result_.method = QuantizeMethod::pump;
        return true;
      }
      thorough = true;
    }
    return false;
  }

  void by_positive() {
    program_.lower = 1;
    program_.rows.clear();
    known_.clear();
    for (const ArcSum& s : critical_.statics) add_row(s);
    const auto solved = solve_ilp(program_, 1e-4, options_.time_limit);
    if (!solved)
      throw Error(ExitCode::no_integer_grid_map,
                  "No integer lengths of at least 1 satisfy the patches of the motorcycle complex.");
    x_ = solved->x;
    result_.method = QuantizeMethod::positive;
    result_.proven_optimal = solved->proven;
  }

  const BlockComplex& complex_;
  const QuantizeOptions& options_;
  double scale_;
  CriticalSet critical_;
  BundleSystem system_;
  Program program_;
  std::set<ArcSum> known_;
  std::vector<std::int64_t> x_;
  bool clean_ = false;
  Quantization result_;
};

}  // namespace

Quantization quantize_complex(const BlockComplex& complex, const QuantizeOptions& options) {
  return Quantizer(complex, options).run();
}

std::int64_t count_hexes(const BlockComplex& complex, const std::vector<std::int64_t>& lengths) {
  std::int64_t hexes = 0;
  for (const auto& block : complex.blocks) {
    std::int64_t volume = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::int64_t extent = 0;
      for (std::int32_t a : block.edges[4 * axis]) extent += lengths[static_cast<std::size_t>(a)];
      volume *= extent;
    }
    hexes += volume;
  }
  return hexes;
}

std::vector<Violation> check(const BlockComplex& complex, const std::vector<std::int64_t>& lengths) {
  std::vector<Violation> found;
  const auto sum = [&](const ArcSum& terms) {
    std::int64_t total = 0;
    for (const auto& [a, c] : terms) total += c * lengths[static_cast<std::size_t>(a)];
    return total;
  };
  for (std::size_t p = 0; p < complex.patches.size(); ++p)
    for (std::size_t k = 0; k < 3; ++k) {
      ArcSum terms;
      for (std::int32_t a : complex.patches[p].sides[2 * k]) terms.emplace_back(a, 1);
      for (std::int32_t a : complex.patches[p].sides[2 * k + 1]) terms.emplace_back(a, -1);
      if (sum(terms) != 0)
        found.push_back(
            {fmt::format("Patch {}: opposite sides have different integer lengths.", p),
             {static_cast<std::int64_t>(p)},
             {complex.nodes[static_cast<std::size_t>(complex.arcs[static_cast<std::size_t>(terms[0].first)].nodes[0])]
                  .place}});
    }
  if (!found.empty()) return found;
  const CriticalSet critical = critical_set(complex);
  for (const ArcSum& s : critical.statics)
    if (sum(s) < 1)
      found.push_back(
          {"A feature, singular arc or boundary region collapses.",
           {s[0].first},
           {complex.nodes[static_cast<std::size_t>(complex.arcs[static_cast<std::size_t>(s[0].first)].nodes[0])]
                .place}});
  SeparationSearch search(complex, critical);
  for (const Separation& s : search.run(lengths))
    found.push_back({fmt::format("Node {}: two critical entities fall onto each other.", s.node),
                     {s.node},
                     {complex.nodes[static_cast<std::size_t>(s.node)].place}});
  return found;
}

}  // namespace hexfield
