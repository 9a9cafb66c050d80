#include "hexfield/solve/sparse_inverse.hpp"

#include <algorithm>
#include <utility>

#include "hexfield/base/agree.hpp"
#include "hexfield/base/error.hpp"
#include "hexfield/base/petsc.hpp"

namespace hexfield::solve {
namespace {

void set_up_amg(PC pc) {
  // Options of one preconditioner only; PETSc's global database stays as it is.
  Handle<PetscOptions, PetscOptionsDestroy> options;
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

void set_up_cholesky(PC pc) {
  int size = 1;
  MPI_Comm_size(PetscObjectComm(reinterpret_cast<PetscObject>(pc)), &size);
  PC inner = pc;
  if (size > 1) {
    // MUMPS on several ranks adds in the order in which messages arrive, so equal runs would give unequal
    // bytes. Every rank factorises the whole matrix instead.
    check_petsc(PCSetType(pc, PCREDUNDANT), "PCSetType");
    check_petsc(PCRedundantSetNumber(pc, size), "PCRedundantSetNumber");
    KSP ksp = nullptr;
    check_petsc(PCRedundantGetKSP(pc, &ksp), "PCRedundantGetKSP");
    check_petsc(KSPSetType(ksp, KSPPREONLY), "KSPSetType");
    check_petsc(KSPGetPC(ksp, &inner), "KSPGetPC");
  }
  check_petsc(PCSetType(inner, PCCHOLESKY), "PCSetType");
  check_petsc(PCFactorSetMatSolverType(inner, MATSOLVERMUMPS), "PCFactorSetMatSolverType");
}

}  // namespace

void choose_preconditioner(PC pc, Preconditioner kind) {
  switch (kind) {
    case Preconditioner::amg:
      set_up_amg(pc);
      break;
    case Preconditioner::cholesky:
      set_up_cholesky(pc);
      break;
    case Preconditioner::block_jacobi:
      check_petsc(PCSetType(pc, PCPBJACOBI), "PCSetType");
      break;
  }
}

SparseInverse::SparseInverse(MPI_Comm comm, PetscInt size, std::vector<PetscInt> needed, std::span<const PetscInt> rows,
                             std::span<const PetscInt> columns, Preconditioner kind)
    : comm_(comm), needed_(std::move(needed)) {
  check_petsc(VecCreateMPI(comm_, PETSC_DECIDE, size, rhs_.out()), "VecCreateMPI");
  check_petsc(VecDuplicate(rhs_.get(), solution_.out()), "VecDuplicate");
  const auto n = static_cast<PetscInt>(needed_.size());
  IndexSetHandle set;
  check_petsc(ISCreateGeneral(comm_, n, needed_.data(), PETSC_COPY_VALUES, set.out()), "ISCreateGeneral");
  check_petsc(VecCreateSeq(PETSC_COMM_SELF, n, local_.out()), "VecCreateSeq");
  check_petsc(VecScatterCreate(rhs_.get(), set.get(), local_.get(), nullptr, scatter_.out()), "VecScatterCreate");

  PetscInt begin = 0;
  PetscInt end = 0;
  check_petsc(VecGetOwnershipRange(rhs_.get(), &begin, &end), "VecGetOwnershipRange");
  std::vector<PetscInt> i, j;
  agree(comm_, [&] {
    i.reserve(rows.size() + static_cast<std::size_t>(end - begin));
    j.reserve(i.capacity());
    for (PetscInt r : rows) i.push_back(needed_[static_cast<std::size_t>(r)]);
    for (PetscInt c : columns) j.push_back(needed_[static_cast<std::size_t>(c)]);
    for (PetscInt d = begin; d < end; ++d) i.push_back(d), j.push_back(d);
  });
  check_petsc(MatCreate(comm_, matrix_.out()), "MatCreate");
  check_petsc(MatSetSizes(matrix_.get(), end - begin, end - begin, size, size), "MatSetSizes");
  check_petsc(MatSetType(matrix_.get(), MATAIJ), "MatSetType");
  check_petsc(MatSetPreallocationCOO(matrix_.get(), static_cast<PetscCount>(i.size()), i.data(), j.data()),
              "MatSetPreallocationCOO");
  check_petsc(MatSetOption(matrix_.get(), MAT_SPD, PETSC_TRUE), "MatSetOption");
  check_petsc(MatSetOption(matrix_.get(), MAT_SPD_ETERNAL, PETSC_TRUE), "MatSetOption");
  check_petsc(PCCreate(comm_, pc_.out()), "PCCreate");
  choose_preconditioner(pc_.get(), kind);
}

void SparseInverse::update(std::span<const double> values, double shift) {
  PetscInt owned = 0;
  check_petsc(VecGetLocalSize(rhs_.get(), &owned), "VecGetLocalSize");
  std::vector<double> all(values.begin(), values.end());
  all.resize(values.size() + static_cast<std::size_t>(owned), 0.0);
  check_petsc(MatSetValuesCOO(matrix_.get(), all.data(), INSERT_VALUES), "MatSetValuesCOO");
  PetscScalar trace = 0;
  PetscInt size = 0;
  check_petsc(MatGetDiagonal(matrix_.get(), solution_.get()), "MatGetDiagonal");
  check_petsc(VecSum(solution_.get(), &trace), "VecSum");
  check_petsc(VecGetSize(solution_.get(), &size), "VecGetSize");
  if (size == 0) return;
  check_petsc(MatShift(matrix_.get(), std::max(shift * trace / size, 1e-300)), "MatShift");
  check_petsc(PCSetOperators(pc_.get(), matrix_.get(), matrix_.get()), "PCSetOperators");
  check_petsc(PCSetUp(pc_.get()), "PCSetUp");
}

void SparseInverse::apply(std::span<const double> rhs, std::span<double> x) {
  PetscInt size = 0;
  check_petsc(VecGetSize(rhs_.get(), &size), "VecGetSize");
  if (size == 0) return;
  double* data = nullptr;
  check_petsc(VecGetArray(local_.get(), &data), "VecGetArray");
  std::copy(rhs.begin(), rhs.end(), data);
  check_petsc(VecRestoreArray(local_.get(), &data), "VecRestoreArray");
  check_petsc(VecSet(rhs_.get(), 0.0), "VecSet");
  check_petsc(VecScatterBegin(scatter_.get(), local_.get(), rhs_.get(), ADD_VALUES, SCATTER_REVERSE),
              "VecScatterBegin");
  check_petsc(VecScatterEnd(scatter_.get(), local_.get(), rhs_.get(), ADD_VALUES, SCATTER_REVERSE), "VecScatterEnd");
  check_petsc(PCApply(pc_.get(), rhs_.get(), solution_.get()), "PCApply");
  check_petsc(VecScatterBegin(scatter_.get(), solution_.get(), local_.get(), INSERT_VALUES, SCATTER_FORWARD),
              "VecScatterBegin");
  check_petsc(VecScatterEnd(scatter_.get(), solution_.get(), local_.get(), INSERT_VALUES, SCATTER_FORWARD),
              "VecScatterEnd");
  const double* result = nullptr;
  check_petsc(VecGetArrayRead(local_.get(), &result), "VecGetArrayRead");
  std::copy(result, result + x.size(), x.begin());
  check_petsc(VecRestoreArrayRead(local_.get(), &result), "VecRestoreArrayRead");
}

}  // namespace hexfield::solve
