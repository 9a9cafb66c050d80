#include "hexfield/quantize/quantization.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "path_objective.hpp"
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

// The program of the options, with the static constraints.
Program make_program(const BlockComplex& complex, const BundleSystem& system, const CriticalSet& critical, double scale,
                     const QuantizeOptions& options) {
  Program program{system, system.size, std::vector<std::int64_t>(system.num_bundles(), 0), {}, {}};
  for (std::size_t a = 0; a < options.least.size(); ++a) {
    auto& least = program.least[static_cast<std::size_t>(system.bundle[a])];
    least = std::max(least, options.least[a]);
  }
  if (options.objective == QuantizeObjective::arcs) return program;
  for (double& weight : program.weights) weight *= options.arc_share / static_cast<double>(complex.arcs.size());
  for (const ObjectivePath& path : objective_paths(complex, critical))
    for (const ArcSum& along : path.along) {
      Program::Square square{system.on_bundles(along), (1 - options.arc_share) * path.weight, 0};
      if (square.sum.empty() || square.weight == 0) continue;
      for (const auto& [a, c] : along) square.target += c * scale * complex.length(static_cast<std::size_t>(a));
      program.squares.push_back(std::move(square));
    }
  return program;
}

class Quantizer {
 public:
  Quantizer(const BlockComplex& complex, const QuantizeOptions& options)
      : complex_(complex),
        options_(options),
        scale_(std::cbrt(options.target_hexes / real_volume(complex))),
        critical_(critical_set(complex)),
        system_(bundle_system(complex, scale_)),
        program_(make_program(complex, system_, critical_, scale_, options)),
        search_(complex, critical_) {}

  Quantization run() {
    bool found = false;
    if (options_.method != QuantizeMethod::positive) {
      for (const ArcSum& s : critical_.statics) add_row(s);
      found = options_.method == QuantizeMethod::pump ? by_pump() : by_ilp();
    }
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
    program_.rows.push_back({std::move(row), options_.min_layers});
    return true;
  }

  // Searches coincidences of x_; false when there are none that are new.
  bool separate() {
    bool fresh = false;
    ++result_.rounds;
    clean_ = true;
    for (const Separation& s : search_.run(system_.on_arcs(x_), options_.min_layers)) {
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

  // What the pump finds; where it finds nothing, a rough integer program's.
  bool pump(SheetPump& sheets) {
    auto solved = sheets.solve();
    if (!solved) solved = solve_ilp(program_, 0.05, options_.time_limit);
    if (!solved) return false;
    x_ = solved->x;
    result_.proven_optimal = solved->proven;
    result_.sheets = sheets.pumped();
    return true;
  }

  bool by_pump() {
    SheetPump sheets(program_);
    for (int round = 0; round < max_rounds; ++round) {
      if (!pump(sheets)) return false;
      if (separate()) continue;
      result_.method = QuantizeMethod::pump;
      return clean_;
    }
    return false;
  }

  void by_positive() {
    for (auto& least : program_.least) least = std::max<std::int64_t>(least, options_.min_layers);
    program_.rows.clear();
    SheetPump sheets(program_);
    if (!pump(sheets))
      throw Error(ExitCode::no_integer_grid_map,
                  "No positive integer lengths satisfy the patches of the motorcycle complex.");
    result_.method = QuantizeMethod::positive;
  }

  const BlockComplex& complex_;
  const QuantizeOptions& options_;
  double scale_;
  CriticalSet critical_;
  BundleSystem system_;
  Program program_;
  SeparationSearch search_;
  std::set<ArcSum> known_;
  std::vector<std::int64_t> x_;
  bool clean_ = false;
  Quantization result_;
};

void check_options(const BlockComplex& complex, const QuantizeOptions& options) {
  const auto demand = [](bool good, const char* what) {
    if (!good) throw Error(ExitCode::usage, what);
  };
  demand(options.target_hexes > 0 && std::isfinite(options.target_hexes), "The number of hexes must be positive.");
  demand(options.min_layers >= 1, "The least number of layers must be at least 1.");
  demand(options.arc_share > 0 && options.arc_share <= 1, "The share of the arcs must be above 0 and at most 1.");
  demand(options.least.empty() || options.least.size() == complex.arcs.size(),
         "There must be one least length per arc, or none.");
  for (std::int64_t least : options.least) demand(least >= 0, "A least length of an arc cannot be negative.");
}

}  // namespace

Quantization quantize_complex(const BlockComplex& complex, const QuantizeOptions& options) {
  check_options(complex, options);
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

std::vector<Violation> check(const BlockComplex& complex, const std::vector<std::int64_t>& lengths, int min_layers) {
  std::vector<Violation> found;
  for (std::size_t p = 0; p < complex.patches.size(); ++p)
    for (std::size_t k = 0; k < 3; ++k) {
      ArcSum terms;
      for (std::int32_t a : complex.patches[p].sides[2 * k]) terms.emplace_back(a, 1);
      for (std::int32_t a : complex.patches[p].sides[2 * k + 1]) terms.emplace_back(a, -1);
      if (value_of(terms, lengths) != 0)
        found.push_back(
            {fmt::format("Patch {}: opposite sides have different integer lengths.", p),
             {static_cast<std::int64_t>(p)},
             {complex.nodes[static_cast<std::size_t>(complex.arcs[static_cast<std::size_t>(terms[0].first)].nodes[0])]
                  .place}});
    }
  if (!found.empty()) return found;
  const CriticalSet critical = critical_set(complex);
  for (const ArcSum& s : critical.statics)
    if (value_of(s, lengths) < min_layers)
      found.push_back(
          {"A feature, singular arc or boundary region has too few layers.",
           {s[0].first},
           {complex.nodes[static_cast<std::size_t>(complex.arcs[static_cast<std::size_t>(s[0].first)].nodes[0])]
                .place}});
  SeparationSearch search(complex, critical);
  for (const Separation& s : search.run(lengths, min_layers))
    found.push_back(
        {fmt::format("Node {}: two critical entities fall onto each other, or have too few layers between them.",
                     s.node),
         {s.node},
         {complex.nodes[static_cast<std::size_t>(s.node)].place}});
  return found;
}

}  // namespace hexfield
