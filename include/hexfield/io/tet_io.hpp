#pragma once

#include <filesystem>

#include "hexfield/mesh/features.hpp"
#include "hexfield/mesh/tet_mesh.hpp"

namespace hexfield {

struct TetInput {
  TetMesh mesh;
  Features features;
};

/// Reads a tet mesh with tagged features by file extension and content: legacy VTK 2.0 to 5.1, Gmsh MSH 2.2
/// and 4.1, Medit .mesh; ASCII and binary where the format has both. Refuses bad input with
/// Error(bad_input) that names file, element and place. Not collective.
TetInput read_tet_mesh(const std::filesystem::path& file);

}  // namespace hexfield
