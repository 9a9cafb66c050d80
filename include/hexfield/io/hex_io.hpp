#pragma once

#include <filesystem>

#include "hexfield/hex/hex_mesh.hpp"
#include "hexfield/io/format.hpp"

namespace hexfield {

/// Reads a hex mesh with features (vertices, lines, quads) from the formats and by the rules of read_tet_mesh();
/// all points are kept. Not collective.
HexMesh read_hex_mesh(const std::filesystem::path& file);

/// Writes hexes and features (vertices, lines, quads) with one colour per cell, and names where the format has
/// them. Legacy VTK is the layout of DESIGN section 6. The file appears complete or not at all; Error(bad_input)
/// names the path and the reason of the system. Not collective.
void write_hex_mesh(const std::filesystem::path& file, const HexMesh& mesh, const WriteOptions& options = {});

}  // namespace hexfield
