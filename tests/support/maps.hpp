#pragma once

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "hexfield/field/frame_field.hpp"
#include "hexfield/map/corner_map.hpp"
#include "hexfield/mesh/features.hpp"
#include "support/meshes.hpp"

namespace hexfield::testing {

/// A mesh with an integer-grid map that is known exactly.
struct MappedMesh {
  TetMesh mesh;
  Features features;
  EdgeCodes codes;
  CornerMap map;
};

/// Rotations of the transitions of a map whose uvw are given, by their edge vectors.
inline void find_rotations(MappedMesh& m) {
  m.map.rotations.assign(m.mesh.num_tets(), {0, 0, 0, 0});
  for (std::size_t i = 0; i < m.mesh.num_tets(); ++i)
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(TetId(i), f);
      const HalfFaceId o = m.mesh.opposite_half_face(h);
      if (!o.valid()) continue;
      const auto v = m.mesh.face_vertices(h);
      auto at = [&](TetId t, std::size_t k) {
        return m.map.uvw[t.index()][static_cast<std::size_t>(m.mesh.local_index(t, v[k]))];
      };
      double best = 1e300;
      for (octahedral::Rotation r = 0; r < octahedral::order; ++r) {
        double miss = 0;
        for (std::size_t k = 1; k < 3; ++k)
          miss += (octahedral::apply(r, at(h.tet(), k) - at(h.tet(), 0)) - at(o.tet(), k) + at(o.tet(), 0)).norm();
        if (miss < best - 1e-9) best = miss, m.map.rotations[i][static_cast<std::size_t>(f)] = r;
      }
    }
}

/// Tags all boundary faces, all boundary edges with a code and all vertices with more than two of these.
inline void tag_boundary(MappedMesh& m) {
  for (std::size_t i = 0; i < m.mesh.num_tets(); ++i)
    for (int f = 0; f < 4; ++f)
      if (m.mesh.is_boundary(HalfFaceId(TetId(i), f))) m.features.faces[m.mesh.key(HalfFaceId(TetId(i), f))] = 1;
  std::map<VertexId, int> count;
  for (const auto& [edge, code] : m.codes) {
    const auto ring = edge_ring(m.mesh, find_tet_with_edge(m.mesh, edge[0], edge[1]), edge[0], edge[1]);
    if (ring.closed) continue;
    m.features.edges[edge] = 1;
    for (VertexId v : edge) ++count[v];
  }
  for (const auto& [v, n] : count)
    if (n > 2) m.features.points[v] = 1;
}

/// Prism over a polygon with k sides and a line of valence k along its axis: k sectors of n x n x layers
/// unit cells in parameter space, each cut into six Kuhn tets, each sector with its own chart.
inline MappedMesh valence_prism(int k, int n, int layers) {
  MappedMesh m;
  std::map<std::array<long, 3>, VertexId> ids;
  std::vector<Vec3> points;
  auto direction = [&](int s) {
    const double a = 2 * std::numbers::pi * (s % k) / k;
    return Vec3(std::cos(a), std::sin(a), 0);
  };
  auto vertex = [&](int s, const Vec3& uvw) {
    const Vec3 p = uvw[0] * direction(s) + uvw[1] * direction(s + 1) + uvw[2] * Vec3::UnitZ();
    const auto [place, added] =
        ids.emplace(std::array<long, 3>{std::lround(p[0] * 1e6), std::lround(p[1] * 1e6), std::lround(p[2] * 1e6)},
                    VertexId(static_cast<std::int64_t>(points.size())));
    if (added) points.push_back(p);
    return place->second;
  };
  const TetMesh grid = kuhn_box(n, n, layers);
  std::vector<std::array<VertexId, 4>> tets;
  for (int s = 0; s < k; ++s)
    for (const auto& tet : grid.tets) {
      std::array<VertexId, 4> t;
      std::array<Vec3, 4> f;
      for (std::size_t c = 0; c < 4; ++c) {
        f[c] = grid.point(tet[c]);
        t[c] = vertex(s, f[c]);
      }
      tets.push_back(t);
      m.map.uvw.push_back(f);
    }
  m.mesh = build_tet_mesh(std::move(points), std::move(tets));
  find_rotations(m);
  for (int z = 0; z < layers; ++z)
    if (k != 4) m.codes[edge_key(vertex(0, Vec3(0, 0, z)), vertex(0, Vec3(0, 0, z + 1)))] = k - 4;
  for (int s = 0; s < k; ++s) {
    for (int z = 0; z < layers; ++z) m.codes[edge_key(vertex(s, Vec3(n, n, z)), vertex(s, Vec3(n, n, z + 1)))] = -1;
    for (int z : {0, layers})
      for (int a = 0; a < n; ++a) {
        m.codes[edge_key(vertex(s, Vec3(n, a, z)), vertex(s, Vec3(n, a + 1, z)))] = -1;
        m.codes[edge_key(vertex(s, Vec3(a, n, z)), vertex(s, Vec3(a + 1, n, z)))] = -1;
      }
  }
  tag_boundary(m);
  return m;
}

/// Box of unit cells with the identity map.
inline MappedMesh mapped_box(int nx, int ny, int nz) {
  MappedMesh m;
  m.mesh = kuhn_box(nx, ny, nz);
  for (const auto& tet : m.mesh.tets)
    m.map.uvw.push_back({m.mesh.point(tet[0]), m.mesh.point(tet[1]), m.mesh.point(tet[2]), m.mesh.point(tet[3])});
  m.map.rotations.assign(m.mesh.num_tets(), {0, 0, 0, 0});
  const int size[3] = {nx, ny, nz};
  for (const auto& tet : m.mesh.tets)
    for (const auto& e : tet_edge_vertices) {
      const VertexId a = tet[static_cast<std::size_t>(e[0])];
      const VertexId b = tet[static_cast<std::size_t>(e[1])];
      int sides = 0;
      for (int k = 0; k < 3; ++k) {
        const double x = m.mesh.point(a)[k];
        sides += x == m.mesh.point(b)[k] && (x == 0 || x == size[k]);
      }
      if (sides == 2) m.codes[edge_key(a, b)] = -1;
    }
  tag_boundary(m);
  return m;
}

/// Moves every chart by a random rotation of the group and an integer translation: the same map.
inline void change_charts(MappedMesh& m, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<octahedral::Rotation> g;
  for (auto& f : m.map.uvw) {
    g.push_back(static_cast<octahedral::Rotation>(random() % octahedral::order));
    Vec3 shift;
    for (int k = 0; k < 3; ++k) shift[k] = static_cast<double>(random() % 21) - 10;
    for (Vec3& x : f) x = octahedral::apply(g.back(), x) + shift;
  }
  for (std::size_t i = 0; i < m.mesh.num_tets(); ++i)
    for (std::size_t f = 0; f < 4; ++f) {
      const HalfFaceId o = m.mesh.opposite[i][f];
      if (!o.valid()) continue;
      m.map.rotations[i][f] = octahedral::product(
          g[o.tet().index()], octahedral::product(m.map.rotations[i][f], octahedral::inverse(g[i])));
    }
}

}  // namespace hexfield::testing
