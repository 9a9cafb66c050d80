#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "hexfield/base/error.hpp"
#include "hexfield/base/stopwatch.hpp"
#include "hexfield/io/checkpoint_values.hpp"
#include "hexfield/map/refine_map.hpp"
#include "hexfield/map/verify.hpp"
#include "hexfield/quantize/exact_seamless.hpp"
#include "stages.hpp"

namespace hexfield {
namespace {

std::string name_of(QuantizeMethod method) {
  switch (method) {
    case QuantizeMethod::pump:
      return "pump";
    case QuantizeMethod::ilp:
      return "ilp";
    case QuantizeMethod::positive:
      return "positive";
  }
  return "";
}

ConformingSpace space_of(const RunState& state) {
  const FieldResult& f = state.field;
  const SeamlessMap& map = state.seamless.map;
  return conforming_space(f.mesh, cut_graph(f.mesh, matchings_of(map), singular_edges(f.codes)),
                          alignments_of_map(f.mesh, f.features, f.codes, map));
}

[[noreturn]] void refuse(const ExactSeamless& exact) {
  const Violation& first = exact.violations.front();
  throw Error(ExitCode::no_integer_grid_map,
              fmt::format("The seamless map cannot be made exact: {}: {} ({} in all).", name(exact.failure),
                          first.sentence, exact.violations.size()),
              first.ids, first.places);
}

/// What a better map may mend: tets that are thin, not a map that is none.
bool worth_relaxing(ExactFailure failure) {
  return failure == ExactFailure::inverted_output || failure == ExactFailure::contradiction;
}

/// Rank 0. False where the map optimiser is to have another try: only when `may_fail`.
bool make_exact(RunState& state, bool may_fail) {
  const Clock::time_point start = Clock::now();
  const FieldResult& f = state.field;
  ExactSeamless exact = make_exactly_seamless(f.mesh, f.features, state.seamless.map);
  if (may_fail && worth_relaxing(exact.failure)) {
    state.quantization.notes.push_back(fmt::format(
        "The seamless map could not be made exact ({}): it was relaxed with a higher barrier.", name(exact.failure)));
    return false;
  }
  if (exact.failure != ExactFailure::none) refuse(exact);
  require(exact.codes == f.codes, "The exact map has other singular edges than the field.");
  state.seamless.map = std::move(exact.map);
  state.quantization.largest_move = exact.largest_move;
  state.quantization.seconds["exact"] += seconds_since(start);
  return true;
}

/// With one more try after the optimiser of the map. Collective.
void make_exact_or_relax(RunState& state, const Control& control) {
  int exact = 0;
  state.team.on_root([&] { exact = make_exact(state, true) ? 1 : 0; });
  MPI_Bcast(&exact, 1, MPI_INT, 0, state.team.comm());
  if (exact != 0) return;
  state.team.together([&] {
    const FieldResult& f = state.field;
    state.seamless = relax_seamless_map(state.team.comm(), f.mesh, f.features, f.codes, state.seamless.map, control);
  });
  state.team.on_root([&] { make_exact(state, false); });
}

const MapQuantizer& quantizer_of(RunState& state) {
  if (!state.quantizer) {
    const Clock::time_point start = Clock::now();
    const FieldResult& f = state.field;
    state.quantizer.emplace(f.mesh, f.features, f.codes, state.seamless.map);
    state.quantization.seconds["complex"] = seconds_since(start);
  }
  return *state.quantizer;
}

/// A chord over this angle of a circle is 2 % shorter than the arc.
constexpr double max_turning_of_edge = 40 * std::numbers::pi / 180;

/// Hex edges that a curved feature needs to keep its shape; none in coarse layouts of blocks, which are not to be.
std::vector<std::int64_t> edges_for_curvature(const BlockComplex& complex, double hexes) {
  std::vector<std::int64_t> least(complex.arcs.size(), 0);
  if (hexes <= 1) return least;
  for (std::size_t a = 0; a < least.size(); ++a)
    if (complex.arcs[a].feature)
      least[a] = static_cast<std::int64_t>(std::ceil(complex.arcs[a].turning / max_turning_of_edge - 0.01));
  return least;
}

/// Integers for about this number of hexes. Rank 0.
void quantize(RunState& state, const ConformingSpace& space, double hexes) {
  QuantizeOptions options;
  options.method = state.options.quantizer == "ilp" ? QuantizeMethod::ilp : QuantizeMethod::pump;
  options.target_hexes = hexes;
  options.min_layers = state.options.min_layers;
  options.time_limit = state.options.ilp_time_limit;
  const MapQuantizer& quantizer = quantizer_of(state);
  const Clock::time_point start = Clock::now();
  QuantizeResult& result = state.quantization;
  const BlockComplex& complex = quantizer.complex();
  options.least = edges_for_curvature(complex, hexes);
  result.integers = quantize_complex(complex, options);
  result.kind = name_of(result.integers.method);
  if (result.integers.method != options.method)
    result.notes.push_back(
        fmt::format("{} found no integers: every arc is at least 1 instead.", state.options.quantizer));
  result.unknowns = quantizer.integer_unknowns(space, result.integers.lengths);
  result.stretches = quantizer.stretches(result.integers.lengths);
  result.wanted.clear();
  for (std::size_t a = 0; a < complex.arcs.size(); ++a)
    result.wanted.push_back(result.integers.scale * complex.length(a));
  result.nodes = static_cast<std::int64_t>(complex.nodes.size());
  result.arcs = static_cast<std::int64_t>(complex.arcs.size());
  result.patches = static_cast<std::int64_t>(complex.patches.size());
  result.blocks = static_cast<std::int64_t>(complex.blocks.size());
  result.euler = complex.euler();
  result.picture = picture_of(complex, result.integers.lengths);
  result.seconds["integers"] = seconds_since(start);
}

bool valid(const IgmResult& igm) { return igm.report.valid() && igm.quantization_valid; }

/// Stage 6 with integers of the quantizer: where tets block the way to them the mesh gets more vertices there; where
/// that does not help, integers for more hexes. All collective.
class IgmStage {
 public:
  IgmStage(RunState& state, const IgmOptions& options, const Control& control)
      : state_(state), options_(options), control_(control) {}

