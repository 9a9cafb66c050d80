#pragma once

#include "hexfield/hex/hex_mesh.hpp"
#include "hexfield/map/corner_map.hpp"
#include "hexfield/mesh/features.hpp"

namespace hexfield {

/// Stage 7: the hex mesh that a valid integer-grid map holds, with the features of the tet mesh as
/// vertices, lines and quads in their colours (spec-quantization section 7). Exact predicates; the same
/// ids for any number of threads. Not collective (rank 0 holds the mesh).
/// Throws Error(bad_hex_mesh) naming tets and coordinates when the map is not valid or not integer.
HexMesh extract_hex_mesh(const TetMesh& mesh, const Features& features, const IntegerGridMap& map);

}  // namespace hexfield
