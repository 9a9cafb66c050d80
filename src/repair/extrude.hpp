#pragma once

#include <span>
#include <vector>

#include "hexfield/repair/repair_state.hpp"

namespace hexfield {

/// The boundary half-faces at v, ascending.
std::vector<HalfFaceId> boundary_faces_at(const TetMesh& mesh, VertexId v);

/// Puts a new vertex, the cover, at the place of a vertex v of a surface: a tet between each of the half-faces that the
/// surface has at v on the side where v goes (`faces`, all of them) and the same face with the cover instead of v. The
/// cover takes over the faces' colours, and v in the tets `beyond` the surface (all of them at v; none on the
/// boundary), with the codes of their edges. v must be on no feature edge and in no other feature face. The new tets
/// have no volume until v is moved, the frames and materials of the tets below and the matchings to beyond that those
/// had; all others are identity. Returns the cover. Throws Error(bug) when the faces are no disc around v.
VertexId extrude_vertex(RepairState& state, VertexId v, std::span<const HalfFaceId> faces,
                        std::span<const TetId> beyond = {});

/// Moves v below its cover such that all tets at v are positive, the worst as good as possible. False where no place
/// is.
bool move_below(RepairState& state, VertexId v, std::span<const HalfFaceId> covered);

}  // namespace hexfield