  void run() {
    int quantized = state_.quantization.kind == "rounding" ? 0 : 1;
    MPI_Bcast(&quantized, 1, MPI_INT, 0, state_.team.comm());
    if (quantized != 0) {
      if (reach()) return;
      if (state_.options.fallback != "rounding") return;
      note(fmt::format("{} Rounding instead, as asked.", state_.igm.reason));
      state_.quantization.kind = "rounding";
    }
    solve(options_);
  }

 private:
  static constexpr int max_targets = 3;
  static constexpr double more_hexes = 1.4;
  static constexpr int max_refinements = 3;
  /// Of all solves together, after which nothing else is tried: a valid map takes a tenth of them.
  static constexpr int max_newton_steps = 1000;

  bool root() const { return state_.team.is_root(); }
  bool spent() const { return state_.igm.newton_steps > max_newton_steps; }
  void note(std::string sentence) {
    if (!root() || sentence.empty()) return;
    state_.log.info(sentence);
    state_.quantization.notes.push_back(std::move(sentence));
  }

  bool solve(const IgmOptions& options) {
    const FieldResult& f = state_.field;
    IgmResult result = compute_integer_grid_map(state_.team.comm(), f.mesh, f.features, f.codes, state_.seamless.map,
                                                options, control_);
    result.newton_steps += state_.igm.newton_steps;
    result.linear_iterations += state_.igm.linear_iterations;
    result.solves.insert(result.solves.begin(), state_.igm.solves.begin(), state_.igm.solves.end());
    state_.igm = std::move(result);
    return valid(state_.igm);
  }

  bool reach() {
    double hexes = options_.target_hexes;
    for (int target = 0; target < max_targets && !spent(); ++target, hexes *= more_hexes) {
      if (target > 0) state_.team.on_root([&] { other_integers(hexes); });
      if (reach_with_refinement()) return true;
    }
    return false;
  }

  bool reach_with_refinement() {
    IgmOptions options = options_;
    options.tries = 1;
    options.choose_integers = [this](const ConformingSpace& space, double) {
      const QuantizeResult& q = state_.quantization;
      require(q.unknowns.size() == space.num_integers, "The quantization belongs to another map.");
      // The start has the volume of the goal: where few hexes are wanted the integers hold many more.
      const auto hexes = static_cast<double>(q.integers.hexes);
      return IntegerChoice{std::cbrt(hexes / parametric_volume(state_.seamless.map)), q.unknowns, hexes, q.stretches};
    };
    for (int round = 0;; ++round) {
      if (solve(options)) return true;
      if (round == max_refinements || spent() || state_.igm.report.inverted.empty()) break;
      state_.team.on_root([&] { refine(); });
    }
    if (root()) note(spacing_near(state_.quantization, state_.igm.where));
    return false;
  }

