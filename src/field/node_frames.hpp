#pragma once

#include <span>
#include <vector>

#include "hexfield/field/spherical_harmonics.hpp"
#include "hierarchy.hpp"

namespace hexfield {

/// Frames of the local nodes of a rank and their harmonics vectors.
struct NodeFrames {
  std::vector<Quaternion> frame;
  std::vector<harmonics::Sh> sh;

  explicit NodeFrames(std::size_t local) : frame(local, Quaternion::Identity()), sh(local, harmonics::reference()) {}
};

/// Copies frames of owned nodes to the ranks where they are ghosts. Collective.
void share_frames(const NodeGraph& graph, NodeFrames& frames);

/// Energy E = sum w_ij |a_i - a_j|^2 / 2 over the edges, and its gradient by rotation vectors (3 numbers per
/// owned node, along the direction of aligned nodes, zero at fixed ones). The energy is the same on all ranks and
/// has the same bits for any number of them. Collective.
double energy_and_gradient(const NodeGraph& graph, const std::vector<NodeConstraint>& constraints,
                           const NodeFrames& frames, std::vector<double>& gradient);

/// Frames turned by `share` times the rotation vectors. Collective.
NodeFrames turned(const NodeGraph& graph, const NodeFrames& frames, const std::vector<double>& turns, double share);

/// Dot product of vectors with `width` numbers per node over the owned nodes of all ranks, with the same bits for any
/// number of ranks. Collective.
double dot(const NodeGraph& graph, int width, const std::vector<double>& a, const std::vector<double>& b);

/// Frames closest to the solution of the linear problem: vectors in R^9, two unknowns at aligned nodes [Ray et
/// al. 2016]. `iterations`: of conjugate gradients. `constraints` of local nodes, `root_constraints` read on
/// rank 0. Collective.
NodeFrames linear_start(const Hierarchy& hierarchy, const std::vector<NodeConstraint>& constraints,
                        const std::vector<NodeConstraint>& root_constraints, double tolerance, int& iterations);

}  // namespace hexfield
