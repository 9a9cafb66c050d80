#pragma once

#include <array>
#include <functional>
#include <vector>

#include "hexfield/mesh/edit.hpp"

namespace hexfield {

/// Cost of the triangle of three positions of a ring (ascending); infinite where it is not allowed.
using TriangleCost = std::function<double(int, int, int)>;

struct BestTriangulation {
  RingTriangulation triangulation;
  double worst = 0;  ///< largest cost of its triangles; infinite when there is none
};

/// The triangulation of a ring of n vertices whose worst triangle costs least (dynamic programming over diagonals,
/// O(n^3)); `walls` as in RingTriangulation. In closed rings a triangle costs the same in any order of its corners.
BestTriangulation best_triangulation(int n, std::array<int, 2> walls, const TriangleCost& cost);

}  // namespace hexfield
