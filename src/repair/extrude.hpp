#pragma once

#include <span>
#include <vector>

#include "hexfield/repair/repair_state.hpp"

namespace hexfield {

/// The boundary half-faces at v, ascending.
std::vector<HalfFaceId> boundary_faces_at(const TetMesh& mesh, VertexId v);

/// Puts a new vertex, the cover, on top of the boundary vertex v, at its place: a tet between each of its boundary
/// faces
/// (`faces`, all of them) and the same face with the cover instead of v. The cover takes over the faces' colours; v
/// must be on no feature edge. The new tets have no volume until v is moved inside, the frames and materials of the
/// tets below and matchings identity. Returns the cover. Throws Error(bug) when the faces are no disc around v.
VertexId extrude_vertex(RepairState& state, VertexId v, std::span<const HalfFaceId> faces);

}  // namespace hexfield
