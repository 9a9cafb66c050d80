#include "hexfield/io/checkpoint_values.hpp"
#include "value_arrays.hpp"

namespace hexfield {
namespace {

static_assert(sizeof(HexMesh::Point) == 8 && sizeof(HexMesh::Line) == 12 && sizeof(HexMesh::Quad) == 20);

/// Vertices of rows (vertices..., colour) must be in range.
void require_rows(std::span<const std::int32_t> rows, std::size_t columns, std::size_t num_points) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i % columns + 1 != columns) require_ids(rows.subspan(i, 1), 0, num_points, "hex mesh vertex");
  }
}

}  // namespace

NamedArrays pack(const HexMesh& mesh) {
  NamedArrays arrays;
  arrays.view("points", as_numbers<double>(mesh.points, 3), 3);
  arrays.view("hexes", as_numbers<std::int32_t>(mesh.hexes, 8), 8);
  arrays.view<std::int32_t>("hex_colours", mesh.hex_colours, 1);
  arrays.view("feature_points", as_numbers<std::int32_t>(mesh.feature_points, 2), 2);
  arrays.view("feature_lines", as_numbers<std::int32_t>(mesh.feature_lines, 3), 3);
  arrays.view("feature_quads", as_numbers<std::int32_t>(mesh.feature_quads, 5), 5);
  arrays.own_text("group_names", names_text(mesh.names));
  return arrays;
}

HexMesh unpack_hex_mesh(const NamedArrays& arrays) {
  HexMesh mesh;
  mesh.points = from_numbers<Vec3>(arrays.get<double>("points", 3), 3);
  const auto hexes = arrays.get<std::int32_t>("hexes", 8);
  const auto colours = arrays.get<std::int32_t>("hex_colours", 1);
  const auto points = arrays.get<std::int32_t>("feature_points", 2);
  const auto lines = arrays.get<std::int32_t>("feature_lines", 3);
  const auto quads = arrays.get<std::int32_t>("feature_quads", 5);
  require_ids(hexes, 0, mesh.points.size(), "hex mesh vertex");
  require_rows(points, 2, mesh.points.size());
  require_rows(lines, 3, mesh.points.size());
  require_rows(quads, 5, mesh.points.size());
  require_same(colours.empty() || 8 * colours.size() == hexes.size(), "it has not one material per hex");
  mesh.hexes = from_numbers<std::array<int, 8>>(hexes, 8);
  mesh.hex_colours.assign(colours.begin(), colours.end());
  mesh.feature_points = from_numbers<HexMesh::Point>(points, 2);
  mesh.feature_lines = from_numbers<HexMesh::Line>(lines, 3);
  mesh.feature_quads = from_numbers<HexMesh::Quad>(quads, 5);
  mesh.names = names_from_text(arrays.text("group_names"));
  return mesh;
}

}  // namespace hexfield
