#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "hexfield/solve/interrupt.hpp"
#include "hexfield/solve/petsc_handle.hpp"
#include "integrable_coarse.hpp"

namespace hexfield::integrable {

/// Truncated Newton on a Problem: conjugate gradients in the constrained space with block and coarse
/// preconditioners, and a line search that never inverts a tet. Collective throughout.
class Newton {
 public:
  Newton(MPI_Comm comm, Problem& problem, std::vector<std::unique_ptr<CoarseSpace>> spaces,
         const IntegrableOptions& options);

  /// Minimises from `frames` (overwritten).
  IntegrableStageReport run(const IntegrableStage& stage, double tolerance, const Control& control,
                            std::vector<double>& frames);

  /// Iterations of the linear solver so far, with those that the rest of the steps is worth.
  long work() const { return work_; }
  void set_work(long work) { work_ = work; }

 private:
  bool stop_requested() const;
  static PetscErrorCode multiply(Mat shell, Vec x, Vec y);
  static PetscErrorCode precondition(PC shell, Vec r, Vec z);
  void update_blocks();
  void update_coarse_spaces();
  /// Returns the slope g . direction and leaves the direction in direction_.
  double find_direction(IntegrableStageReport& report, double tolerance);
  /// The energies after each tet goes min(t, its limit) along direction_ (then in `trial`), when at most `bound`.
  std::optional<Energies> try_step(const std::vector<double>& frames, std::span<const double> limits, double t,
                                   double bound, const IntegrableStage& stage, std::vector<double>& trial);
  bool search(const IntegrableStage& stage, double slope, std::vector<double>& frames, Energies& energies);

  MPI_Comm comm_;
  Problem& problem_;
  std::vector<std::unique_ptr<CoarseSpace>> spaces_;
  const IntegrableOptions& options_;
  solve::MatHandle matrix_;
  solve::KspHandle ksp_;
  const Control* control_ = nullptr;  // of the run under way
  std::optional<solve::Interrupt> interrupt_;
  solve::VecHandle rhs_, direction_;
  std::vector<solve::Mat9> inverses_;
  std::vector<double> gradient_;
  std::vector<double> trial_;
  std::vector<double> clipped_;
  int iterations_when_fresh_ = 0;  // of the first solve after the coarse spaces were renewed
  bool stale_ = true;
  long work_ = 0;
};

}  // namespace hexfield::integrable
