#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "hexfield/hex/sheet.hpp"
#include "sheet_features.hpp"

namespace hexfield {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

Vec3 middle(const HexMesh& mesh, const auto& vertices) {
  Vec3 sum = Vec3::Zero();
  for (int v : vertices) sum += mesh.points[at(v)];
  return sum / static_cast<double>(vertices.size());
}

/// The mean of the ends of some steps from a vertex.
struct Aim {
  Vec3 sum = Vec3::Zero();
  int count = 0;
  void add(const Vec3& p) {
    sum += p;
    ++count;
  }
};

// Places of the two copies of each vertex of a sheet: towards the middle of what lies on its side, of the lines where
// a feature line crosses, of the boundary quads on the boundary, else of the hexes.
class CopyPlacer {
 public:
  CopyPlacer(const HexMesh& mesh, const HexComplex& complex, const SheetSides& sides) : mesh_(mesh), complex_(complex) {
    b_corners_ = &sides.b_corners;
    for (const auto& line : mesh.feature_lines) lines_.insert(complex.find_edge(line.vertices[0], line.vertices[1]));
    for (const auto& point : mesh.feature_points) points_.insert(point.vertex);
  }

  // Places on side A and on side B.
  std::array<Vec3, 2> places(int v, double gap, const std::vector<char>& on_sheet) const {
    const Vec3 x = mesh_.points[at(v)];
    std::array<Aim, 2> hexes;
    std::array<Aim, 2> surface;
    std::array<Aim, 2> line;
    int lines_along = 0;
    for (int slot : complex_.vertex_corners[v]) {
      const std::size_t side = std::binary_search(b_corners_->begin(), b_corners_->end(), slot) ? 1 : 0;
      hexes[side].add(middle(mesh_, mesh_.hexes[at(slot / 8)]));
      for (int q : complex_.hex_quads[at(slot / 8)]) {
        const auto& quad = complex_.quads[at(q)];
        if (!complex_.is_boundary_quad(q) || std::find(quad.begin(), quad.end(), v) == quad.end()) continue;
        surface[side].add(middle(mesh_, quad));
        for (std::size_t k = 0; k < 4; ++k) {
          const int e = complex_.quad_edges[at(q)][k];
          const auto& ends = complex_.edges[at(e)];
          if ((ends[0] != v && ends[1] != v) || !lines_.contains(e)) continue;
          if (on_sheet[at(e)] != 0)
            ++lines_along;
          else
            line[side].add(mesh_.points[at(complex_.other_end(e, v))]);
        }
      }
    }
    const auto& aims = line[0].count > 0 && line[1].count > 0         ? line
                       : surface[0].count > 0 && surface[1].count > 0 ? surface
                                                                      : hexes;
    // To both sides alike, so that the middle of the copies is where the vertex was.
    const Vec3 step = gap * (aims[1].sum / aims[1].count - aims[0].sum / aims[0].count) / 2;
    std::array<Vec3, 2> out{x - step, x + step};
    if (lines_along > 0) out[1] = x;  // a line along the sheet stays with side B and in its place
    if (points_.contains(v)) out[line[1].count > line[0].count ? 1 : 0] = x;
    return out;
  }

 private:
  const HexMesh& mesh_;
  const HexComplex& complex_;
  const std::vector<int>* b_corners_;
  std::set<int> lines_;
  std::set<int> points_;
};

hex::SheetMap map_of(const HexMesh& mesh, const HexComplex& complex, const SheetSides& sides) {
  hex::SheetMap map;
  map.twin.assign(mesh.points.size(), -1);
  for (std::size_t k = 0; k < sides.vertices.size(); ++k)
    map.twin[at(sides.vertices[k])] = static_cast<int>(mesh.points.size() + k);
  map.b_corners = sides.b_corners;
  map.on_sheet.assign(complex.edges.size(), 0);
  for (int q : sides.quads)
    for (int e : complex.quad_edges[at(q)]) map.on_sheet[at(e)] = 1;
  return map;
}

void add_layer(HexMesh& mesh, const std::array<int, 4>& quad, const hex::SheetMap& map, int colour) {
  std::array<int, 8> hex{};
  for (std::size_t k = 0; k < 4; ++k) {
    hex[k] = quad[k];
    hex[k + 4] = map.twin[at(quad[k])];
  }
  mesh.hexes.push_back(hex);
  if (colour != 0) mesh.hex_colours.push_back(colour);
}

int colour_of(const HexMesh& mesh, int hex) { return mesh.hex_colours.empty() ? 0 : mesh.hex_colours[at(hex)]; }

}  // namespace

Inflation inflate_sheet(const HexMesh& mesh, const HexComplex& complex, std::vector<int> quads, double gap) {
  const SheetSides sides = sheet_sides(mesh, complex, std::move(quads), feature_quads_of(mesh, complex));
  if (!sides.defect.empty()) {
    std::vector<std::int64_t> ids;
    if (sides.defect_vertex >= 0) ids.push_back(sides.defect_vertex);
    throw Error(ExitCode::bad_input, fmt::format("The quads are no sheet: {}.", sides.defect), std::move(ids));
  }
  const hex::SheetMap map = map_of(mesh, complex, sides);
  Inflation out{mesh, sides.vertices};
  const CopyPlacer placer(mesh, complex, sides);
  out.mesh.points.resize(mesh.points.size() + sides.vertices.size());
  for (std::size_t k = 0; k < sides.vertices.size(); ++k) {
    const int v = sides.vertices[k];
    const auto [a, b] = placer.places(v, gap, map.on_sheet);
    out.mesh.points[at(v)] = a;
    out.mesh.points[mesh.points.size() + k] = b;
  }
  for (int slot : sides.b_corners) {
    int& v = out.mesh.hexes[at(slot / 8)][at(slot % 8)];
    v = map.twin[at(v)];
  }
  for (std::size_t k = 0; k < sides.quads.size(); ++k) {
    const int q = sides.quads[k];
    std::array<int, 4> quad = complex.quads[at(q)];
    if (complex.quad_hexes[at(q)][0] != sides.a_hexes[k]) std::reverse(quad.begin(), quad.end());
    add_layer(out.mesh, quad, map, colour_of(mesh, sides.a_hexes[k]));
  }
  hex::carry_over_sheet(mesh, complex, map, out.mesh);
  return out;
}

HexMesh pad(const HexMesh& mesh, const HexComplex& complex, double depth) {
  hex::SheetMap map;
  map.twin.assign(mesh.points.size(), -1);
  HexMesh out = mesh;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if (!complex.is_boundary_vertex(static_cast<int>(v))) continue;
    map.twin[v] = static_cast<int>(out.points.size());
    out.points.push_back(mesh.points[v]);
    Aim aim;
    for (int slot : complex.vertex_corners[static_cast<int>(v)]) aim.add(middle(mesh, mesh.hexes[at(slot / 8)]));
    out.points[v] += depth * (aim.sum / aim.count - mesh.points[v]);
  }
  for (std::size_t q = 0; q < complex.quads.size(); ++q)
    if (complex.is_boundary_quad(static_cast<int>(q)))
      add_layer(out, complex.quads[q], map, colour_of(mesh, complex.quad_hexes[q][0]));
  hex::carry_to_padding(mesh, complex, map, out);
  return out;
}

}  // namespace hexfield
