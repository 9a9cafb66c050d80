#pragma once

#include <set>

#include "hexfield/mesh/features.hpp"
#include "hexfield/mesh/tet_mesh.hpp"

namespace hexfield::testing {

/// Box [0, n_x] x [0, n_y] x [0, n_z] of unit cells, each cut into six Kuhn tets.
inline TetMesh kuhn_box(int nx, int ny, int nz) {
  auto id = [&](int i, int j, int k) { return VertexId((static_cast<std::int64_t>(k) * (ny + 1) + j) * (nx + 1) + i); };
  std::vector<Vec3> points;
  for (int k = 0; k <= nz; ++k)
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i) points.emplace_back(i, j, k);
  constexpr int axes[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  std::vector<std::array<VertexId, 4>> tets;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        for (int p = 0; p < 6; ++p) {
          int c[3] = {i, j, k};
          std::array<VertexId, 4> t;
          t[0] = id(c[0], c[1], c[2]);
          for (std::size_t s = 0; s < 3; ++s) {
            ++c[axes[p][s]];
            t[s + 1] = id(c[0], c[1], c[2]);
          }
          if (p >= 3) std::swap(t[2], t[3]);
          tets.push_back(t);
        }
  return build_tet_mesh(std::move(points), std::move(tets));
}

/// Vertices minus edges plus faces of all feature faces together.
inline int surface_euler_characteristic(const Features& features) {
  std::set<VertexId> vertices;
  std::set<EdgeKey> edges;
  for (const auto& [f, colour] : features.faces) {
    vertices.insert(f.begin(), f.end());
    edges.insert({edge_key(f[0], f[1]), edge_key(f[1], f[2]), edge_key(f[0], f[2])});
  }
  return static_cast<int>(vertices.size()) - static_cast<int>(edges.size()) + static_cast<int>(features.faces.size());
}

}  // namespace hexfield::testing
