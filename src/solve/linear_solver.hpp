#pragma once

#include <petscksp.h>

#include "assembly.hpp"

namespace hexfield::solve {

/// Conjugate gradients on a symmetric positive-(semi)definite AIJ matrix that keeps its pattern. A factorisation
/// serves later matrices too, until it costs more iterations than a new one is worth.
class LinearSolver {
 public:
  LinearSolver(MPI_Comm comm, Preconditioner preconditioner, int max_iterations);
  ~LinearSolver() { KSPDestroy(&ksp_); }
  LinearSolver(const LinearSolver&) = delete;
  LinearSolver& operator=(const LinearSolver&) = delete;

  /// x ~ matrix^-1 rhs to the relative residual (in the norm of the preconditioner). Returns the iterations; x is
  /// the best iterate when the limit or a direction of no curvature ends it early, and rhs itself (scaled by
  /// nothing) when not even one step was possible. Collective.
  int solve(Mat matrix, Vec rhs, Vec x, double relative_tolerance);

 private:
  /// Iterations; sets `converged`.
  int run(Vec rhs, Vec x, double relative_tolerance, int limit, bool& converged);

  KSP ksp_ = nullptr;
  int max_iterations_;
  bool keeps_factor_;
  bool has_factor_ = false;
};

}  // namespace hexfield::solve
