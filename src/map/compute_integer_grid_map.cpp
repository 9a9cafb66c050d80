#include <algorithm>
#include <cmath>

#include "collective.hpp"
#include "hexfield/base/agree.hpp"
#include "hexfield/map/compute_map.hpp"
#include "hexfield/map/verify.hpp"
#include "hexfield/mesh/quality.hpp"
#include "integer_map.hpp"
#include "rounding.hpp"

namespace hexfield {
namespace {

constexpr int max_rescalings = 4;

/// What rank 0 knows of the seamless map.
struct Seamless {
  Alignments alignments;
  ConformingSpace space;
  std::vector<double> unknowns;
  double domain_volume = 0;
  double map_volume = 0;
  double hexes = 0;  // wanted
};

Seamless prepare(const TetMesh& mesh, const Features& features, const EdgeCodes& codes, const SeamlessMap& map,
                 const IgmOptions& options) {
  Seamless s;
  s.alignments = alignments_of_map(mesh, features, codes, map);
  s.space = conforming_space(mesh, cut_graph(mesh, matchings_of(map), singular_edges(codes)), s.alignments);
  s.unknowns = unknowns_of(mesh, s.space, map);
  s.map_volume = parametric_volume(map);
  s.domain_volume = total_volume(mesh);
  s.hexes = options.edge_length > 0 ? s.domain_volume / std::pow(options.edge_length, 3) : options.target_hexes;
  return s;
}

struct Rounded {
  double scale = 1;
  std::vector<double> integers;
  double hexes = 0;  // volume of the map that follows the rounding linearly
  std::vector<Mat3> frames = {};
};

Mat3 edges_of(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  Mat3 edges;
  edges << b - a, c - a, d - a;
  return edges;
}

// Combed frames whose inverses are the Jacobians of the map, stretched tet by tet.
std::vector<Mat3> stretched_frames(const TetMesh& mesh, const CutGraph& cut, const SeamlessMap& map,
                                   const std::vector<Vec3>& stretches) {
  std::vector<Mat3> frames;
  for (std::size_t t = 0; t < stretches.size(); ++t) {
    const auto& f = map.uvw[t];
    const auto& v = mesh.vertices(TetId(t));
    const Mat3 image = stretches[t].asDiagonal() * edges_of(f[0], f[1], f[2], f[3]);
    const Mat3 domain = edges_of(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3]));
    frames.push_back(domain * image.inverse() * octahedral::matrix(cut.gauges[t]));
  }
  return frames;
}

std::vector<double> scaled(const std::vector<double>& y, double scale) {
  std::vector<double> result = y;
  for (double& value : result) value *= scale;
  return result;
}

std::optional<Rounded> round_at(const TetMesh& mesh, const Seamless& s, double scale) {
  std::vector<double> y = scaled(s.unknowns, scale);
  const double edge = std::cbrt(s.domain_volume / s.map_volume) / scale;
  const auto reals = static_cast<Eigen::Index>(s.space.num_reals);
  const auto integers = static_cast<Eigen::Index>(s.space.num_integers);
  const RoundingCost cost = rounding_cost(mesh, s.space, y, edge);
  const Eigen::VectorXd w0 = Eigen::Map<const Eigen::VectorXd>(y.data() + reals, integers);
  const auto w = round_integers(cost, w0, required_spacings(mesh, s.space, s.alignments, y));
  if (!w) return std::nullopt;
  Eigen::Map<Eigen::VectorXd>(y.data(), reals) += cost.following * (*w - w0);
  Eigen::Map<Eigen::VectorXd>(y.data() + reals, integers) = *w;
  Rounded rounded;
  rounded.scale = scale;
  rounded.integers.assign(w->begin(), w->end());
  rounded.hexes = parametric_volume(to_corner_map(s.space, coordinates(s.space, y)));
  return rounded;
}

// The rounding whose number of hexes is closest to the wanted one, over a few scales from `scale` on.
std::optional<Rounded> round_near(const TetMesh& mesh, const Seamless& s, double scale) {
  std::optional<Rounded> best;
  auto miss = [&](const Rounded& r) { return r.hexes > 0 ? std::abs(std::log(r.hexes / s.hexes)) : 1e300; };
  for (int k = 0; k < max_rescalings; ++k) {
    const std::optional<Rounded> rounded = round_at(mesh, s, scale);
    if (rounded && (!best || miss(*rounded) < miss(*best) - 1e-9)) best = rounded;
    if (rounded && miss(*rounded) < 0.1) return best;
    if (!rounded) {
      if (best) return best;
      scale *= 1.15;
    } else {
      scale *= std::clamp(rounded->hexes > 0 ? std::cbrt(s.hexes / rounded->hexes) : 1.15, 0.7, 1.3);
    }
  }
  return best;
}

// Where the shortest length is that the integers must keep.
std::vector<Vec3> tightest_place(const TetMesh& mesh, const Seamless& s) {
  const std::vector<Spacing> spacings = required_spacings(mesh, s.space, s.alignments, s.unknowns);
  const auto shortest = std::min_element(spacings.begin(), spacings.end(),
                                         [](const Spacing& a, const Spacing& b) { return a.length < b.length; });
  if (shortest == spacings.end()) return {};
  return {mesh.point(shortest->where)};
}

std::string reason_of(const IntegerOutcome& outcome, const MapReport& report) {
  if (!outcome.reached) return "The chosen integer coordinates cannot be reached without inverting a tet.";
  if (!report.inverted.empty()) return "The integer-grid map has inverted tets.";
  if (!report.wrong_edges.empty()) return "The integer-grid map has edges of the wrong image angle.";
  return "The integer-grid map is not aligned.";
}

