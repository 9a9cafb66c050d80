#pragma once

#include "cell_soup.hpp"
#include "hexfield/io/hexex_io.hpp"
#include "scanner.hpp"

namespace hexfield::io {

/// Reads a file of any format, told by its first bytes.
CellSoup read_soup(const std::filesystem::path& file);
/// The same for the content `data` of a file.
CellSoup parse_soup(const std::filesystem::path& file, std::string_view data);

CellSoup read_legacy_vtk(Scanner in);
/// `data`: the content of a file of VTK XML, one piece of an unstructured grid.
CellSoup read_vtu(const std::string& file, std::string_view data);
CellSoup read_gmsh(Scanner in);
CellSoup read_medit(Scanner in);
HexexInput read_hexex(Scanner in);

}  // namespace hexfield::io
