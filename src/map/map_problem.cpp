#include "map_problem.hpp"

#include <petscvec.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "collective.hpp"
#include "hexfield/base/agree.hpp"
#include "hexfield/base/exact_sum.hpp"
#include "hexfield/base/petsc.hpp"
#include "hexfield/mesh/quality.hpp"

namespace hexfield {
namespace {

int size_of(MPI_Comm comm) {
  int size = 1;
  MPI_Comm_size(comm, &size);
  return size;
}

// Global ids of the owned tets of every rank, one rank after the other, on rank 0.
std::vector<std::vector<std::int64_t>> gather_owned(const DistributedMesh& mesh) {
  const MPI_Comm comm = mesh.comm();
  const int size = size_of(comm);
  const int mine = static_cast<int>(mesh.num_owned());
  std::vector<int> counts(static_cast<std::size_t>(size));
  MPI_Gather(&mine, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, comm);
  std::vector<int> starts(counts.size() + 1, 0);
  std::partial_sum(counts.begin(), counts.end(), starts.begin() + 1);
  std::vector<std::int64_t> all(static_cast<std::size_t>(starts.back()));
  MPI_Gatherv(mesh.global_tets().data(), mine, MPI_INT64_T, all.data(), counts.data(), starts.data(), MPI_INT64_T, 0,
              comm);
  std::vector<std::vector<std::int64_t>> owned(counts.size());
  if (rank_of(comm) == 0)
    for (std::size_t r = 0; r < owned.size(); ++r)
      owned[r].assign(all.begin() + starts[r], all.begin() + starts[r + 1]);
  return owned;
}

// Sends parts[r] from rank 0 to rank r.
template <class T>
std::vector<T> deal(MPI_Comm comm, MPI_Datatype type, const std::vector<std::vector<T>>& parts) {
  std::vector<int> counts(static_cast<std::size_t>(size_of(comm)), 0);
  std::vector<T> all;
  if (rank_of(comm) == 0)
    for (std::size_t r = 0; r < counts.size(); ++r) {
      counts[r] = static_cast<int>(parts[r].size());
      all.insert(all.end(), parts[r].begin(), parts[r].end());
    }
  std::vector<int> starts(counts.size(), 0);
  std::partial_sum(counts.begin(), counts.end() - 1, starts.begin() + 1);
  int mine = 0;
  MPI_Scatter(counts.data(), 1, MPI_INT, &mine, 1, MPI_INT, 0, comm);
  std::vector<T> received(static_cast<std::size_t>(mine));
  MPI_Scatterv(all.data(), counts.data(), starts.data(), type, received.data(), mine, type, 0, comm);
  return received;
}

}  // namespace

MapProblem::MapProblem(MPI_Comm comm, const TetMesh& mesh, const ConformingSpace& space)
    : comm_(comm), mesh_(mesh), space_(space), distributed_(comm, mesh) {
  deal_rows();
  const TetMesh& local = distributed_.local();
  volumes_.resize(num_tets());
  gradients_.resize(num_tets());
  double volume_sum = 0;
  for (std::size_t t = 0; t < num_tets(); ++t) {
    volumes_[t] = signed_volume6(local, TetId(t)) / 6;
    const auto& v = local.tets[t];
    gradients_[t] =
        solve::gradient_operator({local.point(v[0]), local.point(v[1]), local.point(v[2]), local.point(v[3])});
  }
  // Summed on rank 0 in global order: the same for any number of ranks.
  if (rank_of(comm_) == 0) volume_sum = hexfield::total_volume(mesh);
  MPI_Bcast(&volume_sum, 1, MPI_DOUBLE, 0, comm_);
  total_volume_ = volume_sum;
}

void MapProblem::deal_rows() {
  const ConformingSpace& space = space_;
  const std::vector<std::vector<std::int64_t>> owned = gather_owned(distributed_);
  std::vector<std::vector<PetscInt>> rows(owned.size());
  std::vector<std::vector<PetscInt>> columns(owned.size());
  std::vector<std::vector<std::int32_t>> coefficients(owned.size());
  agree(comm_, [&] {
    if (rank_of(comm_) != 0) return;
    for (std::size_t r = 0; r < owned.size(); ++r)
      for (std::int64_t t : owned[r])
        for (std::int32_t c : space.cut.classes[static_cast<std::size_t>(t)])
          for (std::size_t x = 3 * static_cast<std::size_t>(c); x < 3 * static_cast<std::size_t>(c) + 3; ++x) {
            rows[r].push_back(static_cast<PetscInt>(space.row_start[x + 1] - space.row_start[x]));
            for (std::size_t k = space.row_start[x]; k < space.row_start[x + 1]; ++k) {
              columns[r].push_back(static_cast<PetscInt>(space.columns[k]));
              coefficients[r].push_back(space.coefficients[k]);
            }
          }
  });
  rows_ = deal(comm_, MPIU_INT, rows);
  columns_ = deal(comm_, MPIU_INT, columns);
  coefficients_ = deal(comm_, MPI_INT32_T, coefficients);
  PetscInt sizes[2] = {static_cast<PetscInt>(space.num_reals), static_cast<PetscInt>(space.num_integers)};
  MPI_Bcast(sizes, 2, MPIU_INT, 0, comm_);
  num_reals_ = sizes[0];
  num_integers_ = sizes[1];
  first_.assign(1, 0);
  for (std::size_t t = 0; t < num_tets(); ++t) {
    std::size_t n = first_.back();
    for (std::size_t k = 0; k < 12; ++k) n += static_cast<std::size_t>(rows_[12 * t + k]);
    first_.push_back(n);
  }
}

void MapProblem::corners_of(std::size_t tet, std::span<const double> fixed,
                            std::array<solve::AffineScalar, 12>& corners) const {
  std::size_t entry = first_[tet];
  for (std::size_t k = 0; k < 12; ++k) {
    corners[k].entries.clear();
    corners[k].constant = 0;
    for (PetscInt i = 0; i < rows_[12 * tet + k]; ++i, ++entry) {
      const PetscInt column = columns_[entry];
      if (column >= num_reals_ && !fixed.empty())
        corners[k].constant += coefficients_[entry] * fixed[static_cast<std::size_t>(column - num_reals_)];
      else
        corners[k].entries.push_back({column, static_cast<double>(coefficients_[entry])});
    }
  }
}

std::vector<double> MapProblem::volume_weights() const {
  std::vector<double> weights = volumes_;
  for (double& w : weights) w /= total_volume_;
  return weights;
}

std::vector<double> MapProblem::length_weights() const {
  std::vector<double> weights = volumes_;
  for (double& w : weights) w = std::cbrt(w);
  const double sum = exact_sum(comm_, weights);
  for (double& w : weights) w /= sum;
  return weights;
}

std::vector<Mat3> MapProblem::uniform_frames(double edge) const {
  return std::vector<Mat3>(num_tets(), edge * Mat3::Identity());
}

std::vector<Mat3> MapProblem::scatter_matrices(std::span<const Mat3> on_root) const {
  std::vector<double> flat(9 * on_root.size());
  for (std::size_t t = 0; t < on_root.size(); ++t) std::copy_n(on_root[t].data(), 9, &flat[9 * t]);
  const std::vector<double> local = distributed_.scatter_tets(flat, 9);
  std::vector<Mat3> matrices(num_tets());
  for (std::size_t t = 0; t < matrices.size(); ++t) std::copy_n(&local[9 * t], 9, matrices[t].data());
  return matrices;
}

bool MapProblem::owns_unknowns() const { return rank_of(comm_) == 0; }

Vec MapProblem::make_vector(std::span<const double> on_root, bool reals_only) const {
  const PetscInt size = num_reals_ + (reals_only ? 0 : num_integers_);
  Vec y = nullptr;
  check_petsc(VecCreateMPI(comm_, owns_unknowns() ? size : 0, size, &y), "VecCreateMPI");
  if (!owns_unknowns()) return y;
  PetscScalar* data = nullptr;
  check_petsc(VecGetArray(y, &data), "VecGetArray");
  std::copy_n(on_root.begin(), size, data);
  check_petsc(VecRestoreArray(y, &data), "VecRestoreArray");
  return y;
}

std::vector<double> MapProblem::gather(Vec y, std::span<const double> fixed) const {
  std::vector<double> values;
  if (!owns_unknowns()) return values;
  const PetscScalar* data = nullptr;
  check_petsc(VecGetArrayRead(y, &data), "VecGetArrayRead");
  values.assign(data, data + num_reals_ + (fixed.empty() ? num_integers_ : 0));
  check_petsc(VecRestoreArrayRead(y, &data), "VecRestoreArrayRead");
  values.insert(values.end(), fixed.begin(), fixed.end());
  return values;
}

}  // namespace hexfield
