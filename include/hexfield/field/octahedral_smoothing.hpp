#pragma once

#include <mpi.h>

#include <cstdint>
#include <functional>
#include <vector>

#include "hexfield/base/control.hpp"
#include "hexfield/base/geometry.hpp"

namespace hexfield {

/// Symmetric weighted graph on rank 0: compressed rows, neighbours ascending, no loops, positive weights.
struct RootGraph {
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int32_t> neighbours;
  std::vector<double> weights;
  std::size_t size() const { return offsets.size() - 1; }
};

/// What the frame of a node must keep.
struct NodeConstraint {
  enum class Kind { free, aligned, fixed };
  Kind kind = Kind::free;
  Vec3 direction = Vec3::UnitZ();             ///< aligned: unit vector that is one of the axes
  Quaternion frame = Quaternion::Identity();  ///< fixed: the frame
};

struct SmoothingOptions {
  int max_iterations = 300;
  double tolerance = 1e-6;         ///< relative decrease of the energy in five steps that ends it
  double linear_tolerance = 1e-5;  ///< relative residual of the linear problem to start from
  double max_turn = 0.4;           ///< radians, largest turn of a frame in one step
};

struct SmoothingReport {
  std::vector<double> energies;  ///< sum of w_ij |a_i - a_j|^2 / 2: at the start and after every step
  int linear_iterations = 0;     ///< of conjugate gradients for the linear start
  bool converged = false;
};

/// Smoothest octahedral frames on the nodes of a graph: least sum of w_ij |a_i - a_j|^2 over unit harmonics
/// vectors a_i = D(R_i) a0, constraints exact. Starts from the linear problem (vectors in R^9; aligned nodes
/// keep two unknowns) projected node by node [Ray et al. 2016], or from `start`; then steps of limited-memory BFGS on
/// one rotation vector per free node, one angle per aligned node. Conjugate gradients and BFGS steps are both
/// preconditioned by one V-cycle of an algebraic multigrid for the graph Laplacian, set up once.
/// Graph, constraints, start and result live on rank 0. The same bytes for any number of ranks and threads. Collective.
std::vector<Quaternion> smooth_octahedral_field(MPI_Comm comm, const RootGraph& graph,
                                                const std::vector<NodeConstraint>& constraints,
                                                const std::vector<Quaternion>* start, const SmoothingOptions& options,
                                                SmoothingReport& report, const Control& control);

}  // namespace hexfield
