#include "hexfield/mesh/features.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "support/meshes.hpp"

using namespace hexfield;
using hexfield::testing::kuhn_box;

namespace {

template <class Key>
std::map<int, int> sizes(const std::map<Key, int>& tagged) {
  std::map<int, int> count;
  for (const auto& [key, colour] : tagged) ++count[colour];
  return count;
}

// A round disc of thickness 1 with 4 n segments around.
TetMesh disc(int n) {
  TetMesh mesh = kuhn_box(n, n, 1);
  for (Vec3& p : mesh.points) {
    const Eigen::Vector2d q = 2 * p.head<2>() / n - Eigen::Vector2d::Ones();
    p.head<2>() = q * q.lpNorm<Eigen::Infinity>() / std::max(q.norm(), 1e-300);
  }
  return mesh;
}

TetMesh without(const TetMesh& mesh, const auto& remove) {
  std::vector<std::array<VertexId, 4>> tets;
  for (std::size_t t = 0; t < mesh.num_tets(); ++t)
    if (!remove(centroid(mesh, TetId(static_cast<std::int64_t>(t))))) tets.push_back(mesh.tets[t]);
  return build_tet_mesh(mesh.points, tets);
}

std::vector<int> halves(const TetMesh& mesh) {
  std::vector<int> colours;
  for (std::size_t t = 0; t < mesh.num_tets(); ++t) colours.push_back(centroid(mesh, TetId(t)).x() < 1 ? 4 : 9);
  return colours;
}

}  // namespace

TEST(Features, OfABoxAreItsSidesEdgesAndCorners) {
  const TetMesh mesh = kuhn_box(2, 3, 4);
  const Features features = features_from_angles(mesh);
  EXPECT_EQ(features.points.size(), 8u);
  std::set<int> point_colours;
  for (const auto& [v, colour] : features.points) point_colours.insert(colour);
  EXPECT_EQ(point_colours, (std::set<int>{1, 2, 3, 4, 5, 6, 7, 8}));
  const auto curves = sizes(features.edges);
  EXPECT_EQ(curves.size(), 12u);
  EXPECT_EQ(std::count_if(curves.begin(), curves.end(), [](const auto& c) { return c.second == 3; }), 4);
  EXPECT_EQ(sizes(features.faces).size(), 6u);
  EXPECT_EQ(features.faces.size(), 2u * 2 * (6 + 8 + 12));
  EXPECT_TRUE(check(mesh, features).empty());
}

TEST(Features, OnlyAnglesAboveTheLimitCount) {
  const TetMesh mesh = kuhn_box(2, 2, 2);
  const Features blunt = features_from_angles(mesh, 90);
  EXPECT_TRUE(blunt.edges.empty());
  EXPECT_TRUE(blunt.points.empty());
  EXPECT_EQ(sizes(blunt.faces), (std::map<int, int>{{1, 48}}));
  EXPECT_EQ(sizes(features_from_angles(mesh, 89.9).edges).size(), 12u);
}

TEST(Features, OfADiscAreTwoClosedCurvesWithoutPoints) {
  const TetMesh mesh = disc(6);
  ASSERT_TRUE(check(mesh).empty());
  const Features features = features_from_angles(mesh);
  EXPECT_TRUE(features.points.empty());
  EXPECT_EQ(sizes(features.edges), (std::map<int, int>{{1, 24}, {2, 24}}));
  EXPECT_EQ(sizes(features.faces).size(), 3u);
  EXPECT_TRUE(check(mesh, features).empty());
}

TEST(Features, ReentrantEdgesAndHolesAreFound) {
  const TetMesh ring =
      without(kuhn_box(3, 3, 1), [](const Vec3& p) { return p.x() > 1 && p.x() < 2 && p.y() > 1 && p.y() < 2; });
  const Features features = features_from_angles(ring);
  EXPECT_EQ(features.points.size(), 16u);
  EXPECT_EQ(sizes(features.edges).size(), 24u);
  EXPECT_EQ(sizes(features.faces).size(), 10u);
  EXPECT_TRUE(check(ring, features).empty());
}

TEST(Features, FacesBetweenMaterialsAreFeatures) {
  const TetMesh mesh = kuhn_box(2, 2, 2);
  const Features features = features_from_angles(mesh, 70, halves(mesh));
  EXPECT_EQ(features.faces.size(), 48u + 8);
  EXPECT_EQ(sizes(features.faces).size(), 11u);  // four sides are cut in two
  EXPECT_EQ(sizes(features.edges).size(), 20u);
  EXPECT_EQ(features.points.size(), 12u);
  EXPECT_TRUE(check(mesh, features).empty());
}

