#pragma once

#include <span>
#include <vector>

#include "hexfield/field/frame_field.hpp"
#include "hexfield/field/octahedral_smoothing.hpp"
#include "hexfield/mesh/features.hpp"

/// The octahedral field per tet as a graph problem: nodes are tets, edges are inner faces. Not collective.
namespace hexfield {

/// Weight of a face: area over the distance of the two centroids (finite volumes).
RootGraph tet_graph(const TetMesh& mesh);

/// What the features at a tet ask of its frame: the normal of its feature face, the tangent of its feature
/// edge, or the whole frame when it has both. Needs split_for_features().
std::vector<NodeConstraint> tet_constraints(const TetMesh& mesh, const Features& features);

}  // namespace hexfield
