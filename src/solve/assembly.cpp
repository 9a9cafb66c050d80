#include "assembly.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "hexfield/base/agree.hpp"
#include "hexfield/base/error.hpp"
#include "hexfield/base/exact_sum.hpp"
#include "hexfield/base/parallel.hpp"
#include "hexfield/base/petsc.hpp"
#include "order_free.hpp"

namespace hexfield::solve {
namespace {

constexpr std::size_t grain = 128;

// Calls body(e, unknowns of e copied from `values`) for the elements [begin, end).
template <class Local, class Body>
void for_elements(const Local& term, const std::vector<double>& values, std::size_t begin, std::size_t end, Body body) {
  std::vector<double> y;
  for (std::size_t e = begin; e < end; ++e) {
    y.clear();
    for (std::size_t k = term.first[e]; k < term.first[e + 1]; ++k)
      y.push_back(values[static_cast<std::size_t>(term.local[k])]);
    body(e, std::span<const double>(y));
  }
}

}  // namespace

Assembly::Assembly(MPI_Comm comm, std::span<const EnergyTerm* const> terms, Vec y) : comm_(comm) {
  PetscInt size = 0;
  check_petsc(VecGetSize(y, &size), "VecGetSize");
  check_petsc(VecGetLocalSize(y, &num_local_), "VecGetLocalSize");
  agree(comm_, [&] {
    for (const EnergyTerm* energy : terms) terms_.push_back({energy, {}, {0}, {}, 0, 0});
    collect_unknowns();
    if (!needed_.empty() && (needed_.front() < 0 || needed_.back() >= size))
      throw Error(ExitCode::bug, fmt::format("An energy term names unknown {} of {}.",
                                             needed_.front() < 0 ? needed_.front() : needed_.back(), size));
  });
  const auto n = static_cast<PetscInt>(needed_.size());
  Handle<IS, ISDestroy> set;
  check_petsc(ISCreateGeneral(comm_, n, needed_.data(), PETSC_COPY_VALUES, set.out()), "ISCreateGeneral");
  check_petsc(VecCreateSeq(PETSC_COMM_SELF, n, gathered_.out()), "VecCreateSeq");
  check_petsc(VecScatterCreate(y, set.get(), gathered_.get(), nullptr, scatter_.out()), "VecScatterCreate");
  check_petsc(VecDuplicate(y, work_.out()), "VecDuplicate");
}

void Assembly::collect_unknowns() {
  for (Term& term : terms_)
    for (std::size_t e = 0; e < term.energy->num_elements(); ++e) {
      const auto unknowns = term.energy->unknowns(e);
      needed_.insert(needed_.end(), unknowns.begin(), unknowns.end());
      if (needed_.size() > (1u << 24)) {
        std::sort(needed_.begin(), needed_.end());
        needed_.erase(std::unique(needed_.begin(), needed_.end()), needed_.end());
      }
    }
  std::sort(needed_.begin(), needed_.end());
  needed_.erase(std::unique(needed_.begin(), needed_.end()), needed_.end());
  std::size_t entries = 0;
  std::size_t elements = 0;
  std::size_t gradients = 0;
  for (Term& term : terms_) {
    term.first_energy = elements;
    term.first_gradient = gradients;
    for (std::size_t e = 0; e < term.energy->num_elements(); ++e) {
      const auto unknowns = term.energy->unknowns(e);
      for (PetscInt u : unknowns)
        term.local.push_back(
            static_cast<std::int32_t>(std::lower_bound(needed_.begin(), needed_.end(), u) - needed_.begin()));
      term.first.push_back(term.local.size());
      term.first_entry.push_back(entries);
      entries += unknowns.size() * unknowns.size();
    }
    elements += term.energy->num_elements();
    gradients += term.local.size();
  }
  energies_.assign(elements, 0.0);
}

void Assembly::create_hessian(Vec y) {
  std::size_t entries = 0;
  std::size_t gradients = 0;
  for (const Term& term : terms_)
    for (std::size_t e = 0; e + 1 < term.first.size(); ++e) {
      const std::size_t n = term.first[e + 1] - term.first[e];
      entries += n * n;
      gradients += n;
    }
  std::vector<PetscInt> rows;
  std::vector<PetscInt> columns;
  agree(comm_, [&] {
    entries_.assign(entries, 0.0);
    gradients_.assign(gradients, 0.0);
    row_sizes_.assign(gradients, 0.0);
    row_grids_.assign(needed_.size(), 0.0);
    gradient_grids_.assign(needed_.size(), 0.0);
    counts_.assign(needed_.size(), 0.0);
    for (const Term& term : terms_)
      for (std::int32_t u : term.local) counts_[static_cast<std::size_t>(u)] += 1;
    rows.reserve(entries + static_cast<std::size_t>(num_local_));
    columns.reserve(rows.capacity());
    for (const Term& term : terms_)
      for (std::size_t e = 0; e + 1 < term.first.size(); ++e)
        for (std::size_t i = term.first[e]; i < term.first[e + 1]; ++i)
          for (std::size_t k = term.first[e]; k < term.first[e + 1]; ++k) {
            rows.push_back(needed_[static_cast<std::size_t>(term.local[i])]);
            columns.push_back(needed_[static_cast<std::size_t>(term.local[k])]);
          }
    // Every diagonal entry exists, also of unknowns that no element reads.
    PetscInt begin = 0;
    check_petsc(VecGetOwnershipRange(y, &begin, nullptr), "VecGetOwnershipRange");
    for (PetscInt i = begin; i < begin + num_local_; ++i) {
      rows.push_back(i);
      columns.push_back(i);
      entries_.push_back(0.0);
    }
  });
  scatter(counts_, ADD_VALUES);
  check_petsc(MatCreate(comm_, hessian_.out()), "MatCreate");
  check_petsc(MatSetSizes(hessian_.get(), num_local_, num_local_, PETSC_DETERMINE, PETSC_DETERMINE), "MatSetSizes");
  check_petsc(MatSetType(hessian_.get(), MATAIJ), "MatSetType");
  check_petsc(MatSetBlockSize(hessian_.get(), block_size_), "MatSetBlockSize");
  check_petsc(MatSetPreallocationCOO(hessian_.get(), static_cast<PetscCount>(rows.size()), rows.data(), columns.data()),
              "MatSetPreallocationCOO");
  // The coordinate assembly of a distributed matrix forgets the block size of its diagonal part (PETSc 3.18),
  // and point-block preconditioners then read wrong blocks.
  Mat diagonal = nullptr;
  check_petsc(MatGetDiagonalBlock(hessian_.get(), &diagonal), "MatGetDiagonalBlock");
  check_petsc(MatSetBlockSize(diagonal, block_size_), "MatSetBlockSize");
  check_petsc(MatSetOption(hessian_.get(), MAT_SYMMETRIC, PETSC_TRUE), "MatSetOption");
  check_petsc(MatSetOption(hessian_.get(), MAT_SYMMETRY_ETERNAL, PETSC_TRUE), "MatSetOption");
  check_petsc(MatSetOption(hessian_.get(), MAT_SPD, PETSC_TRUE), "MatSetOption");
}

void Assembly::gather(Vec y, std::vector<double>& values) {
  check_petsc(VecScatterBegin(scatter_.get(), y, gathered_.get(), INSERT_VALUES, SCATTER_FORWARD), "VecScatterBegin");
  check_petsc(VecScatterEnd(scatter_.get(), y, gathered_.get(), INSERT_VALUES, SCATTER_FORWARD), "VecScatterEnd");
  const double* data = nullptr;
  check_petsc(VecGetArrayRead(gathered_.get(), &data), "VecGetArrayRead");
  values.assign(data, data + needed_.size());
  check_petsc(VecRestoreArrayRead(gathered_.get(), &data), "VecRestoreArrayRead");
}

// Replaces the values at the needed unknowns by their sum or maximum over all ranks.
void Assembly::scatter(std::vector<double>& values, InsertMode mode) {
  double* data = nullptr;
  check_petsc(VecGetArray(gathered_.get(), &data), "VecGetArray");
  std::copy(values.begin(), values.end(), data);
  check_petsc(VecRestoreArray(gathered_.get(), &data), "VecRestoreArray");
  check_petsc(VecSet(work_.get(), 0.0), "VecSet");
  check_petsc(VecScatterBegin(scatter_.get(), gathered_.get(), work_.get(), mode, SCATTER_REVERSE), "VecScatterBegin");
  check_petsc(VecScatterEnd(scatter_.get(), gathered_.get(), work_.get(), mode, SCATTER_REVERSE), "VecScatterEnd");
  gather(work_.get(), values);
}

double Assembly::total_energy() const {
  const double energy = exact_sum(comm_, energies_);
  return std::isnan(energy) ? std::numeric_limits<double>::infinity() : energy;
}

double Assembly::value(Vec y) {
  gather(y, values_);
  agree(comm_, [&] {
    for (const Term& term : terms_)
      parallel_for(term.energy->num_elements(), grain, [&](std::size_t begin, std::size_t end) {
        for_elements(term, values_, begin, end, [&](std::size_t e, std::span<const double> y_e) {
          energies_[term.first_energy + e] = term.energy->value(e, y_e);
        });
      });
  });
  return total_energy();
}

void Assembly::derivatives_of(const Term& term) {
  parallel_for(term.energy->num_elements(), grain, [&](std::size_t begin, std::size_t end) {
    for_elements(term, values_, begin, end, [&](std::size_t e, std::span<const double> y) {
      const std::size_t n = y.size();
      const std::size_t start = term.first_gradient + term.first[e];
      double* h = entries_.data() + term.first_entry[e];
      energies_[term.first_energy + e] = term.energy->derivatives(e, y, {gradients_.data() + start, n}, {h, n * n});
      for (std::size_t i = 0; i < n; ++i) {
        double largest = 0;
        for (std::size_t k = 0; k < n; ++k) {
          const double size = std::abs(h[i * n + k]);
          largest = std::isfinite(size) ? std::max(largest, size) : std::numeric_limits<double>::infinity();
        }
        row_sizes_[start + i] = largest;
      }
    });
  });
}

// The grids on which sums of element gradients and Hessians are exact.
void Assembly::find_grids() {
  std::fill(row_grids_.begin(), row_grids_.end(), 0.0);
  std::fill(gradient_grids_.begin(), gradient_grids_.end(), 0.0);
  for (const Term& term : terms_)
    for (std::size_t k = 0; k < term.local.size(); ++k) {
      const auto u = static_cast<std::size_t>(term.local[k]);
      const double g = std::abs(gradients_[term.first_gradient + k]);
      gradient_grids_[u] = std::isfinite(g) ? std::max(gradient_grids_[u], g) : std::numeric_limits<double>::infinity();
      row_grids_[u] = std::max(row_grids_[u], row_sizes_[term.first_gradient + k]);
    }
  largest_of_all_ranks(gradient_grids_);
  largest_of_all_ranks(row_grids_);
  agree(comm_, [&] {
    for (double g : gradient_grids_) require(std::isfinite(g), "A gradient of an energy is not finite.");
    for (double h : row_grids_) require(std::isfinite(h), "A Hessian of an energy is not finite.");
    for (std::size_t u = 0; u < needed_.size(); ++u) {
      gradient_grids_[u] = order_free_grid(gradient_grids_[u], counts_[u]);
      row_grids_[u] = order_free_grid(row_grids_[u], counts_[u]);
    }
  });
}

// The Hessian is symmetric: no entry is larger than the largest of its row or of its column.
void Assembly::round_entries(const Term& term) {
  parallel_for(term.energy->num_elements(), grain, [&](std::size_t begin, std::size_t end) {
    for_elements(term, row_grids_, begin, end, [&](std::size_t e, std::span<const double> grids) {
      const std::size_t n = grids.size();
      double* h = entries_.data() + term.first_entry[e];
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < n; ++k) h[i * n + k] = order_free(h[i * n + k], std::min(grids[i], grids[k]));
    });
  });
}

