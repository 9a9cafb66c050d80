#pragma once

#include <vector>

#include "raster.hpp"

namespace hexfield::hex {

/// The hex vertices: every lattice point of the map once, and where it is met in each closed tet.
struct LatticeVertices {
  RowTable points;                           ///< lattice points of every closed tet
  std::vector<std::int32_t> ids;             ///< hex vertex per item of `points`
  std::vector<Vec3> places;                  ///< coordinates per hex vertex, by the inverse map
  std::vector<std::int32_t> at_mesh_vertex;  ///< hex vertex per mesh vertex, or -1
};

/// A hex vertex belongs to its carrier, the simplex that has it in its interior; the lowest tet at that
/// simplex numbers it (spec-quantization 7.2).
LatticeVertices find_vertices(const TetMesh& mesh, const FixedMap& map, const VertexTets& star);

}  // namespace hexfield::hex