  // The integers are taken over through the map of the old mesh that has them.
  void refine() {
    FieldResult& f = state_.field;
    QuantizeResult& q = state_.quantization;
    const ConformingSpace before = space_of(state_);
    std::vector<double> y = unknowns_of(f.mesh, before, state_.seamless.map);
    std::copy(q.unknowns.begin(), q.unknowns.end(), y.begin() + static_cast<std::ptrdiff_t>(before.num_reals));
    CornerMap goal = to_corner_map(before, coordinates(before, y));
    for (std::size_t t = 0; t < goal.uvw.size(); ++t)
      for (Vec3& p : goal.uvw[t]) p = octahedral::apply(before.cut.gauges[t], p);
    goal.rotations = state_.seamless.map.rotations;
    const std::size_t blocking = state_.igm.report.inverted.size();
    // Parts of a tet are to grow as it was.
    CornerMap growth{{}, goal.rotations};
    for (const Vec3& s : q.stretches) growth.uvw.push_back({s, s, s, s});
    const std::vector<CornerMap*> maps = {&state_.seamless.map, &goal, &growth};
    // Bridges first, everywhere: near one that blocks now there is one that blocks next.
    int splits = state_.refined ? 0 : split_bridges(f, maps);
    if (splits == 0) splits = refine_at_blocking_tets(f, maps, state_.igm.report.inverted);
    const ConformingSpace after = space_of(state_);
    y = unknowns_of(f.mesh, after, goal);
    q.unknowns.assign(y.begin() + static_cast<std::ptrdiff_t>(after.num_reals), y.end());
    for (double& x : q.unknowns) {
      require(std::abs(x - std::nearbyint(x)) < 1e-3, "A refined map has other integers.");
      x = std::nearbyint(x);
    }
    q.stretches.clear();
    for (const auto& corners : growth.uvw) q.stretches.push_back(corners[0]);
    state_.refined = true;
    state_.quantizer.reset();
    note(fmt::format("{} tets block the way to the integers for {} hexes: {} edges are split.", blocking,
                     q.integers.hexes, splits));
  }

  void other_integers(double hexes) {
    note(fmt::format("The integers for {} hexes cannot be reached: {:.0f} hexes are tried.",
                     state_.quantization.integers.hexes, hexes));
    if (state_.refined) make_exact(state_, false);
    quantize(state_, space_of(state_), hexes);
  }

  RunState& state_;
  const IgmOptions& options_;
  const Control& control_;
};

}  // namespace

Stage quantize_stage() {
  Stage stage;
  stage.name = "quantize";
  stage.compute = [](RunState& state, const std::string& basis, Progress& progress) {
    const double hexes = wanted_hexes(state);
    state.quantizer.reset();
    state.quantization = {};
    progress.report("making the seamless map exact", -1);
    make_exact_or_relax(state, state.safe_points.control(basis, progress));
    state.team.on_root([&] {
      if (state.options.quantizer == "rounding") return;
      progress.report("motorcycle complex and integers", -1);
      quantize(state, space_of(state), hexes);
    });
  };
  stage.pack = [](const RunState& state) { return joined(pack(state.seamless), pack(state.quantization)); };
  stage.unpack = [](RunState& state, const NamedArrays& arrays) {
    state.seamless = unpack_seamless(arrays, state.field.mesh.num_tets());
    state.quantization = unpack_quantize(arrays);
    state.quantizer.reset();
  };
  stage.judge = judge_quantization;
  stage.check = [](const RunState& state) {
    const FieldResult& f = state.field;
    return check_exactly_seamless(f.mesh, f.features, f.codes, state.seamless.map);
  };
  return stage;
}

Stage igm_stage() {
  Stage stage;
  stage.name = "igm";
  stage.compute = [](RunState& state, const std::string& basis, Progress& progress) {
    IgmOptions options = state.options.igm;
    options.target_hexes = wanted_hexes(state);
    options.edge_length = state.options.edge_length;
    const Control control = state.safe_points.control(basis, progress);
    state.igm = {};
    state.team.together([&] { IgmStage(state, options, control).run(); });
    state.seamless.map = {};
    state.quantizer.reset();
  };
  stage.pack = [](const RunState& state) {
    NamedArrays arrays = joined(pack(state.igm), pack(state.quantization));
    return state.refined ? joined(std::move(arrays), pack(state.field)) : arrays;
  };
  stage.unpack = [](RunState& state, const NamedArrays& arrays) {
    state.refined = arrays.contains("points");
    if (state.refined) state.field = unpack_field(arrays);
    state.igm = unpack_igm(arrays, state.field.mesh.num_tets());
    state.quantization = unpack_quantize(arrays);
    state.seamless.map = {};
  };
  stage.judge = judge_igm;
  stage.check = [](const RunState& state) {
    const FieldResult& f = state.field;
    return valid(state.igm) ? check_integer_grid(f.mesh, f.features, f.codes, state.igm.map) : std::vector<Violation>();
  };
  stage.iterations = [](const RunState& state) { return state.igm.newton_steps; };
  return stage;
}

}  // namespace hexfield
