#include "linear_solver.hpp"

#include <cmath>

#include "hexfield/base/error.hpp"
#include "hexfield/base/petsc.hpp"

namespace hexfield::solve {
namespace {

// Options of one solver only; PETSc's global database stays as it is.
using OptionsHandle = Handle<PetscOptions, PetscOptionsDestroy>;

void set_up_amg(PC pc) {
  OptionsHandle options;
  check_petsc(PetscOptionsCreate(options.out()), "PetscOptionsCreate");
  const char* const settings[][2] = {
      {"-pc_hypre_boomeramg_strong_threshold", "0.5"},
      {"-pc_hypre_boomeramg_coarsen_type", "HMIS"},
      {"-pc_hypre_boomeramg_interp_type", "ext+i"},
      {"-pc_hypre_boomeramg_P_max", "4"},
      {"-pc_hypre_boomeramg_agg_nl", "0"},
      {"-pc_hypre_boomeramg_relax_type_all", "l1scaled-SOR/Jacobi"},
  };
  for (const auto& [name, value] : settings)
    check_petsc(PetscOptionsSetValue(options.get(), name, value), "PetscOptionsSetValue");
  check_petsc(PCSetType(pc, PCHYPRE), "PCSetType");
  check_petsc(PCHYPRESetType(pc, "boomeramg"), "PCHYPRESetType");
  check_petsc(PetscObjectSetOptions(reinterpret_cast<PetscObject>(pc), options.get()), "PetscObjectSetOptions");
  check_petsc(PCSetFromOptions(pc), "PCSetFromOptions");
  check_petsc(PetscObjectSetOptions(reinterpret_cast<PetscObject>(pc), nullptr), "PetscObjectSetOptions");
}

}  // namespace

LinearSolver::LinearSolver(MPI_Comm comm, Preconditioner preconditioner, int max_iterations) : comm_(comm) {
  check_petsc(KSPCreate(comm_, &ksp_), "KSPCreate");
  check_petsc(KSPSetType(ksp_, KSPCG), "KSPSetType");
  check_petsc(KSPSetNormType(ksp_, KSP_NORM_NATURAL), "KSPSetNormType");
  check_petsc(KSPSetTolerances(ksp_, PETSC_DEFAULT, 0.0, 1e30, max_iterations), "KSPSetTolerances");
  PC pc = nullptr;
  check_petsc(KSPGetPC(ksp_, &pc), "KSPGetPC");
  switch (preconditioner) {
    case Preconditioner::amg:
      set_up_amg(pc);
      break;
    case Preconditioner::cholesky:
      check_petsc(PCSetType(pc, PCCHOLESKY), "PCSetType");
      check_petsc(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS), "PCFactorSetMatSolverType");
      break;
    case Preconditioner::block_jacobi:
      check_petsc(PCSetType(pc, PCPBJACOBI), "PCSetType");
      break;
  }
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
