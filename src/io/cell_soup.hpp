#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hexfield/base/geometry.hpp"
#include "hexfield/hex/hex_mesh.hpp"
#include "hexfield/io/tet_io.hpp"

namespace hexfield::io {

/// The kinds of cells that all formats share; vertex order as in VTK.
enum class Shape : std::uint8_t { point, line, triangle, quad, tet, hex };
inline constexpr std::size_t num_shapes = 6;
inline constexpr std::array<int, num_shapes> shape_corners = {1, 2, 3, 4, 4, 8};
inline constexpr std::array<int, num_shapes> shape_dimension = {0, 1, 2, 2, 3, 3};
inline constexpr std::array<int, num_shapes> shape_vtk = {1, 3, 5, 9, 10, 12};
inline constexpr std::array<int, num_shapes> shape_gmsh = {15, 1, 2, 3, 4, 5};
inline constexpr std::array<const char*, num_shapes> shape_name = {"vertex",        "line",        "triangle",
                                                                   "quadrilateral", "tetrahedron", "hexahedron"};

/// Cells of one shape: `corners` vertex indices each, a colour (0: none) and the id that the file gave it.
struct CellBlock {
  std::vector<std::int32_t> vertices;
  std::vector<int> colours;
  std::vector<std::int64_t> ids;
  std::size_t negative = 0;  ///< number of cells with a negative tag, which counts as none

  std::size_t size() const { return colours.size(); }
};

/// What a mesh file holds before anything is known of its meaning: the one value between all readers and all
/// meshes, and between all meshes and all writers.
struct CellSoup {
  std::string file;                ///< for sentences
  const char* cell_word = "cell";  ///< how the format calls a cell, for sentences
  std::vector<Vec3> points;
  std::vector<std::int64_t> point_ids;  ///< id in the file; empty: index + first_point_id
  std::int64_t first_point_id = 0;
  std::array<CellBlock, num_shapes> blocks;
  std::map<std::pair<int, int>, std::string> names;

  CellBlock& block(Shape s) { return blocks[static_cast<std::size_t>(s)]; }
  const CellBlock& block(Shape s) const { return blocks[static_cast<std::size_t>(s)]; }
  std::int64_t point_id(std::size_t i) const {
    return point_ids.empty() ? static_cast<std::int64_t>(i) + first_point_id : point_ids[i];
  }
  std::size_t num_cells() const;
  /// Adds a cell whose vertices are point indices; the caller has checked their number.
  void add(Shape s, const std::int64_t* vertices, std::int64_t colour, std::int64_t id);
};

/// Refuses vertex indices out of range, by ids of the file.
void check_indices(const CellSoup& soup);
/// Error(bad_input) that names a cell, its place and the reason.
[[noreturn]] void refuse_cell(const CellSoup& soup, Shape s, std::size_t cell, const std::string& reason);
[[noreturn]] void refuse_without(const CellSoup& soup, const char* kind);
/// Colours of the tets or hexes; empty when all have the colour 1 or none and this one has no name.
std::vector<int> volume_colours(const CellSoup& soup, Shape s);

/// Tets and features of a file; drops unused points, refuses what is no tet mesh with features.
TetInput assemble_tets(const CellSoup& soup);
/// Every defect that assemble_tets() would refuse.
std::vector<Violation> check_tets(const CellSoup& soup);
HexMesh assemble_hexes(const CellSoup& soup);

CellSoup soup_of(const TetMesh& mesh, const Features& features);
CellSoup soup_of(const HexMesh& mesh);

}  // namespace hexfield::io
