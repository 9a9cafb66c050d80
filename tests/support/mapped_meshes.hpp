#pragma once

#include <cmath>
#include <limits>
#include <map>

#include "hexfield/map/corner_map.hpp"
#include "hexfield/mesh/features.hpp"
#include "support/meshes.hpp"

namespace hexfield::testing {

/// A tet mesh with an integer-grid map.
struct MappedMesh {
  TetMesh mesh;
  IntegerGridMap map;
};

/// Rotations of the transitions from the corners alone: the best of the 24 on every interior face.
inline void derive_rotations(MappedMesh& m) {
  m.map.rotations.assign(m.mesh.num_tets(), {});
  for (std::size_t t = 0; t < m.mesh.num_tets(); ++t)
    for (int i = 0; i < 4; ++i) {
      const HalfFaceId h(TetId(t), i);
      const HalfFaceId o = m.mesh.opposite_half_face(h);
      if (!o.valid()) continue;
      const auto v = m.mesh.face_vertices(h);
      const auto corner = [&](TetId tet, VertexId vertex) {
        return m.map.uvw[tet.index()][static_cast<std::size_t>(m.mesh.local_index(tet, vertex))];
      };
      double best = std::numeric_limits<double>::infinity();
      for (octahedral::Rotation r = 0; r < octahedral::order; ++r) {
        double miss = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          const Vec3 here = corner(TetId(t), v[(k + 1) % 3]) - corner(TetId(t), v[k]);
          const Vec3 there = corner(o.tet(), v[(k + 1) % 3]) - corner(o.tet(), v[k]);
          miss += (octahedral::apply(r, here) - there).squaredNorm();
        }
        if (miss < best - 1e-9) {
          best = miss;
          m.map.rotations[t][static_cast<std::size_t>(i)] = r;
        }
      }
    }
}

/// kuhn_box mapped by one global chart that scales every axis.
inline MappedMesh scaled_box(int nx, int ny, int nz, const Vec3& scale) {
  MappedMesh m{kuhn_box(nx, ny, nz), {}};
  m.map.rotations.assign(m.mesh.num_tets(), {});
  for (const auto& tet : m.mesh.tets) {
    auto& corners = m.map.uvw.emplace_back();
    for (std::size_t k = 0; k < 4; ++k) corners[k] = m.mesh.point(tet[k]).cwiseProduct(scale);
  }
  return m;
}

/// Gives tet t another chart: rotated by r, then shifted by the integer vector s.
inline void change_chart(MappedMesh& m, TetId t, octahedral::Rotation r, const Vec3& s) {
  for (Vec3& p : m.map.uvw[t.index()]) p = octahedral::apply(r, p) + s;
  for (int i = 0; i < 4; ++i) {
    const HalfFaceId h(t, i);
    const HalfFaceId o = m.mesh.opposite_half_face(h);
    if (!o.valid()) continue;
    auto& out = m.map.rotations[t.index()][static_cast<std::size_t>(i)];
    out = octahedral::product(out, octahedral::inverse(r));
    m.map.rotations[o.tet().index()][static_cast<std::size_t>(o.local())] = octahedral::inverse(out);
  }
}

/// Cuboid blocks of given integer extents, each in its own chart and cut into 24 tets around its centre.
/// Corners of a block in the order of a VTK hexahedron; opposite sides of blocks that touch must agree.
inline MappedMesh block_map(std::vector<Vec3> points, const std::vector<std::array<int, 8>>& blocks,
                            const std::vector<Vec3>& extents) {
  constexpr int faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  constexpr int bits[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  std::map<std::array<int, 4>, VertexId> centres;
  std::vector<std::array<VertexId, 4>> tets;
  MappedMesh m;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const auto corner = [&](int k) { return blocks[b][static_cast<std::size_t>(k)]; };
    const auto uvw = [&](int k) -> Vec3 { return Vec3(bits[k][0], bits[k][1], bits[k][2]).cwiseProduct(extents[b]); };
    Vec3 middle = Vec3::Zero();
    for (int v : blocks[b]) middle += points[static_cast<std::size_t>(v)] / 8;
    const VertexId centre(static_cast<std::int64_t>(points.size()));
    points.push_back(middle);
    for (const auto& face : faces) {
      std::array<int, 4> key{corner(face[0]), corner(face[1]), corner(face[2]), corner(face[3])};
      Vec3 place = Vec3::Zero();
      Vec3 image = Vec3::Zero();
      for (int k : face) {
        place += points[static_cast<std::size_t>(corner(k))] / 4;
        image += uvw(k) / 4;
      }
      std::sort(key.begin(), key.end());
      const auto [found, fresh] = centres.emplace(key, VertexId(static_cast<std::int64_t>(points.size())));
      if (fresh) points.push_back(place);
      for (int k = 0; k < 4; ++k) {
        const int from = face[k];
        const int to = face[(k + 1) % 4];
        tets.push_back({VertexId(corner(from)), VertexId(corner(to)), found->second, centre});
        m.map.uvw.push_back({uvw(from), uvw(to), image, Vec3(extents[b] / 2)});
        // The faces wind counter-clockwise seen from outside, so the tet is positive with its last two swapped.
        std::swap(tets.back()[2], tets.back()[3]);
        std::swap(m.map.uvw.back()[2], m.map.uvw.back()[3]);
      }
    }
  }
  m.mesh = build_tet_mesh(std::move(points), std::move(tets));
  derive_rotations(m);
  return m;
}

