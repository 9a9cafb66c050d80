#pragma once

#include <vector>

#include "hexfield/mesh/tet_mesh.hpp"

namespace hexfield {

/// Part (0..parts-1) of every tet of a mesh without tombstones: METIS on the dual graph, tets joined across
/// faces, equal numbers of tets, few faces between parts. Deterministic. Disconnected meshes are legal;
/// a part is empty only when there are hardly more tets than parts. Not collective.
std::vector<int> partition_tets(const TetMesh& mesh, int parts);

}  // namespace hexfield
