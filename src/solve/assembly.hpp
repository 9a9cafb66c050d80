#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "hexfield/solve/minimise.hpp"
#include "hexfield/solve/petsc_handle.hpp"

namespace hexfield::solve {

/// Evaluates sums of EnergyTerms on a distributed vector. Built once per set of terms: it finds the unknowns
/// that this rank's elements read, the scatter that fetches them and, on the first derivatives(), the
/// nonzero pattern of the Hessian. Sums over elements are exact (exact_sum.hpp, order_free.hpp): they depend neither on
/// threads nor on how the elements are dealt to the ranks.
class Assembly {
 public:
  /// Collective; `y` gives the layout. Throws Error(bug) when an index is outside it.
  Assembly(MPI_Comm comm, std::span<const EnergyTerm* const> terms, Vec y);

  double value(Vec y);
  /// Energy; writes the gradient and the Hessian. Throws Error(bug) when a derivative is not finite.
  double derivatives(Vec y, Vec gradient);
  /// The Hessian of the last derivatives().
  Mat hessian() const { return hessian_.get(); }
  /// Largest step over all elements of all ranks (may be infinite).
  double max_step(Vec y, Vec dy);
  /// Block size that the Hessian should carry; before the first derivatives().
  void set_block_size(int block_size) { block_size_ = block_size; }

 private:
  struct Term {
    const EnergyTerm* energy;
    std::vector<std::int32_t> local;       // positions in the gathered vector
    std::vector<std::size_t> first;        // CSR over elements
    std::vector<std::size_t> first_entry;  // where the element's n x n block starts in entries_
    std::size_t first_energy;              // where its elements start in energies_
    std::size_t first_gradient;            // where its unknowns start in gradients_ and row_sizes_
  };
  void collect_unknowns();
  void create_hessian(Vec y);
  void gather(Vec y, std::vector<double>& values);
  void find_grids();
  void derivatives_of(const Term& term);
  void add_gradients(std::span<double> gradient) const;
  void round_entries(const Term& term);
  double total_energy() const;
  void scatter(std::vector<double>& values, InsertMode mode);
  void largest_of_all_ranks(std::vector<double>& values) { scatter(values, MAX_VALUES); }

  MPI_Comm comm_;
  int block_size_ = 1;
  PetscInt num_local_ = 0;
  std::vector<Term> terms_;
  std::vector<PetscInt> needed_;  // global indices in the gathered vector, ascending
  std::vector<double> values_;
  std::vector<double> steps_;
  std::vector<double> energies_;        // of all elements
  std::vector<double> entries_;         // all element Hessians
  std::vector<double> gradients_;       // all element gradients
  std::vector<double> row_sizes_;       // largest entry of each row of each element Hessian
  std::vector<double> counts_;          // per needed unknown: elements of all ranks that have it
  std::vector<double> row_grids_;       // per needed unknown, for order_free()
  std::vector<double> gradient_grids_;  // the same
  VecHandle gathered_;
  VecHandle work_;  // with the layout of y
  ScatterHandle scatter_;
  MatHandle hessian_;
};

}  // namespace hexfield::solve