/// Prism over a regular polygon with one singular line along its axis. lengths[i] is the number of hexes
/// from the axis to the middle of side i.
inline MappedMesh polygon_prism(const std::vector<int>& lengths, int height) {
  const int n = static_cast<int>(lengths.size());
  std::vector<Vec3> points;
  for (int level = 0; level < 2; ++level) {
    const auto corner = [&](int i) {
      return Vec3(std::cos(2 * M_PI * i / n), std::sin(2 * M_PI * i / n), level * 1.5);
    };
    points.emplace_back(0, 0, level * 1.5);
    for (int i = 0; i < n; ++i) points.push_back(corner(i));
    for (int i = 0; i < n; ++i) points.emplace_back((corner(i) + corner(i + 1)) / 2);
  }
  std::vector<std::array<int, 8>> blocks;
  std::vector<Vec3> extents;
  for (int i = 0; i < n; ++i) {
    const int before = (i + n - 1) % n;
    std::array<int, 8> block{0, 1 + n + before, 1 + i, 1 + n + i, 0, 0, 0, 0};
    for (std::size_t k = 0; k < 4; ++k) block[k + 4] = block[k] + 2 * n + 1;
    blocks.push_back(block);
    extents.emplace_back(lengths[static_cast<std::size_t>(before)], lengths[static_cast<std::size_t>(i)], height);
  }
  return block_map(std::move(points), blocks, extents);
}

/// Solid torus with square section, cut into `sectors` >= 4 pieces, with nu hexes along it.
inline MappedMesh square_torus(int sectors, int nu, int nv, int nw) {
  const TetMesh box = kuhn_box(sectors, 1, 1);
  const auto wrap = [&](VertexId v) {
    const int layer = v.value / (sectors + 1);
    return VertexId(layer * sectors + v.value % (sectors + 1) % sectors);
  };
  std::vector<Vec3> points(static_cast<std::size_t>(4 * sectors));
  for (std::size_t v = 0; v < box.num_vertices(); ++v) {
    const Vec3& p = box.points[v];
    const double angle = 2 * M_PI * p.x() / sectors;
    const double radius = 3 - p.y();
    points[wrap(VertexId(v)).index()] = Vec3(radius * std::cos(angle), radius * std::sin(angle), p.z());
  }
  MappedMesh m;
  std::vector<std::array<VertexId, 4>> tets;
  for (const auto& tet : box.tets) {
    auto& corners = m.map.uvw.emplace_back();
    auto& wrapped = tets.emplace_back();
    for (std::size_t k = 0; k < 4; ++k) {
      wrapped[k] = wrap(tet[k]);
      corners[k] = box.point(tet[k]).cwiseProduct(Vec3(static_cast<double>(nu) / sectors, nv, nw));
    }
  }
  m.mesh = build_tet_mesh(std::move(points), std::move(tets));
  m.map.rotations.assign(m.mesh.num_tets(), {});
  return m;
}

/// Features of a box [0, nx] x [0, ny] x [0, nz]: corners 1..8, edges 1..12, sides 1..6.
inline Features box_features(const TetMesh& mesh, const Vec3& size) {
  Features features;
  const auto sides = [&](VertexId v) {  // bit 2a: at 0 on axis a, bit 2a + 1: at the far end
    unsigned bits = 0;
    for (int a = 0; a < 3; ++a) {
      if (mesh.point(v)[a] == 0) bits |= 1U << 2 * a;
      if (mesh.point(v)[a] == size[a]) bits |= 2U << 2 * a;
    }
    return bits;
  };
  std::map<unsigned, int> corner_colours;
  std::map<unsigned, int> edge_colours;
  const auto colour = [](std::map<unsigned, int>& colours, unsigned bits) {
    return colours.emplace(bits, static_cast<int>(colours.size()) + 1).first->second;
  };
  for (std::size_t t = 0; t < mesh.num_tets(); ++t)
    for (int i = 0; i < 4; ++i) {
      const HalfFaceId h(TetId(t), i);
      if (!mesh.is_boundary(h)) continue;
      const auto v = mesh.face_vertices(h);
      const unsigned common = sides(v[0]) & sides(v[1]) & sides(v[2]);
      for (int side = 0; side < 6; ++side)
        if ((common >> side & 1U) != 0) features.faces[mesh.key(h)] = side + 1;
      for (std::size_t k = 0; k < 3; ++k) {
        const VertexId a = v[k];
        const VertexId b = v[(k + 1) % 3];
        const unsigned both = sides(a) & sides(b);
        if (__builtin_popcount(both) == 2) features.edges[edge_key(a, b)] = colour(edge_colours, both);
        if (__builtin_popcount(sides(a)) == 3) features.points[a] = colour(corner_colours, sides(a));
      }
    }
  return features;
}

}  // namespace hexfield::testing
