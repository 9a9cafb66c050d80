#pragma once

#include <vector>

#include "hexfield/mesh/tet_mesh.hpp"

namespace hexfield {

/// Edges with more than two boundary faces, and vertices at which the boundary touches itself. A mesh with
/// them is legal to read, but the walks of mesh/tet_mesh.hpp see only one fan of such an edge or vertex.
/// Vertices whose only fault is a non-manifold edge are not listed.
std::vector<Violation> find_non_manifold(const TetMesh& mesh);

}  // namespace hexfield
