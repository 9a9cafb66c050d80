#pragma once

#include "cell_soup.hpp"
#include "scanner.hpp"

namespace hexfield::io {

/// The formats that read_soup() tells apart by their first bytes.
CellSoup read_soup(const std::filesystem::path& file);

CellSoup read_legacy_vtk(Scanner in);
CellSoup read_gmsh(Scanner in);
CellSoup read_medit(Scanner in);

}  // namespace hexfield::io
