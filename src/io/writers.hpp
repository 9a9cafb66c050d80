#pragma once

#include <span>
#include "cell_soup.hpp"

#include "buffered_writer.hpp"

namespace hexfield::io {

/// Write the soup, vertex indices from 0 in its order; every cell with its colour.
void write_soup(const std::filesystem::path& file, const CellSoup& soup, const WriteOptions& options);

void write_legacy_vtk(BufferedWriter& out, const CellSoup& soup, bool binary);
void write_vtu(BufferedWriter& out, const CellSoup& soup, bool binary);
void write_msh22(BufferedWriter& out, const CellSoup& soup, bool binary);
void write_msh41(BufferedWriter& out, const CellSoup& soup, bool binary);
void write_medit(BufferedWriter& out, const CellSoup& soup);
void write_abaqus(BufferedWriter& out, const CellSoup& soup);

/// Corners of a cell as a range.
inline std::span<const std::int32_t> corners(const CellSoup& soup, std::size_t shape, std::size_t cell) {
  const auto n = static_cast<std::size_t>(shape_corners[shape]);
  return std::span(soup.blocks[shape].vertices).subspan(n * cell, n);
}

}  // namespace hexfield::io
