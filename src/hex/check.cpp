#include "hexfield/hex/check.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "hex_topology.hpp"

namespace hexfield {
namespace {

using hex::HexSide;

Vec3 centre(const HexMesh& mesh, std::size_t h) {
  Vec3 sum = Vec3::Zero();
  for (int v : mesh.hexes[h]) sum += mesh.points[static_cast<std::size_t>(v)];
  return sum / 8;
}

class HexChecker {
 public:
  explicit HexChecker(const HexMesh& mesh) : mesh_(mesh) {}

  std::vector<Violation> run() {
    if (!ids_in_range()) return std::move(out_);
    cells();
    corners();
    sides();
    features();
    return std::move(out_);
  }

 private:
  void add_hex(std::size_t h, std::string sentence) {
    out_.push_back({std::move(sentence), {static_cast<std::int64_t>(h)}, {centre(mesh_, h)}});
  }
  void add_vertex(std::size_t v, std::string sentence) {
    out_.push_back({std::move(sentence), {static_cast<std::int64_t>(v)}, {mesh_.points[v]}});
  }
  bool in_range(int v) const { return v >= 0 && static_cast<std::size_t>(v) < mesh_.points.size(); }
  bool ids_in_range();
  void cells();
  void corners();
  void sides();
  void boundary_edges(const std::vector<HexSide>& sorted);
  void hang_together(const std::vector<HexSide>& sorted);
  void features();

