#pragma once

#include <map>
#include <tuple>

#include "hexfield/map/corner_map.hpp"
#include "hexfield/mesh/tet_mesh.hpp"

namespace hexfield::testing {

/// A triangular prism made of three blocks of n x n x layers cells around its axis, with the seamless map that
/// sends each block to a box: one inner singular arc of code -1.
struct ThreeQuadPrism {
  TetMesh mesh;
  CornerMap map;
};

inline ThreeQuadPrism three_quad_prism(int n, int layers) {
  const Vec3 corner[3] = {Vec3(0, 2, 0), Vec3(-1.7320508075688772, -1, 0), Vec3(1.7320508075688772, -1, 0)};
  ThreeQuadPrism p;
  std::vector<Vec3> points;
  std::vector<std::array<VertexId, 4>> tets;
  std::map<std::tuple<long, long, long>, VertexId> known;
  auto vertex = [&](const Vec3& x) {
    const auto key = std::make_tuple(std::lround(1e6 * x[0]), std::lround(1e6 * x[1]), std::lround(1e6 * x[2]));
    const auto [it, fresh] = known.emplace(key, VertexId(static_cast<std::int64_t>(points.size())));
    if (fresh) points.push_back(x);
    return it->second;
  };
  constexpr int axes[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  for (int b = 0; b < 3; ++b) {
    // Block b: the centre, the two edge midpoints next to corner b, and corner b.
    const Vec3 right = 0.5 * (corner[b] + corner[(b + 2) % 3]);
    const Vec3 left = 0.5 * (corner[b] + corner[(b + 1) % 3]);
    auto place = [&](const Vec3& u) {
      const double x = u[0] / n, y = u[1] / n;
      return Vec3(x * (1 - y) * right + (1 - x) * y * left + x * y * corner[b] + Vec3(0, 0, u[2] / n));
    };
    for (int k = 0; k < layers; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
          for (int q = 0; q < 6; ++q) {
            std::array<Vec3, 4> u;
            u[0] = Vec3(i, j, k);
            for (std::size_t s = 0; s < 3; ++s) u[s + 1] = u[s] + Vec3::Unit(axes[q][s]);
            if (q >= 3) std::swap(u[2], u[3]);
            tets.push_back({vertex(place(u[0])), vertex(place(u[1])), vertex(place(u[2])), vertex(place(u[3]))});
            p.map.uvw.push_back(u);
          }
  }
  p.mesh = build_tet_mesh(std::move(points), std::move(tets));
  // Across each face the rotation about w that carries the face's edges over.
  p.map.rotations.assign(p.mesh.num_tets(), {0, 0, 0, 0});
  for (std::size_t t = 0; t < p.mesh.num_tets(); ++t)
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(TetId(static_cast<std::int64_t>(t)), f);
      if (p.mesh.is_boundary(h)) continue;
      const TetId o = p.mesh.opposite_half_face(h).tet();
      const auto v = p.mesh.face_vertices(h);
      auto edge = [&](TetId tet, std::size_t e) {
        const auto& u = p.map.uvw[tet.index()];
        return Vec3(u[static_cast<std::size_t>(p.mesh.local_index(tet, v[e]))] -
                    u[static_cast<std::size_t>(p.mesh.local_index(tet, v[0]))]);
      };
      for (octahedral::Rotation r = 0; r < octahedral::order; ++r) {
        const Mat3& m = octahedral::matrix(r);
        if (m(2, 2) != 1) continue;
        if (m * edge(h.tet(), 1) != edge(o, 1) || m * edge(h.tet(), 2) != edge(o, 2)) continue;
        p.map.rotations[t][static_cast<std::size_t>(f)] = r;
        break;
      }
    }
  return p;
}

}  // namespace hexfield::testing
