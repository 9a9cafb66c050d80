#include "hexfield/quantize/motorcycle_complex.hpp"

#include <algorithm>

#include "brush_fire.hpp"
#include "reduction.hpp"
#include "wall_cells.hpp"

namespace hexfield {

using namespace quantize;

BlockComplex motorcycle_complex(const TetMesh& mesh, const Features& features, const EdgeCodes& codes,
                                const SeamlessMap& map, const ComplexOptions& options) {
  // Every cut lowers the number of tori or of self-contacts; this many means that one does not.
  constexpr int max_rounds = 200;
  ChartMesh walls(mesh, features, codes, map);
  BrushFire fire(walls);
  fire.ignite_sources();
  fire.burn();
  WallCells cells(walls);
  for (int round = 0; round < max_rounds; ++round) {
    cells.build();
    if (cells.cuts().empty()) break;
    // One at a time: cutting dissolves the tets that the next one would name.
    cells.ignite(cells.cuts().front(), fire);
    fire.burn();
  }
  if (!cells.cuts().empty())
    throw Error(ExitCode::no_integer_grid_map, "Motorcycle complex: blocks go on meeting themselves.");
  for (;;) {
    const std::vector<std::int32_t> patches =
        options.reduce ? removable_patches(cells.complex) : std::vector<std::int32_t>{};
    if (patches.empty()) break;
    for (std::int32_t p : patches) cells.clear_patch(p);
    cells.build();
    if (!cells.cuts().empty())
      throw Error(ExitCode::bug, "Motorcycle complex: removing a wall made a block meet itself.");
  }
  return std::move(cells.complex);
}

}  // namespace hexfield
