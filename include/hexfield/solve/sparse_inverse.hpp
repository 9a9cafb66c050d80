#pragma once

#include <span>
#include <vector>

#include "hexfield/solve/minimise.hpp"
#include "hexfield/solve/petsc_handle.hpp"

namespace hexfield::solve {

/// Sets `pc` up as one of our preconditioners: BoomerAMG, Cholesky by MUMPS (each rank factorises the whole
/// matrix, so that equal runs give equal bytes), point blocks. Collective.
void choose_preconditioner(PC pc, Preconditioner kind);

/// (Approximate) inverse of a symmetric positive-definite matrix that is summed from local entries, with
/// vectors that every rank reads and adds to at its own list of unknowns. For coarse spaces. Collective.
class SparseInverse {
 public:
  /// `needed`: ascending global unknowns (of `size`) that this rank touches. rows/columns: positions in `needed`
  /// of the entries that update() will sum; the pattern stays.
  SparseInverse(MPI_Comm comm, PetscInt size, std::vector<PetscInt> needed, std::span<const PetscInt> rows,
                std::span<const PetscInt> columns, Preconditioner kind);

  /// New values (one per entry; duplicates add up) and a new factorisation.
  /// A multiple `shift` of the mean diagonal is added.
  void update(std::span<const double> values, double shift);
  /// x ~ matrix^-1 (sum over ranks of rhs); both by position in `needed`. One application, no iteration.
  void apply(std::span<const double> rhs, std::span<double> x);
  std::size_t num_needed() const { return needed_.size(); }

 private:
  MPI_Comm comm_;
  std::vector<PetscInt> needed_;
  MatHandle matrix_;
  PcHandle pc_;
  VecHandle rhs_, solution_, local_;
  ScatterHandle scatter_;
};

}  // namespace hexfield::solve
