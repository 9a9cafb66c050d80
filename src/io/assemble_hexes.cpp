#include <fmt/format.h>

#include <algorithm>

#include "cell_soup.hpp"

namespace hexfield::io {
namespace {

template <std::size_t N>
std::array<int, N> vertices_of(const CellSoup& soup, Shape s, std::size_t cell) {
  std::array<int, N> v;
  std::copy_n(soup.block(s).vertices.begin() + static_cast<std::ptrdiff_t>(N * cell), N, v.begin());
  return v;
}

void check_points(const CellSoup& soup) {
  for (std::size_t i = 0; i < soup.points.size(); ++i)
    if (!soup.points[i].allFinite())
      throw Error(ExitCode::bad_input,
                  fmt::format("{}: vertex {} at ({}, {}, {}) is no finite point.", soup.file, soup.point_id(i),
                              soup.points[i].x(), soup.points[i].y(), soup.points[i].z()),
                  {soup.point_id(i)});
}

// Calls keep(cell, colour) for every tagged cell of a shape.
template <class Keep>
void for_tagged(const CellSoup& soup, Shape s, const Keep& keep) {
  const CellBlock& b = soup.block(s);
  for (std::size_t c = 0; c < b.size(); ++c)
    if (b.colours[c] > 0) keep(c, b.colours[c]);
}

}  // namespace

HexMesh assemble_hexes(const CellSoup& soup) {
  check_indices(soup);
  check_points(soup);
  for (const Shape s : {Shape::tet, Shape::triangle})
    if (soup.block(s).size() > 0) refuse_cell(soup, s, 0, "cannot be part of a hex mesh");
  if (soup.block(Shape::hex).size() == 0) refuse_without(soup, "hexahedra");
  HexMesh mesh;
  mesh.points = soup.points;
  mesh.names = soup.names;
  mesh.hexes.resize(soup.block(Shape::hex).size());
  for (std::size_t c = 0; c < mesh.hexes.size(); ++c) mesh.hexes[c] = vertices_of<8>(soup, Shape::hex, c);
  mesh.hex_colours = volume_colours(soup, Shape::hex);
  for_tagged(soup, Shape::point, [&](std::size_t c, int colour) {
    mesh.feature_points.push_back({vertices_of<1>(soup, Shape::point, c)[0], colour});
  });
  for_tagged(soup, Shape::line, [&](std::size_t c, int colour) {
    mesh.feature_lines.push_back({vertices_of<2>(soup, Shape::line, c), colour});
  });
  for_tagged(soup, Shape::quad, [&](std::size_t c, int colour) {
    mesh.feature_quads.push_back({vertices_of<4>(soup, Shape::quad, c), colour});
  });
  return mesh;
}

}  // namespace hexfield::io
