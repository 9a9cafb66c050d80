#pragma once

#include <cstdint>
#include <vector>

#include "fixed_map.hpp"

namespace hexfield::hex {

/// Moves images of vertices of tets that are not positive, and of their neighbours, such that the smallest shape
/// measure around each vertex grows. pinned: per vertex a mask of the axes, in the chart of its first tet, along
/// which it stays. Returns the vertices that were moved, ascending.
std::vector<VertexId> untangle_images(const TetMesh& mesh, FixedMap& map, const VertexTets& star,
                                      const std::vector<std::uint8_t>& pinned);

}  // namespace hexfield::hex
