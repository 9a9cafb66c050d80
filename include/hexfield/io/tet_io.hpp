#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hexfield/io/format.hpp"
#include "hexfield/mesh/features.hpp"
#include "hexfield/mesh/tet_mesh.hpp"

namespace hexfield {

struct TetInput {
  TetMesh mesh;
  Features features;
  std::vector<std::string> notes{};  ///< sentences on what was dropped or changed while reading
};

/// Reads a tet mesh with tagged features, by the content of the file: legacy VTK 2.0 to 5.1, Gmsh MSH 2.2 and 4.1
/// (ASCII and binary), Medit .mesh (ASCII).
///
/// * Points that no tet uses are dropped; the others keep their order. Tets keep the order of the file.
/// * Vertices, lines and triangles with a tag > 0 are features in that colour; others are ignored. Where two
///   cells tag the same entity the first counts. Without any tag the lists of features stay empty.
/// * VTK: the tag is the cell scalar CellEntityIds, color, colour or feature, else the first integer cell scalar.
/// * Gmsh: the tag is the physical tag (its absolute value, the sign is an orientation), else the elementary tag;
///   an elementary tag that equals a physical tag of its dimension is moved behind the largest of these.
/// * Medit: the tag is the reference; of the vertices only the Corners are features, a corner without reference
///   gets its place in the list of corners.
/// * `tet_colours` stays empty when every tet has the colour 1 or none and this colour has no name.
/// * When every tet is inverted the file uses the other orientation: all are reversed.
///
/// Refuses bad input (check_input() of mesh/input_check.hpp) with Error(bad_input) that names file, element and
/// place, by the ids of the file: VTK indices from 0, Gmsh tags, Medit indices from 1 in their list. Not collective.
TetInput read_tet_mesh(const std::filesystem::path& file);

/// Every defect of a file that could be read but holds no valid tet mesh, by the ids of the file; what cannot be read
/// is an Error as in read_tet_mesh(). Not collective.
std::vector<Violation> check_tet_file(const std::filesystem::path& file);

/// Writes tets and features (vertices, lines, triangles) with one colour per cell, and names where the format has
/// them. No tombstones. The file appears complete or not at all; Error(bad_input) names the path and the reason of
/// the system. Not collective.
void write_tet_mesh(const std::filesystem::path& file, const TetMesh& mesh, const Features& features,
                    const WriteOptions& options = {});

}  // namespace hexfield
