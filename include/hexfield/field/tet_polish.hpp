#pragma once

#include <span>
#include <vector>

#include "hexfield/field/frame_field.hpp"
#include "hexfield/field/octahedral_smoothing.hpp"
#include "hexfield/mesh/features.hpp"

/// The octahedral field per tet as a graph problem: nodes are tets, edges are inner faces. Not collective.
namespace hexfield {

/// Tets within `layers` vertex rings of the inner edges with a monodromy, ascending.
std::vector<TetId> tets_near_singularities(const TetMesh& mesh, const FrameField& field, int layers);

/// Graph of these tets (node k is tets[k]). Weight of a face: area over the distance of the two centroids
/// (finite volumes).
RootGraph tet_graph(const TetMesh& mesh, std::span<const TetId> tets);

/// What each of these tets must keep: its frame when it has neighbours that are not listed; else the normal of
/// its feature face, the tangent of its feature edge, or the whole frame when it has both. Needs
/// split_for_features().
std::vector<NodeConstraint> tet_constraints(const TetMesh& mesh, const Features& features, const FrameField& field,
                                            std::span<const TetId> tets);

}  // namespace hexfield
