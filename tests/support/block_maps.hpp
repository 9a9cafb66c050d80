#pragma once

#include <algorithm>
#include <array>
#include <random>

#include "support/mapped_meshes.hpp"

namespace hexfield::testing {

/// Blocks of a grid with the given steps along each axis, those that `holds(i, j, k)`; one integer-grid map.
template <class Holds>
MappedMesh grid_of_blocks(const std::array<std::vector<int>, 3>& steps, const Holds& holds) {
  const auto at = [&](std::size_t axis, int i) {
    double x = 0;
    for (int s = 0; s < i; ++s) x += steps[axis][static_cast<std::size_t>(s)];
    return x;
  };
  const auto count = [&](std::size_t axis) { return static_cast<int>(steps[axis].size()); };
  std::map<std::array<int, 3>, int> ids;
  std::vector<Vec3> points;
  std::vector<std::array<int, 8>> blocks;
  std::vector<Vec3> extents;
  constexpr int bits[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  for (int k = 0; k < count(2); ++k)
    for (int j = 0; j < count(1); ++j)
      for (int i = 0; i < count(0); ++i) {
        if (!holds(i, j, k)) continue;
        auto& block = blocks.emplace_back();
        for (std::size_t c = 0; c < 8; ++c) {
          const std::array<int, 3> p{i + bits[c][0], j + bits[c][1], k + bits[c][2]};
          const auto [found, fresh] = ids.emplace(p, static_cast<int>(points.size()));
          if (fresh) points.emplace_back(at(0, p[0]), at(1, p[1]), at(2, p[2]));
          block[c] = found->second;
        }
        extents.emplace_back(steps[0][static_cast<std::size_t>(i)], steps[1][static_cast<std::size_t>(j)],
                             steps[2][static_cast<std::size_t>(k)]);
      }
  return block_map(std::move(points), blocks, extents);
}

/// Section of widths w1 w2 and depths d1 d2 without its far corner, one concave edge.
inline MappedMesh l_prism(int w1, int w2, int d1, int d2, int h) {
  return grid_of_blocks({{{w1, w2}, {d1, d2}, {h}}}, [](int i, int j, int) { return i == 0 || j == 0; });
}

/// Box with a slot of width w2 and height h2 through it along the second axis.
inline MappedMesh slotted_box(int w1, int w2, int w3, int depth, int h1, int h2) {
  return grid_of_blocks({{{w1, w2, w3}, {depth}, {h1, h2}}}, [](int i, int, int k) { return k == 0 || i != 1; });
}

/// Cube without one of its corners: three concave edges that meet.
inline MappedMesh cube_without_corner(int inner, int outer) {
  return grid_of_blocks({{{inner, outer}, {inner, outer}, {inner, outer}}},
                        [](int i, int j, int k) { return i + j + k < 3; });
}

/// Ball: a cube of a x b x c hexes, and a block of thickness r on each of its sides.
inline MappedMesh ball(int a, int b, int c, int r) {
  std::vector<Vec3> points;
  constexpr int bits[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  for (const double size : {1.0, 2.0})
    for (const auto& bit : bits) points.emplace_back(size * Vec3(2 * bit[0] - 1, 2 * bit[1] - 1, 2 * bit[2] - 1));
  constexpr int faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  std::vector<std::array<int, 8>> blocks{{0, 1, 2, 3, 4, 5, 6, 7}};
  std::vector<Vec3> extents{Vec3(a, b, c)};
  for (const auto& face : faces) {
    auto& block = blocks.emplace_back();
    for (std::size_t k = 0; k < 4; ++k) {
      block[k] = face[k];
      block[k + 4] = face[k] + 8;
    }
    const auto along = [&](int from, int to) {
      const int axis = bits[from][0] != bits[to][0] ? 0 : (bits[from][1] != bits[to][1] ? 1 : 2);
      return std::array<int, 3>{a, b, c}[static_cast<std::size_t>(axis)];
    };
    extents.emplace_back(along(face[0], face[1]), along(face[0], face[3]), r);
  }
  return block_map(std::move(points), blocks, extents);
}

/// Solid torus whose section is a disc: a square of a x b hexes, and a block of thickness r on each of its sides;
/// four closed singular curves. steps: hexes along it, per sector.
inline MappedMesh disc_torus(const std::vector<int>& steps, int a, int b, int r) {
  const int sectors = static_cast<int>(steps.size());
  std::vector<Vec3> points;
  for (int s = 0; s < sectors; ++s)
    for (const double size : {1.0, 2.0})
      for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
        const double angle = 2 * M_PI * s / sectors;
        const double radius = 6 + size * x;
        points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), size * y);
      }
  std::vector<std::array<int, 8>> blocks;
  std::vector<Vec3> extents;
  // A point's radius is x and its height y, so (radius, height, angle) is left-handed: sections are listed turned.
  constexpr int sections[5][4] = {{0, 3, 2, 1}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  for (int s = 0; s < sectors; ++s)
    for (std::size_t q = 0; q < 5; ++q) {
      auto& block = blocks.emplace_back();
      for (std::size_t k = 0; k < 4; ++k) {
        block[k] = 8 * s + sections[q][k];
        block[k + 4] = 8 * ((s + 1) % sectors) + sections[q][k];
      }
      const double n = steps[static_cast<std::size_t>(s)];
      extents.push_back(q == 0 ? Vec3(b, a, n) : Vec3(q % 2 == 1 ? a : b, r, n));
    }
  return block_map(std::move(points), blocks, extents);
}

/// Independent noise on every corner of every tet.
inline void perturb(CornerMap& map, double size) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> noise(-size, size);
  for (auto& tet : map.uvw)
    for (Vec3& p : tet) p += Vec3(noise(random), noise(random), noise(random));
}

/// Moves the images of inner vertices off singular curves, each by up to `size` and in all charts around it alike, so
/// that planes of the map are no faces of the mesh any more. The map stays seamless.
inline void shake(MappedMesh& m, double size) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> noise(-size, size);
  std::vector<std::vector<TetId>> star(m.mesh.num_vertices());
  for (std::size_t t = 0; t < m.mesh.num_tets(); ++t)
    for (VertexId v : m.mesh.tets[t]) star[v.index()].push_back(TetId(t));
  for (std::size_t v = 0; v < star.size(); ++v) {
    if (star[v].empty()) continue;
    std::map<TetId, octahedral::Rotation> turn{{star[v][0], octahedral::identity}};
    std::vector<TetId> queue{star[v][0]};
    bool free = true;
    for (std::size_t k = 0; k < queue.size(); ++k)
      for (int i = 0; i < 4; ++i) {
        const HalfFaceId h(queue[k], i);
        if (m.mesh.vertices(queue[k])[static_cast<std::size_t>(i)] == VertexId(v)) continue;
        if (m.mesh.is_boundary(h)) {
          free = false;
          continue;
        }
        const TetId next = m.mesh.opposite_half_face(h).tet();
        const octahedral::Rotation there = octahedral::product(m.map.rotation(h), turn.at(queue[k]));
        const auto [found, fresh] = turn.emplace(next, there);
        if (fresh) queue.push_back(next);
        free = free && found->second == there;
      }
    const Vec3 move(noise(random), noise(random), noise(random));
    if (!free) continue;
    for (const auto& [t, r] : turn)
      m.map.uvw[t.index()][static_cast<std::size_t>(m.mesh.local_index(t, VertexId(v)))] += octahedral::apply(r, move);
  }
}

}  // namespace hexfield::testing
