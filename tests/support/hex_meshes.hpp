#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "hexfield/hex/hex_complex.hpp"

/// Small hex meshes for tests.
namespace hexfield::testing {

/// n[0] x n[1] x n[2] unit cubes; vertex ids run along x first. Every side is a feature of its own (colours 1 to 6:
/// x low, x high, y ...), the edges and corners of the block are lines and points.
inline HexMesh hex_grid(std::array<int, 3> n, bool features = true) {
  HexMesh mesh;
  const auto id = [&](int x, int y, int z) { return x + (n[0] + 1) * (y + (n[1] + 1) * z); };
  for (int z = 0; z <= n[2]; ++z)
    for (int y = 0; y <= n[1]; ++y)
      for (int x = 0; x <= n[0]; ++x) mesh.points.emplace_back(x, y, z);
  for (int z = 0; z < n[2]; ++z)
    for (int y = 0; y < n[1]; ++y)
      for (int x = 0; x < n[0]; ++x)
        mesh.hexes.push_back({id(x, y, z), id(x + 1, y, z), id(x + 1, y + 1, z), id(x, y + 1, z), id(x, y, z + 1),
                              id(x + 1, y, z + 1), id(x + 1, y + 1, z + 1), id(x, y + 1, z + 1)});
  if (!features) return mesh;
  const HexComplex complex = build_hex_complex(mesh);
  const auto sides = [&](int v) {
    std::vector<int> out;
    for (int a = 0; a < 3; ++a) {
      if (mesh.points[static_cast<std::size_t>(v)][a] == 0) out.push_back(1 + 2 * a);
      if (mesh.points[static_cast<std::size_t>(v)][a] == n[static_cast<std::size_t>(a)]) out.push_back(2 + 2 * a);
    }
    return out;
  };
  const auto common = [&](const auto& vertices) {
    std::vector<int> out = sides(vertices[0]);
    for (int v : vertices) {
      const std::vector<int> other = sides(v);
      std::erase_if(out, [&](int s) { return std::find(other.begin(), other.end(), s) == other.end(); });
    }
    return out;
  };
  for (const auto& quad : complex.quads)
    if (const auto s = common(quad); s.size() == 1) mesh.feature_quads.push_back({quad, s[0]});
  for (const auto& edge : complex.edges)
    if (const auto s = common(edge); s.size() == 2) mesh.feature_lines.push_back({edge, 10 * s[0] + s[1]});
  for (int v = 0; v < static_cast<int>(mesh.points.size()); ++v)
    if (const auto s = sides(v); s.size() == 3) mesh.feature_points.push_back({v, 100 * s[0] + 10 * s[1] + s[2]});
  return mesh;
}

/// Unit cubes at integer places, without features.
inline HexMesh hex_blocks(const std::vector<std::array<int, 3>>& cells) {
  static constexpr int corners[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                        {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  HexMesh mesh;
  std::map<std::array<int, 3>, int> ids;
  for (const auto& cell : cells) {
    std::array<int, 8> hex{};
    for (std::size_t k = 0; k < 8; ++k) {
      const std::array<int, 3> p{cell[0] + corners[k][0], cell[1] + corners[k][1], cell[2] + corners[k][2]};
      const auto [place, added] = ids.emplace(p, static_cast<int>(mesh.points.size()));
      if (added) mesh.points.emplace_back(p[0], p[1], p[2]);
      hex[k] = place->second;
    }
    mesh.hexes.push_back(hex);
  }
  return mesh;
}

/// Places of the vertices of a triangulation on the unit sphere, no triangle too thin.
inline std::vector<Vec3> places_on_sphere(const SphereTriangulation& sphere) {
  const std::size_t n = sphere.rings.size();
  // Barycentric in the plane around one triangle as the outer face, then lifted, so that the start is an embedding.
  std::vector<Vec3> p(n, Vec3::Zero());
  const auto outer = sphere.triangles()[0];
  for (std::size_t k = 0; k < 3; ++k) {
    const double angle = -2 * M_PI * static_cast<double>(k) / 3;
    p[static_cast<std::size_t>(outer[k])] = Vec3(4 * std::cos(angle), 4 * std::sin(angle), 0);
  }
  for (int round = 0; round < 500; ++round)
    for (std::size_t v = 0; v < n; ++v) {
      if (std::find(outer.begin(), outer.end(), static_cast<int>(v)) != outer.end()) continue;
      Vec3 sum = Vec3::Zero();
      for (int w : sphere.rings[v]) sum += p[static_cast<std::size_t>(w)];
      p[v] = sum / static_cast<double>(sphere.rings[v].size());
    }
  for (Vec3& q : p) {
    const double s = q.squaredNorm();
    q = Vec3(2 * q.x(), 2 * q.y(), 1 - s) / (1 + s);  // seen from outside, the order of rings stays
  }
  // Each vertex climbs to a larger smallest determinant of its triangles.
  const auto smallest = [&](std::size_t v, const Vec3& q) {
    const auto& ring = sphere.rings[v];
    double least = 1;
    for (std::size_t k = 0; k < ring.size(); ++k)
      least = std::min(
          least,
          q.dot(p[static_cast<std::size_t>(ring[k])].cross(p[static_cast<std::size_t>(ring[(k + 1) % ring.size()])])));
    return least;
  };
  for (double step = 0.2; step > 1e-4; step *= 0.97)
    for (std::size_t v = 0; v < n; ++v)
      for (int a = 0; a < 6; ++a) {
        const Vec3 q = (p[v] + (a % 2 == 0 ? step : -step) * Vec3::Unit(a / 2)).normalized();
        if (smallest(v, q) > smallest(v, p[v])) p[v] = q;
      }
  return p;
}

/// The hexes around one vertex with the given triangulation: vertex 0 is the node, 1.. the ends of its edges in the
/// order of the triangulation, then one vertex per edge of it, then one per triangle; a hex per triangle,
/// which is a parallelepiped.
inline HexMesh cone_mesh(const SphereTriangulation& sphere, std::vector<std::array<int, 3>> triangles = {}) {
  if (triangles.empty()) triangles = sphere.triangles();
  HexMesh mesh;
  const std::vector<Vec3> p = places_on_sphere(sphere);
  mesh.points.push_back(Vec3::Zero());
  mesh.points.insert(mesh.points.end(), p.begin(), p.end());
  std::map<std::array<int, 2>, int> middles;
  const auto middle = [&](int a, int b) { return middles.at({std::min(a, b), std::max(a, b)}); };
  for (const auto& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) middles[{std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])}] = 0;
  for (auto& [edge, vertex] : middles) {
    vertex = static_cast<int>(mesh.points.size());
    mesh.points.push_back(p[static_cast<std::size_t>(edge[0])] + p[static_cast<std::size_t>(edge[1])]);
  }
  for (const auto& t : triangles) {
    const int top = static_cast<int>(mesh.points.size());
    Vec3 sum = Vec3::Zero();
    for (int v : t) sum += p[static_cast<std::size_t>(v)];
    mesh.points.push_back(sum);
    mesh.hexes.push_back(
        {0, t[0] + 1, middle(t[0], t[1]), t[1] + 1, t[2] + 1, middle(t[2], t[0]), top, middle(t[1], t[2])});
  }
  return mesh;
}

/// The eight nodes with valences 3, 4 and 5 only, by signature.
inline std::map<std::string, std::vector<std::array<int, 3>>> eight_nodes() {
  return {
      {"(4,0,0)", {{1, 2, 3}, {1, 3, 4}, {1, 4, 2}, {2, 4, 3}}},
      {"(2,2,2)", {{1, 2, 6}, {1, 6, 5}, {1, 5, 3}, {1, 3, 4}, {1, 4, 2}, {2, 4, 3}, {2, 3, 5}, {2, 5, 6}}},
      {"(0,4,4)",
       {{1, 2, 6},
        {1, 6, 8},
        {1, 8, 7},
        {1, 7, 4},
        {1, 4, 2},
        {2, 4, 3},
        {2, 3, 5},
        {2, 5, 6},
        {3, 4, 7},
        {3, 7, 8},
        {3, 8, 5},
        {5, 8, 6}}},
      {"(1,3,3)",
       {{1, 2, 6}, {1, 6, 7}, {1, 7, 3}, {1, 3, 4}, {1, 4, 2}, {2, 4, 3}, {2, 3, 5}, {2, 5, 6}, {3, 7, 5}, {5, 7, 6}}},
      {"(0,3,6)",
       {{1, 2, 7},
        {1, 7, 8},
        {1, 8, 3},
        {1, 3, 4},
        {1, 4, 2},
        {2, 4, 9},
        {2, 9, 6},
        {2, 6, 7},
        {3, 8, 5},
        {3, 5, 9},
        {3, 9, 4},
        {5, 8, 6},
        {5, 6, 9},
        {6, 8, 7}}},
      {"(0,2,8)",
       {{1, 2, 8},
        {1, 8, 5},
        {1, 5, 3},
        {1, 3, 4},
        {1, 4, 2},
        {2, 4, 10},
        {2, 10, 7},
        {2, 7, 8},
        {3, 5, 9},
        {3, 9, 4},
        {4, 9, 10},
        {5, 8, 6},
        {5, 6, 9},
        {6, 8, 7},
        {6, 7, 10},
        {6, 10, 9}}},
      {"(2,0,6)",
       {{1, 2, 6},
        {1, 6, 5},
        {1, 5, 8},
        {1, 8, 4},
        {1, 4, 2},
        {2, 4, 3},
        {2, 3, 5},
        {2, 5, 6},
        {3, 4, 7},
        {3, 7, 8},
        {3, 8, 5},
        {4, 8, 7}}},
      {"(0,0,12)", {{1, 2, 8},  {1, 8, 10}, {1, 10, 3}, {1, 3, 4},   {1, 4, 2},   {2, 4, 12}, {2, 12, 7},
                    {2, 7, 8},  {3, 10, 5}, {3, 5, 11}, {3, 11, 4},  {4, 11, 12}, {5, 10, 9}, {5, 9, 6},
                    {5, 6, 11}, {6, 9, 7},  {6, 7, 12}, {6, 12, 11}, {7, 9, 8},   {8, 9, 10}}},
  };
}

/// Cone mesh of one of them with the vertex ids of the list.
inline HexMesh node_mesh(const std::string& node) {
  auto triangles = eight_nodes().at(node);
  int n = 0;
  for (auto& t : triangles)
    for (int& v : t) n = std::max(n, v--);
  return cone_mesh(sphere_from_triangles(n, triangles), triangles);
}

}  // namespace hexfield::testing
