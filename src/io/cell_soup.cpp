#include "cell_soup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace hexfield::io {
namespace {

std::int32_t narrowed(std::int64_t value) {
  return value < 0 || value > std::numeric_limits<std::int32_t>::max() ? -1 : static_cast<std::int32_t>(value);
}

}  // namespace

std::size_t CellSoup::num_cells() const {
  std::size_t n = 0;
  for (const CellBlock& b : blocks) n += b.size();
  return n;
}

void CellSoup::add(Shape s, const std::int64_t* vertices, std::int64_t colour, std::int64_t id) {
  CellBlock& b = block(s);
  for (int k = 0; k < shape_corners[static_cast<std::size_t>(s)]; ++k) b.vertices.push_back(narrowed(vertices[k]));
  if (colour > std::numeric_limits<int>::max())
    throw Error(ExitCode::bad_input, fmt::format("{}: {} {} has the tag {}, which is larger than {}.", file, cell_word,
                                                 id, colour, std::numeric_limits<int>::max()));
  b.colours.push_back(colour > 0 ? static_cast<int>(colour) : 0);
  if (colour < 0) ++b.negative;
  b.ids.push_back(id);
}

void refuse_cell(const CellSoup& soup, Shape s, std::size_t cell, const std::string& reason) {
  const auto n = static_cast<std::size_t>(shape_corners[static_cast<std::size_t>(s)]);
  Vec3 centre = Vec3::Zero();
  for (std::size_t k = 0; k < n; ++k)
    centre += soup.points[static_cast<std::size_t>(soup.block(s).vertices[n * cell + k])] / static_cast<double>(n);
  const std::int64_t id = soup.block(s).ids[cell];
  throw Error(ExitCode::bad_input,
              fmt::format("{}: {} {} ({}) at ({:.6g}, {:.6g}, {:.6g}) {}.", soup.file, soup.cell_word, id,
                          shape_name[static_cast<std::size_t>(s)], centre.x(), centre.y(), centre.z(), reason),
              {id}, {centre});
}

void refuse_without(const CellSoup& soup, const char* kind) {
  throw Error(ExitCode::bad_input, fmt::format("{}: there are no {} in it ({} points, {} other cells).", soup.file,
                                               kind, soup.points.size(), soup.num_cells()));
}

std::vector<int> volume_colours(const CellSoup& soup, Shape s) {
  const auto& colours = soup.block(s).colours;
  const bool unnamed = std::all_of(colours.begin(), colours.end(), [&](int c) { return c == colours[0] && c <= 1; }) &&
                       (colours.empty() || !soup.names.contains({3, colours[0]}));
  return unnamed ? std::vector<int>() : colours;
}

void check_indices(const CellSoup& soup) {
  constexpr std::size_t max_points = std::numeric_limits<std::int32_t>::max();
  if (soup.points.size() > max_points)
    throw Error(ExitCode::bad_input, fmt::format("{}: {} points are more than the {} that one process can number.",
                                                 soup.file, soup.points.size(), max_points));
  const auto n = static_cast<std::int64_t>(soup.points.size());
  for (std::size_t s = 0; s < num_shapes; ++s) {
    const CellBlock& b = soup.blocks[s];
    const auto corners = static_cast<std::size_t>(shape_corners[s]);
    for (std::size_t k = 0; k < b.vertices.size(); ++k)
      if (b.vertices[k] < 0 || b.vertices[k] >= n)
        throw Error(
            ExitCode::bad_input,
            fmt::format("{}: corner {} of {} {} ({}) names a vertex that does not exist; there are {} vertices.",
                        soup.file, k % corners, soup.cell_word, b.ids[k / corners], shape_name[s], n),
            {b.ids[k / corners]});
  }
}

CellSoup soup_of(const TetMesh& mesh, const Features& features) {
  CellSoup soup;
  soup.points = mesh.points;
  soup.names = features.names;
  const auto add = [&](Shape s, const auto& vertices, int colour) {
    CellBlock& b = soup.block(s);
    for (VertexId v : vertices) b.vertices.push_back(v.value);
    b.ids.push_back(static_cast<std::int64_t>(b.size()));
    b.colours.push_back(colour);
  };
  for (const auto& [v, colour] : features.points) add(Shape::point, std::array{v}, colour);
  for (const auto& [e, colour] : features.edges) add(Shape::line, e, colour);
  for (const auto& [f, colour] : features.faces) {
    // The sorted key has lost the orientation: take it from a tet at the face where there is one.
    const HalfFaceId h = find_half_face(mesh, f);
    add(Shape::triangle, h.valid() ? mesh.face_vertices(h) : f, colour);
  }
  for (std::size_t t = 0; t < mesh.num_tets(); ++t)
    if (mesh.alive(TetId(static_cast<std::int64_t>(t))))
      add(Shape::tet, mesh.tets[t], features.tet_colours.empty() ? 1 : features.tet_colours[t]);
  return soup;
}

CellSoup soup_of(const HexMesh& mesh) {
  CellSoup soup;
  soup.points = mesh.points;
  soup.names = mesh.names;
  const auto add = [&](Shape s, const auto& vertices, int colour) {
    CellBlock& b = soup.block(s);
    b.vertices.insert(b.vertices.end(), vertices.begin(), vertices.end());
    b.ids.push_back(static_cast<std::int64_t>(b.size()));
    b.colours.push_back(colour);
  };
  for (const auto& p : mesh.feature_points) add(Shape::point, std::array{p.vertex}, p.colour);
  for (const auto& l : mesh.feature_lines) add(Shape::line, l.vertices, l.colour);
  for (const auto& q : mesh.feature_quads) add(Shape::quad, q.vertices, q.colour);
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h)
    add(Shape::hex, mesh.hexes[h], mesh.hex_colours.empty() ? 1 : mesh.hex_colours[h]);
  return soup;
}

}  // namespace hexfield::io
