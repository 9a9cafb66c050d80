#pragma once

#include <mpi.h>
#include <petscvec.h>

#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "hexfield/solve/petsc_handle.hpp"

namespace hexfield::solve {

/// A sum of element energies E(y) = sum_e E_e(y restricted to e) over distributed unknowns y; each rank
/// holds some elements. Element unknowns are global indices into y. All functions are local and must be
/// safe to call from several threads at once.
class EnergyTerm {
 public:
  virtual ~EnergyTerm() = default;
  virtual std::size_t num_elements() const = 0;
  /// Global indices of the unknowns of element e, each at most once.
  virtual std::span<const PetscInt> unknowns(std::size_t e) const = 0;
  /// Energy of e at its unknowns y (same order); +infinity outside the domain (det <= 0).
  virtual double value(std::size_t e, std::span<const double> y) const = 0;
  /// Also the gradient (n) and a positive-semidefinite approximation of the Hessian (n x n, row-major).
  virtual double derivatives(std::size_t e, std::span<const double> y, std::span<double> gradient,
                             std::span<double> hessian) const = 0;
  /// Largest t such that y + s dy stays in the domain for all s in [0, t); infinity where there is no limit.
  virtual double max_step(std::size_t, std::span<const double>, std::span<const double>) const {
    return std::numeric_limits<double>::infinity();
  }
};

/// How a Newton system H dy = -g is preconditioned.
enum class Preconditioner {
  amg,           ///< smoothed-aggregation or classical multigrid on H; scalable
  cholesky,      ///< sparse direct factorisation of H or of that of an earlier step, whole on every rank
  block_jacobi,  ///< point blocks of `block_size`
};

/// What a minimisation remembers between its steps besides y. Given back to minimise() with the y of the same moment,
/// it goes on as if it had never been interrupted, to the byte.
struct NewtonMemory {
  int iterations = 0;       ///< steps taken; 0 for a fresh start
  double start_norm = 0;    ///< of the gradient at the start
  double start_energy = 0;  ///< size of the energy there
  bool has_factor = false;  ///< a factorisation serves further steps; `factored_at` is the y of its Hessian
  VecHandle factored_at;
};

struct NewtonOptions {
  int max_iterations = 500;
  double gradient_tolerance = 1e-6;   ///< stop when |g| <= tolerance * max(1, |g at the start|)
  double decrease_tolerance = 1e-12;  ///< stop when the predicted decrease is below this fraction of |E|
  int max_linear_iterations = 300;
  /// Forcing term: relative residual min(linear_tolerance, sqrt(|g| / |g at the start|)), with cholesky without the
  /// root, as its iterations are few.
  double linear_tolerance = 1e-1;
  Preconditioner preconditioner = Preconditioner::amg;
  int block_size = 1;
  /// Called after every accepted step with (iteration, energy, gradient norm); return false to stop.
  /// Called on all ranks with the same values; must return the same on all.
  std::function<bool(int, double, double)> monitor;
  /// Asked in every iteration of the linear solver, on all ranks, with the same answer; true drops the step under way
  /// and ends with NewtonEnd::stopped. May be empty.
  std::function<bool()> interrupted;
  /// Where to go on, and kept up to date for the monitor; may be null.
  NewtonMemory* memory = nullptr;
};

enum class NewtonEnd { converged, iteration_limit, stopped, no_descent };

struct NewtonResult {
  NewtonEnd end = NewtonEnd::converged;
  int iterations = 0;
  int linear_iterations = 0;
  double energy = 0;
  double gradient_norm = 0;
};

/// Truncated Newton minimisation of the sum of `terms` from `y`, which must be inside the domain and is
/// overwritten by the result. Line search: first cut to 0.99 of max_step over all elements, then Armijo;
/// never leaves the domain. The same bytes for any number of threads. Collective.
/// Throws Error(bug) when the start is outside the domain.
NewtonResult minimise(MPI_Comm comm, std::span<const EnergyTerm* const> terms, Vec y, const NewtonOptions& options);

/// Minimiser of a quadratic sum of terms, to a relative gradient of about 1e-12 (conjugate gradients with this
/// preconditioner, refined once); y is the start and the result. Where the sum has no unique minimiser, directions
/// without energy keep their start. `interrupted`: see NewtonOptions. Collective.
NewtonResult solve_linear(MPI_Comm comm, std::span<const EnergyTerm* const> terms, Vec y,
                          Preconditioner preconditioner = Preconditioner::amg, int block_size = 1,
                          const std::function<bool()>& interrupted = {});

/// Value of the sum at y (may be infinite). Collective.
double evaluate(MPI_Comm comm, std::span<const EnergyTerm* const> terms, Vec y);

}  // namespace hexfield::solve
