#pragma once

#include <cmath>
#include <map>

#include "hexfield/mesh/features.hpp"
#include "hexfield/mesh/tet_mesh.hpp"
#include "support/meshes.hpp"

namespace hexfield::testing {

/// Boundary faces, boundary edges whose normals turn by more than 40 degrees, and vertices with other than
/// two of these as features.
inline Features sharp_features(const TetMesh& mesh) {
  Features features;
  std::map<EdgeKey, Vec3> first;
  for (std::size_t i = 0; i < mesh.num_tets(); ++i)
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(TetId(static_cast<std::int64_t>(i)), f);
      if (!mesh.is_boundary(h)) continue;
      const FaceKey k = mesh.key(h);
      features.faces[k] = 1;
      const Vec3 n = outward_normal(mesh, h);
      for (std::size_t s = 0; s < 3; ++s) {
        const EdgeKey e = edge_key(k[s], k[(s + 1) % 3]);
        const auto [other, fresh] = first.emplace(e, n);
        if (!fresh && other->second.dot(n) < std::cos(40 * M_PI / 180)) features.edges[e] = 1;
      }
    }
  std::map<VertexId, int> degree;
  for (const auto& entry : features.edges)
    for (VertexId v : entry.first) ++degree[v];
  for (const auto& [v, n] : degree)
    if (n != 2) features.points[v] = 1;
  return features;
}

/// [0, 2n] x [0, 2n] x [0, height] without the quarter x, y > n: an L-shaped prism of unit Kuhn cells.
inline TetMesh l_prism(int n, int height) {
  const TetMesh box = kuhn_box(2 * n, 2 * n, height);
  std::vector<std::array<VertexId, 4>> tets;
  for (std::size_t i = 0; i < box.num_tets(); ++i) {
    const Vec3 c = centroid(box, TetId(static_cast<std::int64_t>(i)));
    if (c.x() < n || c.y() < n) tets.push_back(box.tets[i]);
  }
  std::vector<VertexId> number(box.num_vertices());
  std::vector<Vec3> points;
  for (auto& tet : tets)
    for (VertexId& v : tet) {
      VertexId& to = number[v.index()];
      if (!to.valid()) {
        to = VertexId(static_cast<std::int64_t>(points.size()));
        points.push_back(box.point(v));
      }
      v = to;
    }
  return build_tet_mesh(std::move(points), std::move(tets));
}

}  // namespace hexfield::testing
