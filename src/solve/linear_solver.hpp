#pragma once

#include <functional>

#include "hexfield/solve/interrupt.hpp"
#include "hexfield/solve/minimise.hpp"
#include "hexfield/solve/petsc_handle.hpp"

namespace hexfield::solve {

/// Conjugate gradients on a symmetric positive-(semi)definite AIJ matrix that keeps its pattern. A factorisation
/// serves later matrices too, until it costs more iterations than a new one is worth. Where one rank owns all rows,
/// it alone factorises, and the result is the same bytes for any number of ranks.
class LinearSolver {
 public:
  /// `interrupted`: see NewtonOptions.
  LinearSolver(MPI_Comm comm, Preconditioner preconditioner, int max_iterations,
               std::function<bool()> interrupted = {});

  /// x ~ matrix^-1 rhs to the relative residual (in the norm of the preconditioner). Returns the iterations; x is
  /// the best iterate when the limit or a direction of no curvature ends it early, and rhs itself (scaled by
  /// nothing) when not even one step was possible. Collective.
  int solve(Mat matrix, Vec rhs, Vec x, double relative_tolerance);
  /// Factorises the matrix for later solves, as solve() does where no earlier factorisation serves. Collective.
  void factorise(Mat matrix);
  /// Whether the last solve() was interrupted: its x means nothing.
  bool interrupted() const { return interrupt_.happened(); }
  /// Whether a factorisation of an earlier matrix is kept.
  bool has_factor() const { return has_factor_; }
  /// Whether the last solve() factorised its own matrix and keeps that.
  bool renewed() const { return renewed_; }

 private:
  void set_matrix(Mat matrix);
  /// Iterations; sets `converged`.
  int run(Vec rhs, Vec x, double relative_tolerance, int limit, bool& converged);

  KspHandle ksp_;
  Interrupt interrupt_;
  Preconditioner preconditioner_;
  int max_iterations_;
  bool chosen_ = false;  // the preconditioner, which depends on the layout of the matrix
  bool keeps_factor_;
  bool has_factor_ = false;
  bool renewed_ = false;
};

}  // namespace hexfield::solve