TEST(Features, CompletionKeepsEveryTagAndAddsNewColours) {
  const TetMesh mesh = kuhn_box(2, 2, 2);
  const Features full = features_from_angles(mesh);
  Features features;
  for (const auto& [f, colour] : full.faces)
    if (colour != 3) features.faces[f] = 10 * colour;
  for (const auto& [e, colour] : full.edges)
    if (colour != 5) features.edges[e] = 20 + colour;
  features.points[VertexId(13)] = 77;  // the centre; the corners are missing
  const Features given = features;
  complete_features(mesh, features);
  for (const auto& [f, colour] : given.faces) EXPECT_EQ(features.faces.at(f), colour);
  for (const auto& [e, colour] : given.edges) EXPECT_EQ(features.edges.at(e), colour);
  EXPECT_EQ(features.points.at(VertexId(13)), 77);
  for (const auto& [f, colour] : full.faces) {
    if (colour == 3) {
      EXPECT_EQ(features.faces.at(f), 61);
    }
  }
  EXPECT_EQ(features.faces.size(), full.faces.size());
  for (const auto& [e, colour] : full.edges) {
    if (colour == 5) {
      EXPECT_EQ(features.edges.at(e), 33);  // differently coloured sides meet there
    }
  }
  EXPECT_EQ(features.edges.size(), full.edges.size());
  EXPECT_EQ(features.points.size(), 9u);
  EXPECT_EQ(features.points.at(VertexId(0)), 78);
  EXPECT_TRUE(check(mesh, features).empty());
  Features again = features;
  complete_features(mesh, again);
  EXPECT_EQ(again.edges, features.edges);
  EXPECT_EQ(again.faces, features.faces);
  EXPECT_EQ(again.points, features.points);
}

TEST(Features, AnglesDoNotCountWhereEdgesAreTagged) {
  const TetMesh mesh = kuhn_box(1, 1, 1);
  Features features;
  features.edges[edge_key(VertexId(0), VertexId(1))] = 3;
  complete_features(mesh, features);
  EXPECT_EQ(features.edges, (std::map<EdgeKey, int>{{edge_key(VertexId(0), VertexId(1)), 3}}));
  EXPECT_EQ(sizes(features.faces), (std::map<int, int>{{1, 12}}));
  EXPECT_EQ(features.points.size(), 2u);  // the ends of a lone curve
}

TEST(Features, CurvesOfDifferentColoursMeetAtPoints) {
  const TetMesh mesh = disc(4);
  Features features = features_from_angles(mesh);
  int k = 0;
  for (auto& [e, colour] : features.edges)
    if (colour == 1 && k++ < 5) colour = 6;
  int changes = 0;
  for (std::size_t i = 0; i < mesh.num_vertices(); ++i) {
    std::set<int> at_vertex;
    for (const auto& [e, colour] : features.edges)
      if (e[0] == VertexId(i) || e[1] == VertexId(i)) at_vertex.insert(colour);
    changes += at_vertex.size() == 2;
  }
  EXPECT_GT(changes, 1);
  EXPECT_EQ(check(mesh, features).size(), static_cast<std::size_t>(changes));
  complete_features(mesh, features);
  EXPECT_EQ(features.points.size(), static_cast<std::size_t>(changes));
  EXPECT_TRUE(check(mesh, features).empty());
}

TEST(Features, CheckNamesWhatIsWrong) {
  const TetMesh mesh = kuhn_box(2, 2, 2);
  const Features good = features_from_angles(mesh, 70, halves(mesh));
  auto first = [&](const auto& spoil) {
    Features features = good;
    spoil(features);
    const auto found = check(mesh, features);
    return found.empty() ? std::string() : found[0].sentence;
  };
  EXPECT_EQ(first([](Features&) {}), "");
  EXPECT_EQ(first([](Features& f) { f.points[VertexId(99)] = 1; }), "Feature point 99 is no vertex of a tet.");
  EXPECT_EQ(first([](Features& f) { f.points[VertexId(13)] = 0; }),
            "Feature point 13 at (1, 1, 1) has no positive colour.");
  EXPECT_EQ(first([](Features& f) { f.edges[edge_key(VertexId(0), VertexId(26))] = 1; }),
            "Feature edge 0, 26 at (1, 1, 1) is no edge of a tet.");
  EXPECT_EQ(first([](Features& f) { f.faces[face_key(VertexId(0), VertexId(2), VertexId(8))] = 1; }),
            "Feature face 0, 2, 8 at (1.33333, 0.666667, 0) is no face of a tet.");
  EXPECT_EQ(first([](Features& f) { f.tet_colours.pop_back(); }), "There are 47 tet colours for 48 tets.");
  EXPECT_NE(first([](Features& f) { f.faces.erase(f.faces.begin()); }).find("boundary or interface face"),
            std::string::npos);
  EXPECT_NE(first([](Features& f) { f.edges.erase(f.edges.begin()); }).find("bounds 2 feature faces or two colours"),
            std::string::npos);
  EXPECT_NE(first([](Features& f) { f.points.erase(VertexId(0)); }).find("ends 3 feature edges"), std::string::npos);
}
