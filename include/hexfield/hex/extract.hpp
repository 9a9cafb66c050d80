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

/// What a map with small defects holds.
struct TolerantExtraction {
  HexMesh mesh;
  /// The hexes fill the map and the mesh has the topology of the tets: as good as one of a valid map. Otherwise hexes
  /// are missing where the map has defects; those that are there are right.
  bool complete = false;
  std::vector<Violation> defects;  ///< of the map as it was given, and what is missing; empty for a valid map
  std::size_t moved = 0;           ///< vertices whose images were moved
  double missing = 0;              ///< volume of the map without hexes, in hexes
};

/// The tolerant mode of extract_hex_mesh(): corners that are off are put right, images of vertices at inverted tets
/// are moved (heal_igm), flat tets are passed through; hexes at what is still wrong then are left out. Throws only
/// where coordinates are no numbers. Not collective; the same ids for any number of threads.
TolerantExtraction extract_tolerantly(const TetMesh& mesh, const Features& features, const IntegerGridMap& map);

}  // namespace hexfield
