#include <fmt/format.h>

#include <algorithm>

#include "cell_soup.hpp"

namespace hexfield::io {
namespace {

Vec3 centre(const CellSoup& soup, Shape s, std::size_t cell) {
  const auto n = static_cast<std::size_t>(shape_corners[static_cast<std::size_t>(s)]);
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < n; ++k)
    sum += soup.points[static_cast<std::size_t>(soup.block(s).vertices[n * cell + k])];
  return sum / static_cast<double>(n);
}

[[noreturn]] void refuse(const CellSoup& soup, Shape s, std::size_t cell, const std::string& reason) {
  const Vec3 c = centre(soup, s, cell);
  const std::int64_t id = soup.block(s).ids[cell];
  throw Error(ExitCode::bad_input,
              fmt::format("{}: {} {} ({}) at ({:.6g}, {:.6g}, {:.6g}) {}.", soup.file, soup.cell_word, id,
                          shape_name[static_cast<std::size_t>(s)], c.x(), c.y(), c.z(), reason),
              {id}, {c});
}

void refuse_shape(const CellSoup& soup, Shape s, const char* reason) {
  if (soup.block(s).size() > 0) refuse(soup, s, 0, reason);
}

// New index of every point that a tet uses, in the old order; -1 for the others.
std::vector<std::int32_t> used_points(const CellSoup& soup, std::vector<Vec3>& points) {
  std::vector<std::int32_t> index(soup.points.size(), -1);
  for (std::int32_t v : soup.block(Shape::tet).vertices) index[static_cast<std::size_t>(v)] = 0;
  for (std::size_t i = 0; i < index.size(); ++i)
    if (index[i] == 0) {
      index[i] = static_cast<std::int32_t>(points.size());
      points.push_back(soup.points[i]);
    }
  return index;
}

// Calls keep(cell, vertex ids) for every tagged cell of a shape; a vertex that no tet uses is invalid.
template <std::size_t N, class Keep>
void for_tagged(const CellSoup& soup, Shape s, const std::vector<std::int32_t>& index, const Keep& keep) {
  const CellBlock& b = soup.block(s);
  for (std::size_t c = 0; c < b.size(); ++c) {
    if (b.colours[c] <= 0) continue;
    std::array<VertexId, N> v;
    for (std::size_t k = 0; k < N; ++k) v[k] = VertexId(index[static_cast<std::size_t>(b.vertices[N * c + k])]);
    keep(c, v);
  }
}

Features features_of(const CellSoup& soup, const TetMesh& mesh, const std::vector<std::int32_t>& index) {
  Features features;
  for_tagged<1>(soup, Shape::point, index, [&](std::size_t c, const std::array<VertexId, 1>& v) {
    if (!v[0].valid()) refuse(soup, Shape::point, c, "is tagged but is no corner of a tetrahedron");
    features.points.emplace(v[0], soup.block(Shape::point).colours[c]);
  });
  for_tagged<2>(soup, Shape::line, index, [&](std::size_t c, const std::array<VertexId, 2>& v) {
    if (!v[0].valid() || !v[1].valid() || v[0] == v[1] || !find_tet_with_edge(mesh, v[0], v[1]).valid())
      refuse(soup, Shape::line, c, "is tagged but is no edge of a tetrahedron");
    features.edges.emplace(edge_key(v[0], v[1]), soup.block(Shape::line).colours[c]);
  });
  for_tagged<3>(soup, Shape::triangle, index, [&](std::size_t c, const std::array<VertexId, 3>& v) {
    const FaceKey key = face_key(v[0], v[1], v[2]);
    if (!key[0].valid() || !find_half_face(mesh, key).valid())
      refuse(soup, Shape::triangle, c, "is tagged but is no face of a tetrahedron");
    features.faces.emplace(key, soup.block(Shape::triangle).colours[c]);
  });
  features.names = soup.names;
  const auto& colours = soup.block(Shape::tet).colours;
  const bool unnamed = std::all_of(colours.begin(), colours.end(), [&](int c) { return c == colours[0] && c <= 1; }) &&
                       !soup.names.contains({3, colours[0]});
  if (!unnamed) features.tet_colours = colours;
  return features;
}

}  // namespace

TetInput assemble_tets(const CellSoup& soup) {
  check_soup(soup);
  refuse_shape(soup, Shape::hex, "cannot be part of a tet mesh");
  refuse_shape(soup, Shape::quad, "cannot be part of a tet mesh");
  const CellBlock& block = soup.block(Shape::tet);
  if (block.size() == 0)
    throw Error(ExitCode::bad_input, fmt::format("{}: there are no tetrahedra in it ({} points, {} other cells).",
                                                 soup.file, soup.points.size(), soup.num_cells()));
  std::vector<Vec3> points;
  const auto index = used_points(soup, points);
  std::vector<std::array<VertexId, 4>> tets(block.size());
  for (std::size_t t = 0; t < tets.size(); ++t)
    for (std::size_t k = 0; k < 4; ++k)
      tets[t][k] = VertexId(index[static_cast<std::size_t>(block.vertices[4 * t + k])]);
  TetInput input;
  input.mesh = build_tet_mesh(std::move(points), std::move(tets));
  input.features = features_of(soup, input.mesh, index);
  return input;
}

HexMesh assemble_hexes(const CellSoup& soup) {
  check_soup(soup);
  refuse_shape(soup, Shape::tet, "cannot be part of a hex mesh");
  refuse_shape(soup, Shape::triangle, "cannot be part of a hex mesh");
  if (soup.block(Shape::hex).size() == 0)
    throw Error(ExitCode::bad_input, fmt::format("{}: there are no hexahedra in it ({} points, {} other cells).",
                                                 soup.file, soup.points.size(), soup.num_cells()));
  HexMesh mesh;
  mesh.points = soup.points;
  mesh.names = soup.names;
  const auto fill = [&]<std::size_t N>(Shape s, std::size_t c, std::array<int, N>& v) {
    std::copy_n(soup.block(s).vertices.begin() + static_cast<std::ptrdiff_t>(N * c), N, v.begin());
  };
  const CellBlock& hexes = soup.block(Shape::hex);
  mesh.hexes.resize(hexes.size());
  for (std::size_t c = 0; c < hexes.size(); ++c) fill(Shape::hex, c, mesh.hexes[c]);
  const bool unnamed =
      std::all_of(hexes.colours.begin(), hexes.colours.end(), [&](int c) { return c == hexes.colours[0] && c <= 1; }) &&
      !soup.names.contains({3, hexes.colours[0]});
  if (!unnamed) mesh.hex_colours = hexes.colours;
  const CellBlock& points = soup.block(Shape::point);
  for (std::size_t c = 0; c < points.size(); ++c)
    if (points.colours[c] > 0) mesh.feature_points.push_back({points.vertices[c], points.colours[c]});
  const CellBlock& lines = soup.block(Shape::line);
  for (std::size_t c = 0; c < lines.size(); ++c)
    if (lines.colours[c] > 0)
      fill(Shape::line, c, mesh.feature_lines.emplace_back(HexMesh::Line{{}, lines.colours[c]}).vertices);
  const CellBlock& quads = soup.block(Shape::quad);
  for (std::size_t c = 0; c < quads.size(); ++c)
    if (quads.colours[c] > 0)
      fill(Shape::quad, c, mesh.feature_quads.emplace_back(HexMesh::Quad{{}, quads.colours[c]}).vertices);
  return mesh;
}

}  // namespace hexfield::io
