#include "integrable_newton.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "hexfield/base/agree.hpp"
#include "hexfield/base/parallel.hpp"
#include "hexfield/base/petsc.hpp"
#include "hexfield/base/stopwatch.hpp"

namespace hexfield::integrable {
namespace {

using solve::Mat9;
using solve::Vec9;

/// Read or write access to the local part of a PETSc vector.
class Values {
 public:
  explicit Values(Vec v) : v_(v) {
    check_petsc(VecGetLocalSize(v, &size_), "VecGetLocalSize");
    check_petsc(VecGetArray(v, &data_), "VecGetArray");
  }
  ~Values() { VecRestoreArray(v_, &data_); }
  Values(const Values&) = delete;
  Values& operator=(const Values&) = delete;
  std::span<double> get() { return {data_, static_cast<std::size_t>(size_)}; }

 private:
  Vec v_;
  double* data_ = nullptr;
  PetscInt size_ = 0;
};

/// Cost of linearising, of the inverses and of the line search, in iterations of the linear solver.
constexpr long work_of_step = 10;

// Runs a callback of PETSc; its exceptions must not pass through C code.
template <class Work>
PetscErrorCode guarded(Work work) {
  try {
    work();
    return 0;
  } catch (const std::exception&) {
    return PETSC_ERR_LIB;
  }
}

}  // namespace

Newton::Newton(MPI_Comm comm, Problem& problem, std::vector<std::unique_ptr<CoarseSpace>> spaces,
               const IntegrableOptions& options)
    : comm_(comm), problem_(problem), spaces_(std::move(spaces)), options_(options) {
  const auto n = static_cast<PetscInt>(problem_.size());
  check_petsc(VecCreateMPI(comm_, n, PETSC_DETERMINE, rhs_.out()), "VecCreateMPI");
  check_petsc(VecDuplicate(rhs_.get(), direction_.out()), "VecDuplicate");
  check_petsc(MatCreateShell(comm_, n, n, PETSC_DETERMINE, PETSC_DETERMINE, this, matrix_.out()), "MatCreateShell");
  check_petsc(MatShellSetOperation(matrix_.get(), MATOP_MULT, reinterpret_cast<void (*)()>(&Newton::multiply)),
              "MatShellSetOperation");
  check_petsc(KSPCreate(comm_, ksp_.out()), "KSPCreate");
  check_petsc(KSPSetType(ksp_.get(), KSPCG), "KSPSetType");
  check_petsc(KSPSetNormType(ksp_.get(), KSP_NORM_NATURAL), "KSPSetNormType");
  check_petsc(KSPSetTolerances(ksp_.get(), options_.linear_tolerance, 0.0, 1e30, options_.max_linear_iterations),
              "KSPSetTolerances");
  check_petsc(KSPSetOperators(ksp_.get(), matrix_.get(), matrix_.get()), "KSPSetOperators");
  PC pc = nullptr;
  check_petsc(KSPGetPC(ksp_.get(), &pc), "KSPGetPC");
  check_petsc(PCSetType(pc, PCSHELL), "PCSetType");
  check_petsc(PCShellSetContext(pc, this), "PCShellSetContext");
  check_petsc(PCShellSetApply(pc, &Newton::precondition), "PCShellSetApply");
  interrupt_.emplace(ksp_.get(), [this] { return stop_requested(); });
}

PetscErrorCode Newton::multiply(Mat shell, Vec x, Vec y) {
  void* context = nullptr;
  MatShellGetContext(shell, &context);
  return guarded([&] {
    Values in(x), out(y);
    static_cast<Newton*>(context)->problem_.multiply(in.get(), out.get());
  });
}

PetscErrorCode Newton::precondition(PC shell, Vec r, Vec z) {
  void* context = nullptr;
  PCShellGetContext(shell, &context);
  auto& self = *static_cast<Newton*>(context);
  return guarded([&] {
    Values in(r), out(z);
    const auto residual = in.get();
    const auto result = out.get();
    parallel_for(self.inverses_.size(), 512, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t)
        Eigen::Map<Vec9>(result.data() + 9 * t).noalias() =
            self.inverses_[t] * Eigen::Map<const Vec9>(residual.data() + 9 * t);
    });
    self.problem_.project(result);
    for (const auto& space : self.spaces_) space->add_correction(residual, result);
  });
}

bool Newton::stop_requested() const {
  return control_ != nullptr && control_->stop_requested && control_->stop_requested();
}

void Newton::update_blocks() {
  inverses_.resize(problem_.mesh().num_owned());
  agree(comm_, [&] {
    parallel_for(inverses_.size(), 64, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) inverses_[t] = problem_.block(t).llt().solve(Mat9::Identity());
    });
  });
}

void Newton::update_coarse_spaces() {
  for (const auto& space : spaces_) space->update();
  stale_ = false;
  iterations_when_fresh_ = 0;
}

