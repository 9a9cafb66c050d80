#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hexfield/hex/hex_mesh.hpp"

namespace hexfield::hex {

/// Faces (outward), edges and corners of a VTK hexahedron; the first three neighbours of a corner are positive.
inline constexpr int hex_faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                        {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
inline constexpr int hex_edges[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                         {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
inline constexpr int hex_corners[8][4] = {{0, 1, 3, 4}, {1, 2, 0, 5}, {2, 3, 1, 6}, {3, 0, 2, 7},
                                          {4, 7, 5, 0}, {5, 4, 6, 1}, {6, 5, 7, 2}, {7, 6, 4, 3}};

/// Disjoint sets of integers.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) {
    for (std::size_t i = 0; i < n; ++i) parent_[i] = i;
  }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

/// A side of a hex with its sorted vertices.
struct HexSide {
  std::array<int, 4> key;
  std::int64_t side;  ///< 6 * hex + local face
};
/// All sides, sorted by key and then by side: equal keys are neighbours.
std::vector<HexSide> sorted_sides(const HexMesh& mesh);
/// The sides that no other hex has, ascending.
std::vector<std::int64_t> boundary_sides(const std::vector<HexSide>& sides);
/// Vertices of a side, counter-clockwise seen from outside its hex.
std::array<int, 4> side_vertices(const HexMesh& mesh, std::int64_t side);
/// All edges once, as ascending pairs in ascending order.
std::vector<std::array<int, 2>> sorted_edges(const HexMesh& mesh);

}  // namespace hexfield::hex
