#include <fmt/core.h>

#include <cmath>

#include "collective.hpp"
#include "hexfield/base/agree.hpp"
#include "hexfield/base/stopwatch.hpp"
#include "hexfield/field/constraints.hpp"
#include "hexfield/map/compute_map.hpp"
#include "hexfield/map/integrable_frames.hpp"
#include "hexfield/map/verify.hpp"
#include "map_problem.hpp"
#include "solve_monitor.hpp"
#include "untangle.hpp"

namespace hexfield {
namespace {

constexpr int untangling_rounds = 30;
/// Share of defects up to which no frames are tried: so few tets stay turned over where arcs or features share a
/// coordinate that they must not share, which no map of the space changes.
constexpr double few_defects = 0.002;
/// The frames are given up when this many stages in a row end without a better conforming map ...
constexpr int max_idle_stages = 2;
/// ... which has at most this share of the defects of the best one before.
constexpr double progress_factor = 0.9;

/// Work (SolveMonitor) after which no better map is searched for: two to three milliseconds per tet.
constexpr long max_work = 2000;

/// A map of the conforming space and what verify_map() says of it.
struct Candidate {
  std::vector<double> unknowns;  // rank 0
  MapReport report;              // all ranks

  bool better_than(const Candidate& other) const {
    return std::pair(report.inverted.size(), report.wrong_edges.size()) <
           std::pair(other.report.inverted.size(), other.report.wrong_edges.size());
  }
};

double defects(const MapReport& report) {
  return static_cast<double>(report.inverted.size() + report.wrong_edges.size());
}

class Stage {
 public:
  Stage(MPI_Comm comm, const TetMesh& mesh, const Features& features, const FrameField& field, const EdgeCodes& codes,
        const SeamlessOptions& options, const Control& control)
      : comm_(comm),
        mesh_(mesh),
        features_(features),
        field_(field),
        codes_(codes),
        options_(options),
        control_(control),
        monitor_(control, "seamless") {
    monitor_.limit_work(max_work);
  }

  SeamlessResult run() {
    agree(comm_, [&] {
      if (root()) prepare();
    });
    broadcast(comm_, some_tets_are_flat_);
    const MapProblem problem(comm_, mesh_, space_);
    edge_ = std::cbrt(problem.total_volume() / options_.target_hexes);
    Candidate best;
    if (!restore(problem, best)) {
      best = fitted(problem, field_frames());
      if (frames_may_help(problem, best.report)) try_integrable_frames(problem, best);
    }
    if (best.report.inverted.empty()) {
      const Candidate polished = judged(polish(problem, best.unknowns, newton_memory_));
      if (!best.better_than(polished)) best = polished;
    }
    return finish(best);
  }

 private:
  bool root() const { return rank_of(comm_) == 0; }

  void prepare() {
    constraints_ = collect_constraints(mesh_, features_, field_, codes_);
    space_ = conforming_space(mesh_, cut_graph(mesh_, field_.matchings, singular_edges(codes_)),
                              alignments_of_field(constraints_, features_, codes_));
    some_tets_are_flat_ = !space_.collapsed.empty();
  }

  // The iterate of an interrupted polish, if there is one.
  bool restore(const MapProblem& problem, Candidate& best) {
    if (!control_.restore_iterate) return false;
    std::optional<std::vector<double>> iterate = control_.restore_iterate("seamless");
    if (iterate) newton_memory_ = take_memory(*iterate);
    bool found = iterate.has_value() && (!root() || iterate->size() == space_.num_unknowns());
    broadcast(problem.comm(), found);
    if (found) best = judged(*iterate);
    if (found && best.report.inverted.empty()) return true;
    newton_memory_.clear();
    return false;
  }

  static void keep_better(Candidate& best, Candidate other) {
    if (other.better_than(best)) best = std::move(other);
  }

  bool frames_may_help(const MapProblem& problem, const MapReport& report) const {
    const auto tets = static_cast<double>(problem.distributed().num_global_tets());
    return !report.valid() && !some_tets_are_flat_ && defects(report) > few_defects * tets;
  }

  // The conforming fit to frames; where it is not valid, made positive, then untangled.
  Candidate fitted(const MapProblem& problem, const std::vector<Mat3>& frames) {
    Candidate best = judged(fit(problem, frames));
    if (best.report.valid() || some_tets_are_flat_) return best;
    make_positive(problem, best.unknowns, {}, frames, monitor_, [&](const std::vector<double>& unknowns) {
      keep_better(best, judged(unknowns));
      return best.report.valid();
    });
    if (!best.report.inverted.empty())
      keep_better(best, judged(untangle(problem, best.unknowns, {}, edge_, untangling_rounds, monitor_)));
    return best;
  }

  // Conforming fits to the frames after each stage of their optimisation, until one is valid or they get no better:
  // where no integrable frames exist, the later, stiffer stages only cost.
  void try_integrable_frames(const MapProblem& problem, Candidate& best) {
    IntegrableOptions options;
    options.max_work = std::max(1L, max_work - monitor_.work());
    int idle = 0;
    try {
      IntegrableFrames frames(comm_, mesh_, field_, constraints_, space_, options);
      optimise_integrable_frames(frames, comm_, options, control_,
                                 [&](std::size_t, IntegrableFrames& now, const IntegrableStageReport& report) {
                                   monitor_.note({fmt::format("integrable frames {:.0e} {:.0e}",
                                                              report.stage.smoothness, report.stage.integrability),
                                                  report.newton_steps, report.linear_iterations, report.seconds});
                                   const double before = defects(best.report);
                                   const long work = monitor_.work();
                                   keep_better(best, fitted(problem, inverse_frames(now.gather())));
                                   now.set_work(now.work() + monitor_.work() - work);
                                   idle = defects(best.report) <= progress_factor * before ? 0 : idle + 1;
                                   return best.report.valid() || idle >= max_idle_stages;
                                 });
    } catch (const Error& error) {
      // Frames that cannot be aligned at all leave the direct fit, which is then judged as it is.
      if (error.code() != ExitCode::no_seamless_map) throw;
    }
  }

