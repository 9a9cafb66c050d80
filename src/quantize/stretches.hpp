#pragma once

#include <vector>

#include "wall_cells.hpp"

namespace hexfield::quantize {

/// What MapQuantizer::stretches() gives; lengths satisfy the equations of all patches.
std::vector<Vec3> stretches(const ChartMesh& mesh, const WallCells& cells, std::size_t num_input_tets,
                            const std::vector<std::int64_t>& lengths);

}  // namespace hexfield::quantize
