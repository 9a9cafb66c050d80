#include "hexfield/solve/minimise.hpp"

#include <algorithm>
#include <cmath>

#include "assembly.hpp"
#include "hexfield/base/error.hpp"
#include "hexfield/base/petsc.hpp"
#include "linear_solver.hpp"

namespace hexfield::solve {
namespace {

// Adds a little of the mean diagonal, so that directions without energy do not stop a factorisation.
void shift(Mat hessian, Vec scratch) {
  PetscScalar trace = 0;
  PetscInt n = 0;
  check_petsc(MatGetDiagonal(hessian, scratch), "MatGetDiagonal");
  check_petsc(VecSum(scratch, &trace), "VecSum");
  check_petsc(VecGetSize(scratch, &n), "VecGetSize");
  if (n > 0) check_petsc(MatShift(hessian, std::max(1e-11 * trace / n, 1e-300)), "MatShift");
}

class Newton {
 public:
  Newton(MPI_Comm comm, std::span<const EnergyTerm* const> terms, Vec y, const NewtonOptions& options)
      : options_(options),
        assembly_(comm, terms, y),
        solver_(comm, options.preconditioner, options.max_linear_iterations, options.interrupted),
        y_(y),
        memory_(options.memory != nullptr ? *options.memory : own_memory_) {
    for (VecHandle* v : {&gradient_, &step_, &trial_}) check_petsc(VecDuplicate(y, v->out()), "VecDuplicate");
    assembly_.set_block_size(options.block_size);
  }

  NewtonResult run() {
    PetscInt size = 0;
    check_petsc(VecGetSize(y_, &size), "VecGetSize");
    if (size == 0) return result_;
    result_.energy = assembly_.value(y_);
    require(std::isfinite(result_.energy), "A minimisation starts outside the domain of its energy.");
    result_.iterations = memory_.iterations;
    if (memory_.has_factor) factorise_again();
    for (;;) {
      result_.energy = assembly_.derivatives(y_, gradient_.get());
      check_petsc(VecNorm(gradient_.get(), NORM_2, &result_.gradient_norm), "VecNorm");
      if (result_.iterations == 0) {
        memory_.start_norm = result_.gradient_norm;
        memory_.start_energy = std::abs(result_.energy);
      }
      if (result_.gradient_norm <= options_.gradient_tolerance * std::max(1.0, memory_.start_norm))
        return finish(NewtonEnd::converged);
      if (result_.iterations >= options_.max_iterations) return finish(NewtonEnd::iteration_limit);
      const double slope = solve_for_step();
      if (solver_.interrupted()) return finish(NewtonEnd::stopped);
      if (!(slope < 0)) return finish(NewtonEnd::no_descent);
      // Below the second bound the energy, a difference of larger numbers, is only rounding noise.
      if (-0.5 * slope <=
          std::max(options_.decrease_tolerance * std::abs(result_.energy), 1e-15 * memory_.start_energy)) {
        search(slope);
        return finish(NewtonEnd::converged);
      }
      if (!search(slope)) return finish(NewtonEnd::no_descent);
      memory_.iterations = ++result_.iterations;
      if (options_.monitor && !options_.monitor(result_.iterations, result_.energy, result_.gradient_norm))
        return finish(NewtonEnd::stopped);
    }
  }

 private:
  NewtonResult finish(NewtonEnd end) {
    result_.end = end;
    return result_;
  }

  void factorise_again() {
    assembly_.derivatives(memory_.factored_at.get(), gradient_.get());
    shift(assembly_.hessian(), trial_.get());
    solver_.factorise(assembly_.hessian());
  }

  void remember_factor() {
    memory_.has_factor = solver_.has_factor();
    if (!solver_.renewed()) return;
    if (memory_.factored_at.get() == nullptr) check_petsc(VecDuplicate(y_, memory_.factored_at.out()), "VecDuplicate");
    check_petsc(VecCopy(y_, memory_.factored_at.get()), "VecCopy");
  }

  // Truncated Newton direction; returns its slope g . dy.
  double solve_for_step() {
    shift(assembly_.hessian(), trial_.get());
    const double relative = result_.gradient_norm / std::max(memory_.start_norm, 1e-300);
    const bool direct = options_.preconditioner == Preconditioner::cholesky;
    const double forcing = direct ? std::max(relative, 1e-12) : std::sqrt(relative);
    const double tolerance = std::min(options_.linear_tolerance, forcing);
    result_.linear_iterations += solver_.solve(assembly_.hessian(), gradient_.get(), step_.get(), tolerance);
    if (solver_.interrupted()) return 0;
    remember_factor();
    check_petsc(VecScale(step_.get(), -1.0), "VecScale");
    PetscScalar slope = 0;
    check_petsc(VecDot(gradient_.get(), step_.get(), &slope), "VecDot");
    if (slope < 0) return slope;
    check_petsc(VecCopy(gradient_.get(), step_.get()), "VecCopy");
    check_petsc(VecScale(step_.get(), -1.0), "VecScale");
    return -result_.gradient_norm * result_.gradient_norm;
  }

  // Backtracking along step_ inside the domain; moves y_ and the energy. False when nothing decreases.
  bool search(double slope) {
    const double noise = 1e-15 * std::abs(result_.energy);
    double t = std::min(1.0, 0.99 * assembly_.max_step(y_, step_.get()));
    for (int i = 0; i < 50; ++i) {
      check_petsc(VecWAXPY(trial_.get(), t, step_.get(), y_), "VecWAXPY");
      const double energy = assembly_.value(trial_.get());
      if (energy <= result_.energy + 1e-4 * t * slope + noise) {
        check_petsc(VecCopy(trial_.get(), y_), "VecCopy");
        result_.energy = energy;
        return true;
      }
      // Minimiser of the parabola through both values and the slope, kept inside [0.1 t, 0.7 t].
      const double curvature = energy - result_.energy - t * slope;
      const double best = std::isfinite(energy) && curvature > 0 ? -0.5 * slope * t * t / curvature : 0.5 * t;
      t = std::clamp(best, 0.1 * t, 0.7 * t);
    }
    return false;
  }

  const NewtonOptions& options_;
  Assembly assembly_;
  LinearSolver solver_;
  Vec y_;
  VecHandle gradient_, step_, trial_;
  NewtonResult result_;
  NewtonMemory own_memory_;
  NewtonMemory& memory_;
};

}  // namespace

NewtonResult minimise(MPI_Comm comm, std::span<const EnergyTerm* const> terms, Vec y, const NewtonOptions& options) {
  return Newton(comm, terms, y, options).run();
}

NewtonResult solve_linear(MPI_Comm comm, std::span<const EnergyTerm* const> terms, Vec y, Preconditioner preconditioner,
                          int block_size, const std::function<bool()>& interrupted) {
  NewtonOptions options;
  options.interrupted = interrupted;
  options.preconditioner = preconditioner;
  options.block_size = block_size;
  // A second step works as iterative refinement against the unshifted gradient.
  options.max_iterations = 3;
  options.max_linear_iterations = 2000;
  options.linear_tolerance = 1e-12;
  options.gradient_tolerance = 1e-14;
  options.decrease_tolerance = 0;
  return Newton(comm, terms, y, options).run();
}

double evaluate(MPI_Comm comm, std::span<const EnergyTerm* const> terms, Vec y) {
  return Assembly(comm, terms, y).value(y);
}

}  // namespace hexfield::solve
