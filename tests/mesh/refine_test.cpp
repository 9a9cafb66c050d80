#include "hexfield/mesh/refine.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "hexfield/mesh/edge_table.hpp"
#include "support/meshes.hpp"

using namespace hexfield;
using hexfield::testing::kuhn_box;

namespace {

double area(const TetMesh& mesh, const Features& features, int colour) {
  double sum = 0;
  for (const auto& [f, c] : features.faces)
    if (c == colour) sum += (mesh.point(f[1]) - mesh.point(f[0])).cross(mesh.point(f[2]) - mesh.point(f[0])).norm() / 2;
  return sum;
}

double volume(const TetMesh& mesh, const Features& features, int colour) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.num_tets(); ++t)
    if (features.tet_colours[t] == colour) sum += signed_volume6(mesh, TetId(static_cast<std::int64_t>(t))) / 6;
  return sum;
}

// Not regular, so that the diagonals have different lengths.
TetMesh skewed_box() {
  TetMesh mesh = kuhn_box(2, 1, 2);
  for (Vec3& p : mesh.points) p += Vec3(0.3 * p.y() + 0.1 * p.z(), 0.2 * p.z() * p.x(), 0.15 * p.x());
  return mesh;
}

}  // namespace

TEST(EdgeTable, NumbersEveryEdgeOnce) {
  const TetMesh mesh = kuhn_box(2, 3, 2);
  const EdgeTable edges(mesh);
  // Kuhn boxes have cell edges, face diagonals and one diagonal per cell.
  EXPECT_EQ(edges.num_edges(), 2u * 4 * 3 + 3u * 3 * 3 + 3u * 4 * 2 + (2u * 3 * 3 + 2u * 2 * 4 + 3u * 2 * 3) + 12u);
  EdgeKey last{VertexId(0), VertexId(0)};
  edges.for_each([&](std::size_t i, const EdgeKey& e) {
    EXPECT_LT(last, e);
    EXPECT_LT(e[0], e[1]);
    last = e;
    EXPECT_EQ(edges.find(e[1], e[0]), static_cast<std::int64_t>(i));
    EXPECT_TRUE(find_tet_with_edge(mesh, e[0], e[1]).valid());
  });
  EXPECT_EQ(edges.find(VertexId(0), VertexId(35)), -1);
  EXPECT_EQ(edges.find(VertexId(35), VertexId(90)), -1);
  EXPECT_EQ(edges.find(VertexId(), VertexId(3)), -1);
}

TEST(Refine, KeepsVolumeFeaturesAndColours) {
  TetMesh mesh = skewed_box();
  Features features;
  for (std::size_t t = 0; t < mesh.num_tets(); ++t) features.tet_colours.push_back(t < 12 ? 2 : 5);
  complete_features(mesh, features, 40);
  const TetMesh coarse = mesh;
  const Features before = features;
  const std::size_t edges = EdgeTable(mesh).num_edges();
  refine_uniform(mesh, features);
  EXPECT_TRUE(check(mesh).empty());
  EXPECT_TRUE(check(mesh, features).empty());
  EXPECT_EQ(mesh.num_tets(), 8 * coarse.num_tets());
  EXPECT_EQ(mesh.num_vertices(), coarse.num_vertices() + edges);
  EXPECT_EQ(features.points, before.points);
  EXPECT_EQ(features.edges.size(), 2 * before.edges.size());
  EXPECT_EQ(features.faces.size(), 4 * before.faces.size());
  for (int colour = 1; colour <= 13; ++colour)
    EXPECT_NEAR(area(mesh, features, colour), area(coarse, before, colour), 1e-12);
  for (int colour : {2, 5}) EXPECT_NEAR(volume(mesh, features, colour), volume(coarse, before, colour), 1e-12);
  for (std::size_t t = 0; t < coarse.num_tets(); ++t) {
    double sum = 0;
    for (std::size_t k = 0; k < 8; ++k) {
      EXPECT_EQ(features.tet_colours[8 * t + k], before.tet_colours[t]);
      sum += signed_volume6(mesh, TetId(static_cast<std::int64_t>(8 * t + k)));
    }
    EXPECT_NEAR(sum, signed_volume6(coarse, TetId(static_cast<std::int64_t>(t))), 1e-13);
  }
}

TEST(Refine, CutsAlongTheShortestDiagonal) {
  const std::array<Vec3, 4> corners = {Vec3(0, 0, 0), Vec3(1, 0.1, 0), Vec3(0.2, 1.5, 0), Vec3(0.3, 0.4, 2)};
  std::set<std::size_t> chosen;
  for (const auto& turn : {std::array<std::size_t, 4>{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}}) {
    std::vector<Vec3> p;
    for (std::size_t i : turn) p.push_back(corners[i]);
    TetMesh mesh = build_tet_mesh(p, {{VertexId(0), VertexId(1), VertexId(2), VertexId(3)}});
    Features none;
    refine_uniform(mesh, none);
    EXPECT_TRUE(none.faces.empty());
    EXPECT_TRUE(none.tet_colours.empty());
    EXPECT_TRUE(check(mesh).empty());
    const std::array<double, 3> lengths = {(p[0] + p[1] - p[2] - p[3]).norm() / 2,
                                           (p[0] + p[2] - p[1] - p[3]).norm() / 2,
                                           (p[0] + p[3] - p[1] - p[2]).norm() / 2};
    const auto shortest = std::min_element(lengths.begin(), lengths.end());
    EXPECT_NEAR((mesh.point(mesh.tets[4][0]) - mesh.point(mesh.tets[4][1])).norm(), *shortest, 1e-12);
    chosen.insert(static_cast<std::size_t>(shortest - lengths.begin()));
  }
  EXPECT_EQ(chosen.size(), 3u);
}

TEST(Refine, TwiceIsTheSameEveryTime) {
  TetMesh a = kuhn_box(1, 1, 1), b = a;
  Features fa = features_from_angles(a), fb = fa;
  for (int round = 0; round < 2; ++round) {
    refine_uniform(a, fa);
    refine_uniform(b, fb);
  }
  EXPECT_EQ(a.num_tets(), 6u * 64);
  EXPECT_EQ(a.num_vertices(), 125u);
  EXPECT_EQ(a.tets, b.tets);
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(fa.faces, fb.faces);
  EXPECT_TRUE(check(a).empty());
  EXPECT_EQ(fa.edges.size(), 12u * 4);
  EXPECT_EQ(fa.faces.size(), 12u * 16);
}
