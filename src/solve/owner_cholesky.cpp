#include "owner_cholesky.hpp"

#include <memory>

#include "hexfield/base/petsc.hpp"
#include "hexfield/solve/petsc_handle.hpp"
#include "hexfield/solve/sparse_inverse.hpp"

namespace hexfield::solve {
namespace {

/// The factorisation, on the rank that owns the rows.
struct Owner {
  PcHandle factor;
  VecHandle rhs, solution;  // views of the local arrays
  PetscInt size = 0;
};

// The callbacks return PETSc's codes: exceptions must not pass through C code.
PetscErrorCode set_up(PC shell) {
  void* context = nullptr;
  if (PetscErrorCode code = PCShellGetContext(shell, &context); code != 0) return code;
  Owner& owner = *static_cast<Owner*>(context);
  Mat matrix = nullptr;
  Mat local = nullptr;
  PetscInt columns = 0;
  if (PetscErrorCode code = PCGetOperators(shell, nullptr, &matrix); code != 0) return code;
  if (PetscErrorCode code = MatGetLocalSize(matrix, &owner.size, &columns); code != 0) return code;
  if (owner.size == 0) return 0;
  if (PetscErrorCode code = MatGetDiagonalBlock(matrix, &local); code != 0) return code;
  if (PetscErrorCode code = MatSetOption(local, MAT_SPD, PETSC_TRUE); code != 0) return code;
  // Whatever changed the values, the factorisation must see that they did.
  PetscScalar* values = nullptr;
  if (PetscErrorCode code = MatSeqAIJGetArray(local, &values); code != 0) return code;
  if (PetscErrorCode code = MatSeqAIJRestoreArray(local, &values); code != 0) return code;
  if (PetscErrorCode code = PCSetOperators(owner.factor.get(), local, local); code != 0) return code;
  return PCSetUp(owner.factor.get());
}

PetscErrorCode apply(PC shell, Vec rhs, Vec solution) {
  void* context = nullptr;
  if (PetscErrorCode code = PCShellGetContext(shell, &context); code != 0) return code;
  Owner& owner = *static_cast<Owner*>(context);
  if (owner.size == 0) return 0;
  const PetscScalar* in = nullptr;
  PetscScalar* out = nullptr;
  if (PetscErrorCode code = VecGetArrayRead(rhs, &in); code != 0) return code;
  if (PetscErrorCode code = VecGetArray(solution, &out); code != 0) return code;
  if (owner.rhs.get() == nullptr) {
    for (VecHandle* v : {&owner.rhs, &owner.solution})
      if (PetscErrorCode code = VecCreateSeqWithArray(PETSC_COMM_SELF, 1, owner.size, nullptr, v->out()); code != 0)
        return code;
  }
  if (PetscErrorCode code = VecPlaceArray(owner.rhs.get(), in); code != 0) return code;
  if (PetscErrorCode code = VecPlaceArray(owner.solution.get(), out); code != 0) return code;
  const PetscErrorCode applied = PCApply(owner.factor.get(), owner.rhs.get(), owner.solution.get());
  if (PetscErrorCode code = VecResetArray(owner.rhs.get()); code != 0) return code;
  if (PetscErrorCode code = VecResetArray(owner.solution.get()); code != 0) return code;
  if (PetscErrorCode code = VecRestoreArrayRead(rhs, &in); code != 0) return code;
  if (PetscErrorCode code = VecRestoreArray(solution, &out); code != 0) return code;
  return applied;
}

PetscErrorCode destroy(PC shell) {
  void* context = nullptr;
  if (PetscErrorCode code = PCShellGetContext(shell, &context); code != 0) return code;
  delete static_cast<Owner*>(context);
  return 0;
}

}  // namespace

bool one_rank_owns(Mat matrix) {
  PetscInt local = 0;
  PetscInt all = 0;
  check_petsc(MatGetLocalSize(matrix, &local, nullptr), "MatGetLocalSize");
  check_petsc(MatGetSize(matrix, &all, nullptr), "MatGetSize");
  int whole = local == 0 || local == all ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &whole, 1, MPI_INT, MPI_MIN, PetscObjectComm(reinterpret_cast<PetscObject>(matrix)));
  return whole != 0;
}

void use_owner_cholesky(PC pc) {
  auto owner = std::make_unique<Owner>();
  check_petsc(PCCreate(PETSC_COMM_SELF, owner->factor.out()), "PCCreate");
  choose_preconditioner(owner->factor.get(), Preconditioner::cholesky);
  check_petsc(PCSetType(pc, PCSHELL), "PCSetType");
  check_petsc(PCShellSetContext(pc, owner.release()), "PCShellSetContext");
  check_petsc(PCShellSetSetUp(pc, set_up), "PCShellSetSetUp");
  check_petsc(PCShellSetApply(pc, apply), "PCShellSetApply");
  check_petsc(PCShellSetDestroy(pc, destroy), "PCShellSetDestroy");
}

}  // namespace hexfield::solve
