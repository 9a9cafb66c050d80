#pragma once

#include "hexfield/hex/hex_mesh.hpp"
#include "hexfield/map/corner_map.hpp"
#include "hexfield/mesh/features.hpp"

namespace hexfield {

/// The edges and sides of the hexes as the map has them: straight and plane in every tet, not between the corners of a
/// hex. Places are in the input's space.
struct PiecewiseLinearHexes {
  struct ArcPiece {
    std::array<int, 2> vertices;  ///< of the hex mesh: the ends of the hex edge it is part of
    std::array<Vec3, 2> ends;     ///< in the order of `vertices`
    std::int64_t tet;
  };
  struct PatchPiece {
    std::array<int, 4> vertices;  ///< of the side of a hex it is part of
    std::vector<Vec3> corners;    ///< of a convex polygon
    std::int64_t tet;
  };
  HexMesh mesh;
  std::vector<ArcPiece> arcs;
  std::vector<PatchPiece> patches;
};

/// extract_hex_mesh() together with the pieces of its arcs and patches, each once: what lies in a common face or edge
/// of several tets is told for the lowest of them. Sorted by tet. Errors and threads as there. Not collective.
PiecewiseLinearHexes extract_piecewise_linear(const TetMesh& mesh, const Features& features, const IntegerGridMap& map);

}  // namespace hexfield
