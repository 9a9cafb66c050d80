#include "linear_solver.hpp"

#include <algorithm>
#include <cmath>

#include "hexfield/base/error.hpp"
#include "hexfield/base/petsc.hpp"
#include "hexfield/solve/sparse_inverse.hpp"
#include "owner_cholesky.hpp"

namespace hexfield::solve {
namespace {

// Iterations with the factorisation of an earlier matrix: beyond the first number the next solve renews it, at the
// second this one does. A factorisation costs as much as some dozens of them, the more the larger the system.
constexpr int stale_iterations = 12;
constexpr int max_stale_iterations = 30;

}  // namespace

namespace {

KSP created(MPI_Comm comm, KspHandle& ksp) {
  check_petsc(KSPCreate(comm, ksp.out()), "KSPCreate");
  return ksp.get();
}

}  // namespace

LinearSolver::LinearSolver(MPI_Comm comm, Preconditioner preconditioner, int max_iterations,
                           std::function<bool()> interrupted)
    : interrupt_(created(comm, ksp_), std::move(interrupted)),
      preconditioner_(preconditioner),
      max_iterations_(max_iterations),
      keeps_factor_(preconditioner == Preconditioner::cholesky) {
  check_petsc(KSPSetType(ksp_.get(), KSPCG), "KSPSetType");
  check_petsc(KSPSetNormType(ksp_.get(), KSP_NORM_NATURAL), "KSPSetNormType");
}

void LinearSolver::set_matrix(Mat matrix) {
  check_petsc(KSPSetOperators(ksp_.get(), matrix, matrix), "KSPSetOperators");
  if (chosen_) return;
  PC pc = nullptr;
  check_petsc(KSPGetPC(ksp_.get(), &pc), "KSPGetPC");
  if (preconditioner_ == Preconditioner::cholesky && one_rank_owns(matrix))
    use_owner_cholesky(pc);
  else
    choose_preconditioner(pc, preconditioner_);
  chosen_ = true;
}

void LinearSolver::factorise(Mat matrix) {
  set_matrix(matrix);
  check_petsc(KSPSetReusePreconditioner(ksp_.get(), PETSC_FALSE), "KSPSetReusePreconditioner");
  check_petsc(KSPSetUp(ksp_.get()), "KSPSetUp");
  has_factor_ = keeps_factor_;
}

int LinearSolver::run(Vec rhs, Vec x, double relative_tolerance, int limit, bool& converged) {
  check_petsc(KSPSetTolerances(ksp_.get(), relative_tolerance, 0.0, 1e30, limit), "KSPSetTolerances");
  check_petsc(VecSet(x, 0.0), "VecSet");
  check_petsc(KSPSolve(ksp_.get(), rhs, x), "KSPSolve");
  PetscInt iterations = 0;
  check_petsc(KSPGetIterationNumber(ksp_.get(), &iterations), "KSPGetIterationNumber");
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  check_petsc(KSPGetConvergedReason(ksp_.get(), &reason), "KSPGetConvergedReason");
  converged = reason > 0;
  return static_cast<int>(iterations);
}

int LinearSolver::solve(Mat matrix, Vec rhs, Vec x, double relative_tolerance) {
  set_matrix(matrix);
  renewed_ = false;
  interrupt_.reset();
  int iterations = 0;
  bool converged = false;
  if (has_factor_) {
    check_petsc(KSPSetReusePreconditioner(ksp_.get(), PETSC_TRUE), "KSPSetReusePreconditioner");
    iterations = run(rhs, x, relative_tolerance, std::min(max_iterations_, max_stale_iterations), converged);
    has_factor_ = converged && iterations <= stale_iterations;
  }
  if (!converged && !interrupt_.happened()) {
    check_petsc(KSPSetReusePreconditioner(ksp_.get(), PETSC_FALSE), "KSPSetReusePreconditioner");
    iterations += run(rhs, x, relative_tolerance, max_iterations_, converged);
    has_factor_ = keeps_factor_ && converged;
    renewed_ = has_factor_;
  }
  PetscReal norm = 0;
  check_petsc(VecNorm(x, NORM_2, &norm), "VecNorm");
  if (!(norm > 0) || !std::isfinite(norm)) check_petsc(VecCopy(rhs, x), "VecCopy");
  return iterations;
}

}  // namespace hexfield::solve
