#pragma once

#include <vector>

#include "hexfield/field/octahedral_smoothing.hpp"
#include "hexfield/mesh/features.hpp"
#include "hexfield/mesh/tet_mesh.hpp"

/// Preparation of the octahedral field on the vertices of a mesh. Nothing here is collective.
namespace hexfield {

/// Graph of the mesh edges with positive weights: the cotangent (finite-element) weight of the edge, but at
/// least a tenth of the volume weight sum V_t / |e|^2, which is of the same order and always positive.
RootGraph vertex_graph(const TetMesh& mesh);

/// What features ask of the frame at every vertex (spec-lmff section 2):
///  * on feature faces only: one axis along the mean normal; free when normals differ by more than
///    `normal_deviation_degrees`;
///  * inside a feature curve: one axis along the tangent, and the whole frame when the normals of the faces
///    at the curve lie at right angles around it;
///  * at feature nodes: the whole frame when tangents and normals fit one, else free.
std::vector<NodeConstraint> vertex_constraints(const TetMesh& mesh, const Features& features,
                                               double normal_deviation_degrees);

}  // namespace hexfield