double Newton::find_direction(IntegrableStageReport& report, double tolerance) {
  check_petsc(KSPSetTolerances(ksp_.get(), tolerance, 0.0, 1e30, options_.max_linear_iterations), "KSPSetTolerances");
  {
    Values rhs(rhs_.get());
    std::transform(gradient_.begin(), gradient_.end(), rhs.get().begin(), [](double g) { return -g; });
  }
  interrupt_->reset();
  check_petsc(VecSet(direction_.get(), 0.0), "VecSet");
  check_petsc(KSPSolve(ksp_.get(), rhs_.get(), direction_.get()), "KSPSolve");
  PetscInt iterations = 0;
  check_petsc(KSPGetIterationNumber(ksp_.get(), &iterations), "KSPGetIterationNumber");
  report.linear_iterations += static_cast<int>(iterations);
  work_ += static_cast<long>(iterations);
  if (interrupt_->happened()) return 0;
  if (iterations_when_fresh_ == 0) iterations_when_fresh_ = static_cast<int>(iterations);
  // Coarse inverses of an old state serve until they cost more iterations than they save.
  stale_ = iterations > iterations_when_fresh_ + iterations_when_fresh_ / 2 + 3;
  PetscScalar slope = 0;
  check_petsc(VecDot(direction_.get(), rhs_.get(), &slope), "VecDot");
  if (slope > 0) return -slope;
  check_petsc(VecCopy(rhs_.get(), direction_.get()), "VecCopy");
  check_petsc(VecDot(rhs_.get(), rhs_.get(), &slope), "VecDot");
  return -slope;
}

std::optional<Energies> Newton::try_step(const std::vector<double>& frames, std::span<const double> limits, double t,
                                         double bound, const IntegrableStage& stage, std::vector<double>& trial) {
  Values direction(direction_.get());
  const auto d = direction.get();
  trial.resize(frames.size());
  for (std::size_t k = 0; k < frames.size(); ++k) trial[k] = frames[k] + std::min(t, limits[k / 9]) * d[k];
  const Energies e = problem_.energies(trial);
  if (!(e.total(stage) <= bound)) return std::nullopt;
  return e;
}

bool Newton::search(const IntegrableStage& stage, double slope, std::vector<double>& frames, Energies& energies) {
  // A step may use up this much of the way to the inversion of a tet.
  constexpr double reach = 0.9;
  std::vector<double> limits;
  {
    Values direction(direction_.get());
    limits = problem_.step_limits(frames, direction.get());
  }
  double least = std::numeric_limits<double>::infinity();
  for (double& limit : limits) least = std::min(least, limit *= reach);
  MPI_Allreduce(MPI_IN_PLACE, &least, 1, MPI_DOUBLE, MPI_MIN, comm_);
  const double before = energies.total(stage);
  double t = std::min(1.0, least);
  // A few tets that must not go far should not hold back the others: each tet goes as far as it can.
  std::optional<Energies> each;
  if (least < 1) each = try_step(frames, limits, 1.0, before + 1e-4 * t * slope, stage, clipped_);
  std::optional<Energies> all;
  for (int i = 0; i < 40 && !all; ++i) {
    all = try_step(frames, limits, t, before + 1e-4 * t * slope, stage, trial_);
    if (each) break;
    if (!all) t *= 0.5;
  }
  if (!each && !all) return false;
  const bool use_each = each && (!all || each->total(stage) < all->total(stage));
  frames.swap(use_each ? clipped_ : trial_);
  energies = use_each ? *each : *all;
  return true;
}

IntegrableStageReport Newton::run(const IntegrableStage& stage, double tolerance, const Control& control,
                                  std::vector<double>& frames) {
  const auto start = Clock::now();
  IntegrableStageReport report;
  report.stage = stage;
  if (options_.refresh_scale) problem_.refresh_scales(frames);
  problem_.set_stage(stage);
  for (const auto& space : spaces_) space->set_stage(stage);
  stale_ = true;
  gradient_.resize(frames.size());
  Energies energies = problem_.energies(frames);
  control_ = &control;
  while (report.newton_steps < options_.max_newton_steps && !report.stopped) {
    report.exhausted = options_.max_work > 0 && work_ >= options_.max_work;
    if (report.exhausted) break;
    work_ += work_of_step;
    problem_.linearise(frames, gradient_);
    update_blocks();
    if (stale_) update_coarse_spaces();
    double slope = find_direction(report, options_.linear_tolerance);
    report.stopped = interrupt_->happened();
    if (report.stopped) break;
    const double before = energies.total(stage);
    auto small_step = [&] { return !(-0.5 * slope > tolerance * before); };
    // A nearly inverted tet can satisfy the loose test alone; look again before ending the stage.
    if (small_step()) slope = find_direction(report, 1e-3 * options_.linear_tolerance);
    report.stopped = interrupt_->happened();
    if (report.stopped) break;
    const bool small = small_step();
    const bool moved = search(stage, slope, frames, energies);
    if (moved) ++report.newton_steps;
    if (small || !moved) break;
    report.stopped = stop_requested();
  }
  control_ = nullptr;
  report.distortion = energies.distortion;
  report.smoothness = energies.smoothness;
  report.integrability = energies.integrability;
  report.max_curl = problem_.max_curl(frames);
  report.seconds = seconds_since(start);
  return report;
}

}  // namespace hexfield::integrable