  const HexMesh& mesh_;
  std::vector<Violation> out_;
};

bool HexChecker::ids_in_range() {
  const auto good = [&](const auto& vertices) {
    return std::all_of(vertices.begin(), vertices.end(), [&](int v) { return in_range(v); });
  };
  for (std::size_t h = 0; h < mesh_.hexes.size(); ++h)
    if (!good(mesh_.hexes[h]))
      out_.push_back({fmt::format("Hex {} has a vertex id out of range.", h), {static_cast<std::int64_t>(h)}, {}});
  for (const auto& p : mesh_.feature_points)
    if (!in_range(p.vertex))
      out_.push_back({fmt::format("A feature point of colour {} has no vertex.", p.colour), {p.vertex}, {}});
  for (const auto& l : mesh_.feature_lines)
    if (!good(l.vertices))
      out_.push_back({fmt::format("A feature line of colour {} has an id out of range.", l.colour), {}, {}});
  for (const auto& q : mesh_.feature_quads)
    if (!good(q.vertices))
      out_.push_back({fmt::format("A feature quad of colour {} has an id out of range.", q.colour), {}, {}});
  if (!mesh_.hex_colours.empty() && mesh_.hex_colours.size() != mesh_.hexes.size())
    out_.push_back(
        {fmt::format("There are {} hex colours for {} hexes.", mesh_.hex_colours.size(), mesh_.hexes.size()), {}, {}});
  return out_.empty();
}

void HexChecker::cells() {
  std::vector<char> used(mesh_.points.size(), 0);
  std::vector<std::pair<std::array<int, 8>, std::size_t>> sorted(mesh_.hexes.size());
  for (std::size_t h = 0; h < mesh_.hexes.size(); ++h) {
    sorted[h] = {mesh_.hexes[h], h};
    auto& key = sorted[h].first;
    for (int v : key) used[static_cast<std::size_t>(v)] = 1;
    std::sort(key.begin(), key.end());
    if (std::adjacent_find(key.begin(), key.end()) != key.end())
      add_hex(h, fmt::format("Hex {} has a vertex twice.", h));
  }
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t k = 1; k < sorted.size(); ++k)
    if (sorted[k].first == sorted[k - 1].first)
      add_hex(sorted[k].second,
              fmt::format("Hexes {} and {} have the same vertices.", sorted[k - 1].second, sorted[k].second));
  for (std::size_t v = 0; v < used.size(); ++v)
    if (used[v] == 0) add_vertex(v, fmt::format("Vertex {} belongs to no hex.", v));
}

void HexChecker::corners() {
  for (std::size_t h = 0; h < mesh_.hexes.size(); ++h) {
    const double quality = scaled_jacobian(mesh_, h);
    if (!(quality > 0)) add_hex(h, fmt::format("Hex {} has a corner with scaled Jacobian {:.4g}.", h, quality));
  }
}

void HexChecker::sides() {
  const std::vector<HexSide> sorted = hex::sorted_sides(mesh_);
  for (std::size_t i = 0; i < sorted.size();) {
    std::size_t j = i;
    while (j < sorted.size() && sorted[j].key == sorted[i].key) ++j;
    if (j - i > 2)
      add_hex(static_cast<std::size_t>(sorted[i].side / 6),
              fmt::format("The face ({}, {}, {}, {}) belongs to {} hexes.", sorted[i].key[0], sorted[i].key[1],
                          sorted[i].key[2], sorted[i].key[3], j - i));
    i = j;
  }
  boundary_edges(sorted);
  hang_together(sorted);
}

void HexChecker::boundary_edges(const std::vector<HexSide>& sorted) {
  std::vector<std::array<int, 2>> edges;
  for (std::int64_t side : hex::boundary_sides(sorted)) {
    const auto quad = hex::side_vertices(mesh_, side);
    for (std::size_t k = 0; k < 4; ++k)
      edges.push_back({std::min(quad[k], quad[(k + 1) % 4]), std::max(quad[k], quad[(k + 1) % 4])});
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0, j = 0; i < edges.size(); i = j) {
    while (j < edges.size() && edges[j] == edges[i]) ++j;
    const auto [a, b] = edges[i];
    if (j - i != 2 && a != b)
      out_.push_back({fmt::format("The boundary edge ({}, {}) is in {} boundary faces instead of two.", a, b, j - i),
                      {a, b},
                      {(mesh_.points[static_cast<std::size_t>(a)] + mesh_.points[static_cast<std::size_t>(b)]) / 2}});
  }
}

// The hexes at each vertex are one fan through faces at it.
void HexChecker::hang_together(const std::vector<HexSide>& sorted) {
  hex::DisjointSets fans(8 * mesh_.hexes.size());
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i].key != sorted[i - 1].key) continue;
    for (int v : sorted[i].key) {
      const auto slot = [&](std::int64_t side) {
        const auto& hex = mesh_.hexes[static_cast<std::size_t>(side / 6)];
        return static_cast<std::size_t>(8 * (side / 6) + (std::find(hex.begin(), hex.end(), v) - hex.begin()));
      };
      fans.join(slot(sorted[i].side), slot(sorted[i - 1].side));
    }
  }
  std::vector<std::size_t> fan(mesh_.points.size(), static_cast<std::size_t>(-1));
  std::vector<char> reported(mesh_.points.size(), 0);
  for (std::size_t h = 0; h < mesh_.hexes.size(); ++h)
    for (std::size_t k = 0; k < 8; ++k) {
      const auto v = static_cast<std::size_t>(mesh_.hexes[h][k]);
      const std::size_t root = fans.find(8 * h + k);
      if (fan[v] == static_cast<std::size_t>(-1)) fan[v] = root;
      if (fan[v] != root && reported[v] == 0) {
        reported[v] = 1;
        add_vertex(v, fmt::format("The hexes at vertex {} do not hang together through faces.", v));
      }
    }
}

void HexChecker::features() {
  const auto edges = hex::sorted_edges(mesh_);
  for (const auto& line : mesh_.feature_lines) {
    const std::array<int, 2> key{std::min(line.vertices[0], line.vertices[1]),
                                 std::max(line.vertices[0], line.vertices[1])};
    if (!std::binary_search(edges.begin(), edges.end(), key))
      add_vertex(
          static_cast<std::size_t>(key[0]),
          fmt::format("The feature line ({}, {}) of colour {} is no edge of a hex.", key[0], key[1], line.colour));
  }
  const auto sides = hex::sorted_sides(mesh_);
  for (const auto& quad : mesh_.feature_quads) {
    HexSide wanted{quad.vertices, 0};
    std::sort(wanted.key.begin(), wanted.key.end());
    if (!std::binary_search(sides.begin(), sides.end(), wanted,
                            [](const HexSide& a, const HexSide& b) { return a.key < b.key; }))
      add_vertex(
          static_cast<std::size_t>(wanted.key[0]),
          fmt::format("A feature quad of colour {} at vertex {} is no face of a hex.", quad.colour, wanted.key[0]));
  }
}

}  // namespace

std::vector<Violation> check(const HexMesh& mesh) { return HexChecker(mesh).run(); }

}  // namespace hexfield