void Assembly::add_gradients(std::span<double> gradient) const {
  for (const Term& term : terms_)
    for (std::size_t k = 0; k < term.local.size(); ++k) {
      const auto u = static_cast<std::size_t>(term.local[k]);
      gradient[u] += order_free(gradients_[term.first_gradient + k], gradient_grids_[u]);
    }
}

double Assembly::derivatives(Vec y, Vec gradient) {
  if (hessian_.get() == nullptr) create_hessian(y);
  gather(y, values_);
  agree(comm_, [&] {
    for (const Term& term : terms_) derivatives_of(term);
  });
  find_grids();
  check_petsc(VecSet(gathered_.get(), 0.0), "VecSet");
  agree(comm_, [&] {
    for (const Term& term : terms_) round_entries(term);
    double* data = nullptr;
    check_petsc(VecGetArray(gathered_.get(), &data), "VecGetArray");
    add_gradients({data, needed_.size()});
    check_petsc(VecRestoreArray(gathered_.get(), &data), "VecRestoreArray");
  });
  check_petsc(VecSet(gradient, 0.0), "VecSet");
  check_petsc(VecScatterBegin(scatter_.get(), gathered_.get(), gradient, ADD_VALUES, SCATTER_REVERSE),
              "VecScatterBegin");
  check_petsc(VecScatterEnd(scatter_.get(), gathered_.get(), gradient, ADD_VALUES, SCATTER_REVERSE), "VecScatterEnd");
  check_petsc(MatSetValuesCOO(hessian_.get(), entries_.data(), INSERT_VALUES), "MatSetValuesCOO");
  return total_energy();
}

double Assembly::max_step(Vec y, Vec dy) {
  gather(y, values_);
  gather(dy, steps_);
  double step = std::numeric_limits<double>::infinity();
  agree(comm_, [&] {
    for (const Term& term : terms_) {
      const std::size_t n = term.energy->num_elements();
      std::vector<double> least((n + grain - 1) / grain, step);
      parallel_for(n, grain, [&](std::size_t begin, std::size_t end) {
        std::vector<double> dy_e;
        for_elements(term, values_, begin, end, [&](std::size_t e, std::span<const double> y_e) {
          dy_e.clear();
          for (std::size_t k = term.first[e]; k < term.first[e + 1]; ++k)
            dy_e.push_back(steps_[static_cast<std::size_t>(term.local[k])]);
          least[begin / grain] = std::min(least[begin / grain], term.energy->max_step(e, y_e, dy_e));
        });
      });
      for (double s : least) step = std::min(step, s);
    }
  });
  MPI_Allreduce(MPI_IN_PLACE, &step, 1, MPI_DOUBLE, MPI_MIN, comm_);
  return step;
}

}  // namespace hexfield::solve
