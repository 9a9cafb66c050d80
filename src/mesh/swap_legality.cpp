#include <algorithm>

#include "hexfield/mesh/edit_legality.hpp"

namespace hexfield {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

bool positive(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return (b - a).cross(c - a).dot(d - a) > 0;
}

bool is_ring_side(int i, int j, int n, bool closed) { return j == i + 1 || (closed && i == 0 && j == n - 1); }

}  // namespace

std::vector<int> ring_walls(const Features& features, const EdgeRing& ring, const std::vector<VertexId>& around,
                            VertexId a, VertexId b) {
  std::vector<int> walls;
  for (std::size_t k = 0; k < around.size(); ++k) {
    const bool end = !ring.closed && (k == 0 || k + 1 == around.size());
    if (end || features.faces.count(face_key(a, b, around[k])) != 0) walls.push_back(static_cast<int>(k));
  }
  return walls;
}

bool swap_keeps_topology(const TetMesh& mesh, const Features& features, const EdgeRing& ring,
                         const std::vector<VertexId>& around, const RingTriangulation& triangulation, VertexId a,
                         VertexId b) {
  const int n = static_cast<int>(around.size());
  if (n < 3 || features.edges.count(edge_key(a, b)) != 0) return false;
  const auto walls = ring_walls(features, ring, around, a, b);
  const auto [x, y] = triangulation.walls;
  if (walls.empty() ? x >= 0 : walls != std::vector<int>{x, y}) return false;
  if (!walls.empty()) {
    if (is_ring_side(x, y, n, ring.closed)) return false;
    const auto first = features.faces.find(face_key(a, b, around[at(x)]));
    const auto second = features.faces.find(face_key(a, b, around[at(y)]));
    const int first_colour = first == features.faces.end() ? 0 : first->second;
    if (first_colour != (second == features.faces.end() ? 0 : second->second)) return false;
  }
  bool has_wall_edge = walls.empty();
  for (const auto& t : triangulation.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [i, j] = std::minmax(t[k], t[(k + 1) % 3]);
      if (i == x && j == y) has_wall_edge = true;
      if (!is_ring_side(i, j, n, ring.closed) && find_tet_with_edge(mesh, around[at(i)], around[at(j)]).valid())
        return false;
    }
  // With three vertices in a closed ring no edge is new, but a face is.
  if (ring.closed && n == 3 && find_half_face(mesh, face_key(around[0], around[1], around[2])).valid()) return false;
  return has_wall_edge;
}

bool swap_keeps_positive(const TetMesh& mesh, const std::vector<VertexId>& around,
                         const RingTriangulation& triangulation, VertexId a, VertexId b) {
  return std::all_of(triangulation.triangles.begin(), triangulation.triangles.end(), [&](const auto& t) {
    const Vec3 &p = mesh.point(around[at(t[0])]), &q = mesh.point(around[at(t[1])]), &r = mesh.point(around[at(t[2])]);
    return positive(p, q, r, mesh.point(b)) && positive(p, r, q, mesh.point(a));
  });
}

bool can_swap_face(const TetMesh& mesh, const Features& features, HalfFaceId h) {
  const HalfFaceId o = mesh.opposite_half_face(h);
  if (!o.valid() || features.faces.count(mesh.key(h)) != 0) return false;
  const VertexId below = mesh.vertices(h.tet())[at(h.local())];
  const VertexId above = mesh.vertices(o.tet())[at(o.local())];
  const auto f = mesh.face_vertices(h);
  for (std::size_t k = 0; k < 3; ++k)
    if (!positive(mesh.point(below), mesh.point(above), mesh.point(f[k]), mesh.point(f[(k + 1) % 3]))) return false;
  return !find_tet_with_edge(mesh, below, above).valid();
}

}  // namespace hexfield
