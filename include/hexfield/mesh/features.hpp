#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "hexfield/mesh/tet_mesh.hpp"

namespace hexfield {

/// The tagged feature points, curves and surfaces that the hex mesh must keep, by vertex ids of a TetMesh.
/// A colour is the positive integer that the input gave the entity. Ordered maps, so that every walk over
/// features has one order.
struct Features {
  std::map<VertexId, int> points;
  std::map<EdgeKey, int> edges;
  std::map<FaceKey, int> faces;
  /// Colour (material) per tet slot of the mesh; empty when the input has one unnamed volume.
  std::vector<int> tet_colours;
  /// Names of physical groups: (dimension 0..3, colour) -> name.
  std::map<std::pair<int, int>, std::string> names;
};

}  // namespace hexfield
