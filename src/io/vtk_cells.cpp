#include "vtk_cells.hpp"

#include <fmt/format.h>

#include <array>

namespace hexfield::io {
namespace {

void add_cell(const Scanner& in, const VtkCells& cells, std::size_t cell, CellSoup& soup) {
  const auto begin = static_cast<std::size_t>(cells.offsets[cell]);
  const auto end = static_cast<std::size_t>(cells.offsets[cell + 1]);
  const auto id = static_cast<std::int64_t>(cell);
  const std::int64_t colour = cells.colours.empty() ? 0 : cells.colours[cell];
  const std::int64_t type = cells.types[cell];
  const std::int64_t* v = cells.connectivity.data();
  if (type == 2) {  // poly-vertex
    for (std::size_t k = begin; k < end; ++k) soup.add(Shape::point, v + k, colour, id);
    return;
  }
  if (type == 4) {  // poly-line
    for (std::size_t k = begin; k + 1 < end; ++k) soup.add(Shape::line, v + k, colour, id);
    return;
  }
  for (std::size_t s = 0; s < num_shapes; ++s)
    if (shape_vtk[s] == type) {
      if (end - begin != static_cast<std::size_t>(shape_corners[s]))
        in.fail(fmt::format("cell {} is a {} but has {} vertices", id, shape_name[s], end - begin));
      soup.add(static_cast<Shape>(s), v + begin, colour, id);
      return;
    }
  in.fail(
      fmt::format("cell {} has VTK type {}; only vertices (1), lines (3), triangles (5), quads (9), tets (10) and "
                  "hexes (12) are known here",
                  id, type));
}

}  // namespace

std::size_t colour_rank(std::string_view name, VtkType type) {
  static constexpr std::array<std::string_view, 4> names = {"cellentityids", "color", "colour", "feature"};
  std::size_t rank = is_integer(type) ? names.size() : SIZE_MAX;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (lower(name) == names[i] && type != VtkType::text && type != VtkType::bit) rank = i;
  return rank;
}

void add_vtk_cells(const Scanner& in, const VtkCells& cells, CellSoup& soup) {
  if (cells.offsets.size() != cells.types.size() + 1)
    in.fail(fmt::format("there are {} cells but {} cell types", cells.offsets.size() - 1, cells.types.size()));
  for (std::size_t c = 0; c < cells.types.size(); ++c) add_cell(in, cells, c, soup);
}

}  // namespace hexfield::io