class Stage {
 public:
  Stage(MPI_Comm comm, const TetMesh& mesh, const Features& features, const EdgeCodes& codes, const Control& control)
      : comm_(comm), mesh_(mesh), features_(features), codes_(codes), control_(control), monitor_(control, "igm") {}

  IgmResult run(const SeamlessMap& map, const IgmOptions& options) {
    choose_integers_ = options.choose_integers;
    tries_ = options.tries;
    map_ = &map;
    agree(comm_, [&] {
      if (root()) seamless_ = prepare(mesh_, features_, codes_, map, options);
    });
    const MapProblem problem(comm_, mesh_, seamless_.space);
    if (!resume(problem)) round_and_solve(problem);
    result_.newton_steps = monitor_.newton_steps();
    result_.linear_iterations = monitor_.linear_iterations();
    result_.solves = monitor_.solves();
    return std::move(result_);
  }

 private:
  bool root() const { return rank_of(comm_) == 0; }

  // Goes on with the integers of an interrupted run; false when there is none or it fails.
  bool resume(const MapProblem& problem) {
    if (!control_.restore_iterate) return false;
    const std::optional<std::vector<double>> row = control_.restore_iterate("igm");
    std::optional<IntegerGoal> goal;
    if (root() && row) goal = unpack_goal(*row, seamless_.space);
    bool found = goal.has_value();
    broadcast(comm_, found);
    if (!found) return false;
    result_.quantization_valid = true;
    return try_goal(problem, goal ? *goal : IntegerGoal());
  }

  void round_and_solve(const MapProblem& problem) {
    double scale = root() ? std::cbrt(seamless_.hexes / seamless_.map_volume) : 0;
    for (int attempt = 0; attempt < tries_; ++attempt, scale *= 1.12) {
      bool found = false;
      Rounded rounded;
      agree(comm_, [&] {
        if (!root()) return;
        const std::optional<Rounded> best = choose(scale);
        found = best.has_value();
        if (!found) result_.where = tightest_place(mesh_, seamless_);
        if (best) rounded = *best;
        scale = std::max(scale, rounded.scale);
      });
      broadcast(comm_, found);
      if (!found) {
        if (!result_.quantization_valid)
          result_.reason = "No integers were found that keep all features and singular arcs apart.";
        continue;
      }
      result_.quantization_valid = true;
      if (try_integers(problem, rounded)) break;
    }
  }

  std::optional<Rounded> choose(double scale) const {
    if (!choose_integers_) return round_near(mesh_, seamless_, scale);
    const auto choice = choose_integers_(seamless_.space, seamless_.map_volume * std::pow(scale, 3));
    if (!choice) return std::nullopt;
    return Rounded{choice->scale, choice->integers, choice->hexes,
                   stretched_frames(mesh_, seamless_.space.cut, *map_, choice->stretches)};
  }

  bool try_integers(const MapProblem& problem, Rounded& rounded) {
    IntegerGoal goal;
    goal.integers = rounded.integers;
    goal.frames = std::move(rounded.frames);
    if (root()) {
      goal.start = scaled(seamless_.unknowns, rounded.scale);
      goal.edge = std::cbrt(seamless_.domain_volume / seamless_.map_volume) / rounded.scale;
    }
    return try_goal(problem, std::move(goal));
  }

  bool try_goal(const MapProblem& problem, IntegerGoal goal) {
    broadcast(comm_, goal.integers);
    broadcast(comm_, goal.edge);
    broadcast(comm_, goal.first_phase);
    IntegerOutcome outcome = reach_integers(problem, goal, monitor_);
    agree(comm_, [&] {
      if (root()) judge(outcome);
    });
    broadcast(comm_, result_.report);
    monitor_.note_defects(result_.report);
    broadcast(comm_, result_.reason);
    broadcast(comm_, result_.where);
    return result_.reason.empty();
  }

  void judge(IntegerOutcome& outcome) {
    quantize_to_dyadic_grid(seamless_.space, outcome.unknowns);
    result_.map = to_corner_map(seamless_.space, coordinates(seamless_.space, outcome.unknowns));
    result_.report = verify_map(mesh_, features_, codes_, result_.map);
    result_.where.clear();
    result_.reason.clear();
    for (TetId t : result_.report.inverted) result_.where.push_back(centroid(mesh_, t));
    for (const EdgeKey& e : result_.report.wrong_edges)
      result_.where.push_back(0.5 * (mesh_.point(e[0]) + mesh_.point(e[1])));
    if (!outcome.reached || !result_.report.valid()) {
      result_.reason = reason_of(outcome, result_.report);
      return;
    }
    const auto violations = check_integer_grid(mesh_, features_, codes_, result_.map);
    if (violations.empty()) return;
    result_.reason = violations[0].sentence;
    result_.where = violations[0].places;
  }

  MPI_Comm comm_;
  const TetMesh& mesh_;
  const Features& features_;
  const EdgeCodes& codes_;
  const Control& control_;
  SolveMonitor monitor_;
  std::function<std::optional<IntegerChoice>(const ConformingSpace&, double)> choose_integers_;
  int tries_ = 1;
  const SeamlessMap* map_ = nullptr;
  Seamless seamless_;
  IgmResult result_;
};

}  // namespace

IgmResult compute_integer_grid_map(MPI_Comm comm, const TetMesh& mesh, const Features& features, const EdgeCodes& codes,
                                   const SeamlessMap& seamless, const IgmOptions& options, const Control& control) {
  return Stage(comm, mesh, features, codes, control).run(seamless, options);
}

}  // namespace hexfield
