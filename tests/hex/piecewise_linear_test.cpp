#include "hexfield/hex/piecewise_linear.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "support/block_maps.hpp"

using namespace hexfield;
using namespace hexfield::testing;

namespace {

using Edge = std::array<int, 2>;

std::set<Edge> edges_of(const HexMesh& mesh) {
  constexpr int pairs[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  std::set<Edge> edges;
  for (const auto& hex : mesh.hexes)
    for (const auto& p : pairs) {
      const auto [a, b] = std::minmax(hex[static_cast<std::size_t>(p[0])], hex[static_cast<std::size_t>(p[1])]);
      edges.insert({a, b});
    }
  return edges;
}

std::size_t sides_of(const HexMesh& mesh) {
  constexpr int faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  std::set<std::array<int, 4>> sides;
  for (const auto& hex : mesh.hexes)
    for (const auto& f : faces) {
      std::array<int, 4> side;
      for (std::size_t k = 0; k < 4; ++k) side[k] = hex[static_cast<std::size_t>(f[k])];
      std::sort(side.begin(), side.end());
      sides.insert(side);
    }
  return sides.size();
}

double area(const std::vector<Vec3>& polygon) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 2; i < polygon.size(); ++i)
    sum += 0.5 * (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
  return sum.norm();
}

}  // namespace

// The pieces of a hex edge lead from one of its ends to the other, whatever lies between.
TEST(PiecewiseLinear, PiecesOfEveryEdgeJoinItsEnds) {
  for (MappedMesh m :
       {polygon_prism({2, 3, 4}, 3), ball(2, 3, 2, 2), l_prism(2, 1, 3, 2, 2), square_torus(8, 5, 2, 3)}) {
    shake(m, 0.2);
    const PiecewiseLinearHexes result = extract_piecewise_linear(m.mesh, {}, m.map);
    std::map<Edge, Vec3> sums;
    std::map<Edge, int> pieces;
    for (const auto& piece : result.arcs) {
      const bool turned = piece.vertices[0] > piece.vertices[1];
      const Edge edge = turned ? Edge{piece.vertices[1], piece.vertices[0]} : piece.vertices;
      const Vec3 along = turned ? piece.ends[0] - piece.ends[1] : piece.ends[1] - piece.ends[0];
      const auto found = sums.emplace(edge, Vec3::Zero()).first;
      found->second += along;
      ++pieces[edge];
    }
    const std::set<Edge> edges = edges_of(result.mesh);
    EXPECT_EQ(sums.size(), edges.size());
    int bent = 0;
    for (const auto& [edge, sum] : sums) {
      EXPECT_TRUE(edges.contains(edge));
      const auto at = [&](std::size_t k) { return result.mesh.points[static_cast<std::size_t>(edge[k])]; };
      EXPECT_LT((sum - (at(1) - at(0))).norm(), 1e-7);
      bent += pieces[edge] > 1;
    }
    EXPECT_GT(bent, 0);
    std::set<std::array<int, 4>> sides;
    for (const auto& piece : result.patches) {
      std::array<int, 4> side = piece.vertices;
      std::sort(side.begin(), side.end());
      sides.insert(side);
    }
    EXPECT_EQ(sides.size(), sides_of(result.mesh));
  }
}

TEST(PiecewiseLinear, PiecesOfABoxHaveItsLengthsAndAreasOnce) {
  for (const auto& [cells, n] : {std::pair{1, 3}, {3, 2}, {2, 2}, {2, 5}}) {
    const MappedMesh m = scaled_box(cells, cells, cells, Vec3::Constant(static_cast<double>(n) / cells));
    const PiecewiseLinearHexes result = extract_piecewise_linear(m.mesh, {}, m.map);
    double length = 0, whole = 0;
    for (const auto& piece : result.arcs) length += (piece.ends[1] - piece.ends[0]).norm();
    for (const auto& piece : result.patches) whole += area(piece.corners);
    const double size = cells;
    EXPECT_NEAR(length, 3 * (n + 1) * (n + 1) * size, 1e-9);
    EXPECT_NEAR(whole, 3 * (n + 1) * size * size, 1e-9);
  }
}