  // Combed frames whose inverses are the Jacobians J (per tet, in the charts of the field), on rank 0.
  std::vector<Mat3> inverse_frames(const std::vector<Mat3>& jacobians) const {
    std::vector<Mat3> frames;
    for (std::size_t t = 0; t < jacobians.size(); ++t)
      frames.push_back(edge_ * (jacobians[t].inverse() * octahedral::matrix(space_.cut.gauges[t])));
    return frames;
  }

  // Combed frames scaled to the wanted edge length, on rank 0.
  std::vector<Mat3> field_frames() const {
    std::vector<Mat3> frames;
    if (!root()) return frames;
    for (std::size_t t = 0; t < mesh_.num_tets(); ++t)
      frames.push_back(edge_ * (field_.frames[t].toRotationMatrix() * octahedral::matrix(space_.cut.gauges[t])));
    return frames;
  }

  // The conforming map whose Jacobians fit the inverses of the frames best: min sum V |J F - I|^2.
  std::vector<double> fit(const MapProblem& problem, const std::vector<Mat3>& frames) {
    solve::TetEnergy energy(solve::TetEnergy::Kind::frame_fit);
    problem.add_elements(energy, problem.volume_weights(), problem.scatter_matrices(frames), {});
    const std::vector<double> zero(root() ? space_.num_unknowns() : 0, 0.0);
    const VecOwner y(problem.make_vector(zero, false));
    const solve::EnergyTerm* terms[] = {&energy};
    monitor_.solve_linear(comm_, terms, y.get(), solve::Preconditioner::cholesky, "fit");
    return problem.gather(y.get(), {});
  }

  std::vector<double> polish(const MapProblem& problem, const std::vector<double>& start,
                             const std::vector<double>& memory) {
    solve::TetEnergy energy(solve::TetEnergy::Kind::symmetric_dirichlet);
    problem.add_elements(energy, problem.volume_weights(), problem.uniform_frames(edge_), {});
    const VecOwner y(problem.make_vector(start, false));
    solve::NewtonOptions newton;
    newton.preconditioner = solve::Preconditioner::cholesky;
    newton.max_iterations = 60;
    // The gradient of a start with thin tets is huge, so it measures nothing.
    newton.gradient_tolerance = 0;
    newton.decrease_tolerance = 1e-8;
    const solve::EnergyTerm* terms[] = {&energy};
    if (!std::isfinite(solve::evaluate(comm_, terms, y.get()))) return start;
    monitor_.minimise(
        comm_, terms, y.get(), newton, "seamless map", [&] { return problem.gather(y.get(), {}); }, memory);
    return problem.gather(y.get(), {});
  }

  Candidate judged(std::vector<double> unknowns) {
    Candidate candidate{std::move(unknowns), {}};
    agree(comm_, [&] {
      if (root()) candidate.report = verify_map(mesh_, features_, codes_, map_of(candidate.unknowns));
    });
    broadcast(comm_, candidate.report);
    monitor_.note_defects(candidate.report);
    return candidate;
  }

  CornerMap map_of(const std::vector<double>& unknowns) const {
    return to_corner_map(space_, coordinates(space_, unknowns));
  }

  SeamlessResult finish(Candidate& best) {
    SeamlessResult result;
    agree(comm_, [&] {
      if (!root()) return;
      const double volume = parametric_volume(map_of(best.unknowns));
      const double scale = volume > 0 ? std::cbrt(options_.target_hexes / volume) : 1;
      for (double& value : best.unknowns) value *= scale;
      quantize_to_dyadic_grid(space_, best.unknowns);
      result.map = map_of(best.unknowns);
      result.report = verify_map(mesh_, features_, codes_, result.map);
    });
    broadcast(comm_, result.report);
    result.newton_steps = monitor_.newton_steps();
    result.linear_iterations = monitor_.linear_iterations();
    result.solves = monitor_.solves();
    return result;
  }

  MPI_Comm comm_;
  const TetMesh& mesh_;
  const Features& features_;
  const FrameField& field_;
  const EdgeCodes& codes_;
  const SeamlessOptions& options_;
  const Control& control_;
  SolveMonitor monitor_;
  ConformingSpace space_;
  bool some_tets_are_flat_ = false;  ///< in every map of the space: there is no valid one
  double edge_ = 1;
  std::vector<double> newton_memory_;  // rank 0: of an interrupted polish
  std::vector<AxisConstraint> constraints_;
};

}  // namespace

SeamlessResult compute_seamless_map(MPI_Comm comm, const TetMesh& mesh, const Features& features,
                                    const FrameField& field, const EdgeCodes& codes, const SeamlessOptions& options,
                                    const Control& control) {
  return Stage(comm, mesh, features, field, codes, options, control).run();
}

}  // namespace hexfield
