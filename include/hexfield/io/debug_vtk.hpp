#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "hexfield/base/geometry.hpp"

namespace hexfield {

/// Vertex (1 index), line (2), triangle (3) or tet (4) of a picture file, by indices into its points.
using DebugCell = std::vector<std::int32_t>;

/// One integer per cell under a name without spaces.
struct DebugScalar {
  std::string name;
  std::vector<int> values;
};

/// Legacy VTK file of any vertices, lines, triangles and tets with integer cell scalars, for pictures such as
/// why.vtk and singularities.vtk. The file appears complete or not at all; Error(bad_input) when it cannot be
/// written. Not collective.
void write_vtk_debug(const std::filesystem::path& file, std::span<const Vec3> points, std::span<const DebugCell> cells,
                     std::span<const DebugScalar> scalars);

}  // namespace hexfield
