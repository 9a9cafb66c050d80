#include "ring_polygon.hpp"

#include <algorithm>
#include <limits>

namespace hexfield {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
std::size_t at(int i) { return static_cast<std::size_t>(i); }

class Polygons {
 public:
  // Vertices are counted from `start`; position n is the start again.
  Polygons(int n, int start, const TriangleCost& cost)
      : n_(n), start_(start), cost_(cost), worst_(at((n + 1) * (n + 1)), -1.0), apex_(worst_.size(), -1) {}

  // Worst triangle of the best triangulation of the polygon i, i + 1, ..., j.
  double best(int i, int j) {
    double& known = worst_[at(i * (n_ + 1) + j)];
    if (known >= 0) return known;
    if (j < i + 2) return known = 0;
    double least = infinity;
    for (int k = i + 1; k < j; ++k) {
      const auto t = corners(i, k, j);
      const double worst = std::max({best(i, k), best(k, j), cost_(t[0], t[1], t[2])});
      if (worst < least) least = worst, apex_[at(i * (n_ + 1) + j)] = k;
    }
    return worst_[at(i * (n_ + 1) + j)] = least;
  }

  void collect(int i, int j, std::vector<std::array<int, 3>>& triangles) const {
    if (j < i + 2) return;
    const int k = apex_[at(i * (n_ + 1) + j)];
    triangles.push_back(corners(i, k, j));
    collect(i, k, triangles);
    collect(k, j, triangles);
  }

 private:
  std::array<int, 3> corners(int i, int k, int j) const {
    std::array<int, 3> t{(i + start_) % n_, (k + start_) % n_, (j + start_) % n_};
    std::sort(t.begin(), t.end());
    return t;
  }

  int n_, start_;
  const TriangleCost& cost_;
  std::vector<double> worst_;
  std::vector<int> apex_;
};

}  // namespace

BestTriangulation best_triangulation(int n, std::array<int, 2> walls, const TriangleCost& cost) {
  BestTriangulation best;
  best.triangulation.walls = walls;
  const int start = std::max(walls[0], 0);
  Polygons polygons(n, start, cost);
  auto& triangles = best.triangulation.triangles;
  if (walls[0] < 0) {
    best.worst = polygons.best(0, n - 1);
    if (best.worst < infinity) polygons.collect(0, n - 1, triangles);
    return best;
  }
  const int other = walls[1] - start;
  best.worst = std::max(polygons.best(0, other), polygons.best(other, n));
  if (best.worst == infinity) return best;
  polygons.collect(0, other, triangles);
  polygons.collect(other, n, triangles);
  return best;
}

}  // namespace hexfield
