#pragma once

#include <memory>
#include <vector>

#include "hexfield/map/conforming_space.hpp"
#include "hexfield/solve/sparse_inverse.hpp"
#include "integrable_problem.hpp"

namespace hexfield::integrable {

/// A subspace of frame fields with a Galerkin inverse on it: z += T (T^T H T)^-1 T^T r.
class CoarseSpace {
 public:
  virtual ~CoarseSpace() = default;
  /// Renews the inverse from the state of the last Problem::linearise(). Collective.
  virtual void update() = 0;
  /// Prepares for new weights. Collective.
  virtual void set_stage(const IntegrableStage& stage) = 0;
  /// Collective.
  virtual void add_correction(std::span<const double> r, std::span<double> z) = 0;
};

/// Conforming aligned maps x = N y: J = gradient of x in each tet. Off them the integrability term is stiff,
/// on them it vanishes, so their Galerkin matrix holds only distortion and jumps of normal derivatives.
/// `space` on rank 0. Collective.
std::unique_ptr<CoarseSpace> conforming_coarse_space(MPI_Comm comm, const Problem& problem,
                                                     const ConformingSpace& space, const IntegrableOptions& options);

/// Combed frames that are constant on aggregates of tets which no cut separates: smooth frames that need not
/// be gradients. `aggregates` (one per tet) and `cut` on rank 0. Collective.
std::unique_ptr<CoarseSpace> aggregate_coarse_space(MPI_Comm comm, const Problem& problem, const CutGraph& cut,
                                                    const std::vector<std::int32_t>& aggregates,
                                                    const IntegrableOptions& options);

/// Aggregates of about `size` tets, connected across faces off the cut, numbered from 0. Deterministic.
std::vector<std::int32_t> aggregate_tets(const TetMesh& mesh, const CutGraph& cut, int size);

}  // namespace hexfield::integrable
