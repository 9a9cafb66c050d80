#include "linear_solver.hpp"

#include <cmath>

#include "hexfield/base/error.hpp"
#include "hexfield/base/petsc.hpp"
#include "hexfield/solve/sparse_inverse.hpp"

namespace hexfield::solve {
LinearSolver::LinearSolver(MPI_Comm comm, Preconditioner preconditioner, int max_iterations) : comm_(comm) {
  check_petsc(KSPCreate(comm_, &ksp_), "KSPCreate");
  check_petsc(KSPSetType(ksp_, KSPCG), "KSPSetType");
  check_petsc(KSPSetNormType(ksp_, KSP_NORM_NATURAL), "KSPSetNormType");
  check_petsc(KSPSetTolerances(ksp_, PETSC_DEFAULT, 0.0, 1e30, max_iterations), "KSPSetTolerances");
  PC pc = nullptr;
  check_petsc(KSPGetPC(ksp_, &pc), "KSPGetPC");
  choose_preconditioner(pc, preconditioner);
}

int LinearSolver::solve(Mat matrix, Vec rhs, Vec x, double relative_tolerance) {
  check_petsc(KSPSetOperators(ksp_, matrix, matrix), "KSPSetOperators");
  PetscInt limit = 0;
  check_petsc(KSPGetTolerances(ksp_, nullptr, nullptr, nullptr, &limit), "KSPGetTolerances");
  check_petsc(KSPSetTolerances(ksp_, relative_tolerance, 0.0, 1e30, limit), "KSPSetTolerances");
  check_petsc(VecSet(x, 0.0), "VecSet");
  check_petsc(KSPSolve(ksp_, rhs, x), "KSPSolve");
  PetscInt iterations = 0;
  check_petsc(KSPGetIterationNumber(ksp_, &iterations), "KSPGetIterationNumber");
  PetscReal norm = 0;
  check_petsc(VecNorm(x, NORM_2, &norm), "VecNorm");
  if (!(norm > 0) || !std::isfinite(norm)) check_petsc(VecCopy(rhs, x), "VecCopy");
  return static_cast<int>(iterations);
}

}  // namespace hexfield::solve
