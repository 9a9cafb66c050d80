#include "sheet_features.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hexfield::hex {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

class FeatureCarrier {
 public:
  FeatureCarrier(const HexMesh& before, const HexComplex& complex, const SheetMap& map, HexMesh& after)
      : before_(before), complex_(complex), map_(map), after_(after) {}

  void run() {
    after_.feature_quads.clear();
    after_.feature_lines.clear();
    after_.feature_points.clear();
    for (const auto& quad : before_.feature_quads) carry_quad(quad);
    for (const auto& [edge, surfaces] : seams_) add_strip(edge, surfaces);
    for (const auto& line : before_.feature_lines) carry_line(line);
    carry_points();
  }

 private:
  /// Colours of the feature quads at an edge of the sheet, per side.
  struct Surfaces {
    std::vector<int> a;
    std::vector<int> b;
  };
  void carry_quad(const HexMesh::Quad& quad);
  void add_strip(int edge, const Surfaces& surfaces);
  void carry_line(const HexMesh::Line& line);
  void carry_points();
  void add_line(int a, int b, int colour);
  int twin(int v) const { return map_.twin[at(v)]; }
  [[noreturn]] void refuse(int v, const char* what) const {
    const Vec3& p = before_.points[at(v)];
    throw Error(ExitCode::bad_input,
                fmt::format("The sheet would tear {} apart at vertex {} at ({:.6g}, {:.6g}, {:.6g}).", what, v, p.x(),
                            p.y(), p.z()),
                {v}, {p});
  }

  const HexMesh& before_;
  const HexComplex& complex_;
  const SheetMap& map_;
  HexMesh& after_;
  std::map<int, Surfaces> seams_;
  std::map<int, std::array<std::vector<int>, 2>> lines_at_;  // per old vertex with twin: colours at it and at its twin
};

void FeatureCarrier::carry_quad(const HexMesh::Quad& quad) {
  const int q = complex_.find_quad(quad.vertices);
  require(q >= 0, "A feature quad must be a face of a hex.");
  const int hex = complex_.quad_hexes[at(q)][0];
  HexMesh::Quad image = quad;
  for (int& v : image.vertices) v = map_.image(before_, hex, v);
  after_.feature_quads.push_back(image);
  for (int e : complex_.quad_edges[at(q)]) {
    if (map_.on_sheet[at(e)] == 0) continue;
    const int v = complex_.edges[at(e)][0];
    auto& surfaces = seams_[e];
    (map_.image(before_, hex, v) == v ? surfaces.a : surfaces.b).push_back(quad.colour);
  }
}

// A feature surface that the sheet cuts is joined again by a quad between the two copies of the edge.
void FeatureCarrier::add_strip(int edge, const Surfaces& surfaces) {
  if (surfaces.a.empty() || surfaces.b.empty()) return;
  const auto [a, b] = complex_.edges[at(edge)];
  if (surfaces.a.size() > 1 && surfaces.b.size() > 1) refuse(a, "a seam of surfaces");
  const int colour = surfaces.a.size() == 1 ? surfaces.a[0] : surfaces.b[0];
  after_.feature_quads.push_back({{a, b, twin(b), twin(a)}, colour});
}

void FeatureCarrier::add_line(int a, int b, int colour) { after_.feature_lines.push_back({{a, b}, colour}); }

void FeatureCarrier::carry_line(const HexMesh::Line& line) {
  const int e = complex_.find_edge(line.vertices[0], line.vertices[1]);
  require(e >= 0, "A feature line must be an edge of a hex.");
  std::array<int, 2> image = line.vertices;
  if (map_.on_sheet[at(e)] != 0) {
    // The strip continues the surface of the side that has one, so the line belongs to the other.
    const auto found = seams_.find(e);
    const bool only_a = found != seams_.end() && found->second.b.empty();
    const bool strip_at_b = found != seams_.end() && found->second.a.size() > 1;
    if (!only_a && !strip_at_b)
      for (int& v : image) v = twin(v);
  } else {
    const int hex = complex_.quad_hexes[at(complex_.edge_quads[e][0])][0];
    for (int& v : image) v = map_.image(before_, hex, v);
  }
  add_line(image[0], image[1], line.colour);
  for (std::size_t k = 0; k < 2; ++k) {
    const int v = line.vertices[k];
    if (twin(v) >= 0) lines_at_[v][image[k] == v ? 0 : 1].push_back(line.colour);
  }
}

// A line that crosses the sheet gets an edge from copy to copy; a corner stays where more of its lines are.
void FeatureCarrier::carry_points() {
  for (const auto& [v, lines] : lines_at_) {
    if (lines[0].empty() || lines[1].empty()) continue;
    const bool lone_b = lines[1].size() <= lines[0].size();
    const auto& lone = lines[lone_b ? 1 : 0];
    if (lone.size() > 1) refuse(v, "a corner of lines");
    add_line(v, twin(v), lone[0]);
  }
  for (const auto& point : before_.feature_points) {
    const auto found = lines_at_.find(point.vertex);
    const bool moves = found != lines_at_.end() && found->second[1].size() > found->second[0].size();
    after_.feature_points.push_back({moves ? twin(point.vertex) : point.vertex, point.colour});
  }
}

}  // namespace

int SheetMap::image(const HexMesh& mesh, int hex, int vertex) const {
  if (twin[at(vertex)] < 0) return vertex;
  const auto& corners = mesh.hexes[at(hex)];
  const auto k = std::find(corners.begin(), corners.end(), vertex) - corners.begin();
  const int slot = 8 * hex + static_cast<int>(k);
  return std::binary_search(b_corners.begin(), b_corners.end(), slot) ? twin[at(vertex)] : vertex;
}

void carry_to_padding(const HexMesh& before, const HexComplex& complex, const SheetMap& map, HexMesh& after) {
  const auto twin = [&](int v) { return map.twin[at(v)]; };
  after.feature_quads.clear();
  for (const auto& quad : before.feature_quads) {
    const int q = complex.find_quad(quad.vertices);
    require(q >= 0, "A feature quad must be a face of a hex.");
    HexMesh::Quad image = quad;
    if (complex.is_boundary_quad(q)) {
      for (int& v : image.vertices) v = twin(v);
    } else {
      for (int e : complex.quad_edges[at(q)]) {
        const auto [a, b] = complex.edges[at(e)];
        if (complex.is_boundary_edge(e)) after.feature_quads.push_back({{a, b, twin(b), twin(a)}, quad.colour});
      }
    }
    after.feature_quads.push_back(image);
  }
  after.feature_lines.clear();
  for (const auto& line : before.feature_lines) {
    const int e = complex.find_edge(line.vertices[0], line.vertices[1]);
    require(e >= 0, "A feature line must be an edge of a hex.");
    HexMesh::Line image = line;
    for (int& v : image.vertices) {
      if (complex.is_boundary_edge(e))
        v = twin(v);
      else if (twin(v) >= 0)
        after.feature_lines.push_back({{v, twin(v)}, line.colour});
    }
    after.feature_lines.push_back(image);
  }
  for (auto& point : after.feature_points)
    if (twin(point.vertex) >= 0) point.vertex = twin(point.vertex);
}

void carry_over_sheet(const HexMesh& before, const HexComplex& complex, const SheetMap& map, HexMesh& after) {
  FeatureCarrier(before, complex, map, after).run();
}

}  // namespace hexfield::hex
