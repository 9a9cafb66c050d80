#pragma once

#include "cell_soup.hpp"
#include "vtk_arrays.hpp"

namespace hexfield::io {

/// Cells as both VTK formats hold them.
struct VtkCells {
  std::vector<std::int64_t> offsets;  ///< into connectivity; one more than there are cells
  std::vector<std::int64_t> connectivity;
  std::vector<std::int64_t> types;
  std::vector<std::int64_t> colours;  ///< empty: none
};

/// How well a cell scalar of this name and type serves as the colours, lower is better: the well-known names, then any
/// integers; SIZE_MAX: not at all.
std::size_t colour_rank(std::string_view name, VtkType type);

/// Appends the cells to the soup. Fails at the scanner's place when they are none that all formats share.
void add_vtk_cells(const Scanner& in, const VtkCells& cells, CellSoup& soup);

}  // namespace hexfield::io
