#pragma once

#include <mpi.h>

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "hexfield/map/conforming_space.hpp"
#include "hexfield/mesh/distributed.hpp"
#include "hexfield/solve/minimise.hpp"
#include "hexfield/solve/tet_energy.hpp"

namespace hexfield {

/// Destroys a PETSc vector at the end of a scope.
class VecOwner {
 public:
  explicit VecOwner(Vec v) : v_(v) {}
  ~VecOwner() { VecDestroy(&v_); }
  VecOwner(const VecOwner&) = delete;
  VecOwner& operator=(const VecOwner&) = delete;
  Vec get() const { return v_; }

 private:
  Vec v_;
};

/// The tets of a mesh, dealt to the ranks, with their corner coordinates in terms of the unknowns of a
/// conforming space that rank 0 holds: what the minimisations of the map module work on.
///
/// The unknowns of the vectors are those of the space, in its order, and rank 0 owns them all: the element work is
/// shared, the factorisations are not, and results are the same bytes for any number of ranks.
class MapProblem {
 public:
  /// `mesh` and `space` are read on rank 0 and must outlive the object there. Collective.
  MapProblem(MPI_Comm comm, const TetMesh& mesh, const ConformingSpace& space);

  MPI_Comm comm() const { return comm_; }
  /// The inputs; complete on rank 0 only.
  const TetMesh& mesh() const { return mesh_; }
  const ConformingSpace& space() const { return space_; }
  std::size_t num_tets() const { return distributed_.num_owned(); }
  double total_volume() const { return total_volume_; }
  double volume(std::size_t tet) const { return volumes_[tet]; }
  const DistributedMesh& distributed() const { return distributed_; }
  PetscInt num_reals() const { return num_reals_; }
  PetscInt num_integers() const { return num_integers_; }

  /// Adds one element per owned tet to `energy` with weights[t] and frames[t].
  /// Coordinates on integer unknowns are constants when `fixed` holds their values.
  template <class Energy>
  void add_elements(Energy& energy, std::span<const double> weights, std::span<const Mat3> frames,
                    std::span<const double> fixed) const {
    std::array<solve::AffineScalar, 12> corners;
    for (std::size_t t = 0; t < num_tets(); ++t) {
      corners_of(t, fixed, corners);
      energy.add(gradients_[t], weights[t], corners, frames[t]);
    }
  }
  /// Share of every owned tet in the total volume.
  std::vector<double> volume_weights() const;
  /// Weights of the same sum that grow with the edge length of a tet (cube root of its volume) only.
  std::vector<double> length_weights() const;
  /// The same frame for every owned tet: `edge` times the identity.
  std::vector<Mat3> uniform_frames(double edge) const;
  /// Sends one matrix per tet from rank 0 to its owner. Collective.
  std::vector<Mat3> scatter_matrices(std::span<const Mat3> on_root) const;

  /// A vector of the unknowns (without the integer ones when `reals_only`) with values from rank 0.
  /// Collective; the caller destroys it.
  Vec make_vector(std::span<const double> on_root, bool reals_only) const;
  /// The values of such a vector on rank 0 (empty elsewhere). With reals only, `fixed` completes it.
  std::vector<double> gather(Vec y, std::span<const double> fixed) const;
  /// Index of integer unknown i.
  PetscInt integer_index(std::size_t i) const { return num_reals_ + static_cast<PetscInt>(i); }
  /// Whether this rank owns the unknowns.
  bool owns_unknowns() const;

 private:
  void corners_of(std::size_t tet, std::span<const double> fixed, std::array<solve::AffineScalar, 12>& corners) const;
  void deal_rows();

  MPI_Comm comm_;
  const TetMesh& mesh_;
  const ConformingSpace& space_;
  DistributedMesh distributed_;
  PetscInt num_reals_ = 0;
  PetscInt num_integers_ = 0;
  double total_volume_ = 0;
  std::vector<double> volumes_;
  std::vector<solve::GradientOperator> gradients_;
  std::vector<PetscInt> rows_;  // 12 per owned tet: number of entries
  std::vector<PetscInt> columns_;
  std::vector<std::int32_t> coefficients_;
  std::vector<std::size_t> first_;  // of each owned tet in columns_
};

}  // namespace hexfield
