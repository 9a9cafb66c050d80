#include "hexfield/quantize/motorcycle_complex.hpp"

#include <algorithm>

#include "brush_fire.hpp"
#include "reduction.hpp"
#include "wall_cells.hpp"

namespace hexfield {

void quantize::trace_and_reduce(ChartMesh& walls, WallCells& cells, bool reduce) {
  // Every cut lowers the number of tori or of self-contacts; this many means that one does not.
  constexpr int max_rounds = 200;
  BrushFire fire(walls);
  fire.ignite_sources();
  fire.burn();
  for (int round = 0; round < max_rounds; ++round) {
    cells.build();
    if (cells.cuts().empty()) break;
    // One at a time: cutting dissolves the tets that the next one would name.
    cells.ignite(cells.cuts().front(), fire);
    fire.burn();
  }
  if (!cells.cuts().empty())
    throw Error(ExitCode::no_integer_grid_map, "Motorcycle complex: blocks go on meeting themselves.");
  while (reduce) {
    const std::vector<std::int32_t> patches = removable_patches(cells.complex);
    if (patches.empty()) break;
    for (std::int32_t p : patches) cells.clear_patch(p);
    cells.build();
    if (!cells.cuts().empty())
      throw Error(ExitCode::bug, "Motorcycle complex: removing a wall made a block meet itself.");
  }
}

BlockComplex motorcycle_complex(const TetMesh& mesh, const Features& features, const EdgeCodes& codes,
                                const SeamlessMap& map, const ComplexOptions& options) {
  quantize::ChartMesh walls(mesh, features, codes, map);
  quantize::WallCells cells(walls);
  quantize::trace_and_reduce(walls, cells, options.reduce);
  return std::move(cells.complex);
}

}  // namespace hexfield
