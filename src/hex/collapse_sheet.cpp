#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "hexfield/hex/sheet.hpp"

namespace hexfield {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

template <class Entity>
void keep_one_of_each(std::vector<Entity>& entities, const auto& key_of, const char* what) {
  std::map<std::vector<int>, int> colours;
  std::vector<Entity> kept;
  for (const Entity& entity : entities) {
    const auto [entry, fresh] = colours.try_emplace(key_of(entity), entity.colour);
    if (entry->second != entity.colour)
      throw Error(ExitCode::bad_input,
                  fmt::format("The collapse would join {} of colours {} and {}.", what, entry->second, entity.colour));
    if (fresh) kept.push_back(entity);
  }
  entities = std::move(kept);
}

std::vector<int> distinct(const auto& vertices) {
  std::set<int> set(vertices.begin(), vertices.end());
  return {set.begin(), set.end()};
}

class Collapser {
 public:
  Collapser(const HexMesh& mesh, const HexComplex& complex, const HexSheet& sheet)
      : mesh_(mesh), complex_(complex), sheet_(sheet), number_(mesh.points.size()) {}

  HexMesh run() {
    if (!sheet_.simple) throw Error(ExitCode::bad_input, "The sheet meets itself; it cannot be collapsed.");
    place_points();
    place_hexes();
    place_features();
    const HexComplex complex = build_hex_complex(out_);
    for (std::size_t e = 0; e < complex.edges.size(); ++e)
      if (!complex.is_boundary_edge(static_cast<int>(e)) && complex.valence(static_cast<int>(e)) < 3)
        throw Error(ExitCode::bad_input,
                    fmt::format("The collapse would leave the edge ({}, {}) inside between {} hexes.",
                                complex.edges[e][0], complex.edges[e][1], complex.valence(static_cast<int>(e))));
    return std::move(out_);
  }

 private:
  void place_points();
  void place_hexes();
  void place_features();

  const HexMesh& mesh_;
  const HexComplex& complex_;
  const HexSheet& sheet_;
  std::vector<int> number_;
  HexMesh out_;
};

void Collapser::place_points() {
  std::vector<int> rank(mesh_.points.size(), 0);  // how strongly a feature holds the vertex
  for (const auto& quad : mesh_.feature_quads)
    for (int v : quad.vertices) rank[at(v)] = std::max(rank[at(v)], 1);
  for (const auto& line : mesh_.feature_lines)
    for (int v : line.vertices) rank[at(v)] = std::max(rank[at(v)], 2);
  for (const auto& point : mesh_.feature_points) rank[at(point.vertex)] = 3;
  std::vector<int> goes_to(mesh_.points.size(), -1);
  std::vector<Vec3> points = mesh_.points;
  for (int e : sheet_.edges) {
    const auto [a, b] = complex_.edges[at(e)];
    goes_to[at(b)] = a;
    if (rank[at(a)] == 3 && rank[at(b)] == 3) throw Error(ExitCode::bad_input, "The collapse would join two corners.");
    if (rank[at(a)] == rank[at(b)])
      points[at(a)] = (mesh_.points[at(a)] + mesh_.points[at(b)]) / 2;
    else if (rank[at(b)] > rank[at(a)])
      points[at(a)] = mesh_.points[at(b)];
  }
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (goes_to[v] >= 0) continue;
    number_[v] = static_cast<int>(out_.points.size());
    out_.points.push_back(points[v]);
  }
  for (std::size_t v = 0; v < points.size(); ++v)
    if (goes_to[v] >= 0) number_[v] = number_[at(goes_to[v])];
}

void Collapser::place_hexes() {
  for (std::size_t h = 0; h < mesh_.hexes.size(); ++h) {
    if (std::binary_search(sheet_.hexes.begin(), sheet_.hexes.end(), static_cast<int>(h))) continue;
    auto hex = mesh_.hexes[h];
    for (int& v : hex) v = number_[at(v)];
    out_.hexes.push_back(hex);
    if (!mesh_.hex_colours.empty()) out_.hex_colours.push_back(mesh_.hex_colours[h]);
  }
  if (out_.hexes.empty()) throw Error(ExitCode::bad_input, "The collapse would leave no hex.");
  out_.names = mesh_.names;
}

void Collapser::place_features() {
  for (auto quad : mesh_.feature_quads) {
    for (int& v : quad.vertices) v = number_[at(v)];
    if (distinct(quad.vertices).size() == 4) out_.feature_quads.push_back(quad);
  }
  for (auto line : mesh_.feature_lines) {
    for (int& v : line.vertices) v = number_[at(v)];
    if (line.vertices[0] != line.vertices[1]) out_.feature_lines.push_back(line);
  }
  for (const auto& point : mesh_.feature_points)
    out_.feature_points.push_back({number_[at(point.vertex)], point.colour});
  keep_one_of_each(
      out_.feature_quads, [](const auto& q) { return distinct(q.vertices); }, "surfaces");
  keep_one_of_each(
      out_.feature_lines, [](const auto& l) { return distinct(l.vertices); }, "lines");
}

}  // namespace

HexSheet sheet_of_edge(const HexMesh& mesh, const HexComplex& complex, int edge) {
  HexSheet out;
  std::vector<char> seen(complex.edges.size(), 0);
  std::vector<int> stack{edge};
  std::vector<int> touched(mesh.points.size(), 0);
  std::map<int, int> edges_of_hex;
  seen[at(edge)] = 1;
  while (!stack.empty()) {
    const int e = stack.back();
    stack.pop_back();
    out.edges.push_back(e);
    for (int v : complex.edges[at(e)]) out.simple = ++touched[at(v)] == 1 && out.simple;
    std::set<int> hexes;
    for (int q : complex.edge_quads[e]) {
      const auto& around = complex.quad_edges[at(q)];
      const auto k = static_cast<std::size_t>(std::find(around.begin(), around.end(), e) - around.begin());
      const int opposite = around[(k + 2) % 4];
      if (seen[at(opposite)] == 0) {
        seen[at(opposite)] = 1;
        stack.push_back(opposite);
      }
      for (int h : complex.quad_hexes[at(q)])
        if (h >= 0) hexes.insert(h);
    }
    for (int h : hexes) ++edges_of_hex[h];
  }
  std::sort(out.edges.begin(), out.edges.end());
  for (const auto& [h, count] : edges_of_hex) {
    out.hexes.push_back(h);
    out.simple = out.simple && count == 4;
  }
  return out;
}

HexMesh collapse_sheet(const HexMesh& mesh, const HexComplex& complex, const HexSheet& sheet) {
  return Collapser(mesh, complex, sheet).run();
}

}  // namespace hexfield
