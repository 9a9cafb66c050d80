#pragma once

#include "hexfield/mesh/features.hpp"
#include "hexfield/mesh/tet_mesh.hpp"

namespace hexfield {

/// Replaces every tet of a mesh without tombstones by eight: four at its corners, four around the shortest
/// diagonal of the octahedron between them (the first one of those that are equally short). Tet t becomes
/// 8 t .. 8 t + 7; old vertices keep their ids, the midpoint of an edge gets the number of vertices plus the
/// place of the edge among all edges ascending. Features and colours follow: 2 edges, 4 faces, 8 tets for one.
/// Throws Error(bad_input) when the tets would be more than 32-bit half-faces can count. Not collective.
void refine_uniform(TetMesh& mesh, Features& features);

}  // namespace hexfield
