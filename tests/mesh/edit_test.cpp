#include "hexfield/mesh/edit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "hexfield/mesh/quality.hpp"
#include "support/meshes.hpp"

using namespace hexfield;
using hexfield::testing::kuhn_box;
using hexfield::testing::surface_euler_characteristic;

namespace {

TetId random_tet(const TetMesh& mesh, std::mt19937& random) {
  for (;;) {
    const TetId t(static_cast<std::int64_t>(random() % mesh.num_tets()));
    if (mesh.alive(t)) return t;
  }
}

VertexId random_split(TetMesh& mesh, std::mt19937& random, const std::vector<MeshAttribute*>& attributes) {
  const TetId t = random_tet(mesh, random);
  switch (random() % 3) {
    case 0: {
      const auto& e = tet_edge_vertices[random() % 6];
      const auto& v = mesh.vertices(t);
      return split_edge(mesh, v[static_cast<std::size_t>(e[0])], v[static_cast<std::size_t>(e[1])], attributes);
    }
    case 1:
      return split_face(mesh, HalfFaceId(t, static_cast<int>(random() % 4)), attributes);
    default:
      return split_tet(mesh, t, attributes);
  }
}

// The mesh that build_tet_mesh() makes of the alive tets has the neighbours that the edits left.
void expect_rebuild_agrees(TetMesh mesh) {
  compact(mesh, {});
  const TetMesh rebuilt = build_tet_mesh(mesh.points, mesh.tets);
  EXPECT_EQ(rebuilt.opposite, mesh.opposite);
}

// Boundary faces and one inner plane as feature faces, its border and the box's edges as feature edges.
Features box_features(const TetMesh& mesh) {
  Features features;
  auto plane = [&](const FaceKey& f, int axis, double value) {
    return std::all_of(f.begin(), f.end(), [&](VertexId v) { return mesh.point(v)[axis] == value; });
  };
  for (std::size_t t = 0; t < mesh.num_tets(); ++t)
    for (int i = 0; i < 4; ++i) {
      const HalfFaceId h(TetId(static_cast<std::int64_t>(t)), i);
      if (plane(mesh.key(h), 2, 1)) features.faces[mesh.key(h)] = 7;
      if (mesh.is_boundary(h))
        for (int axis = 0; axis < 3; ++axis)
          for (int side = 0; side < 2; ++side)
            if (plane(mesh.key(h), axis, 2 * side)) features.faces[mesh.key(h)] = 1 + 2 * axis + side;
      for (const auto& e : {std::array{0, 1}, std::array{1, 2}, std::array{2, 0}}) {
        const auto f = mesh.face_vertices(h);
        const EdgeKey edge = edge_key(f[static_cast<std::size_t>(e[0])], f[static_cast<std::size_t>(e[1])]);
        int fixed = 0;
        for (int axis = 0; axis < 3; ++axis) {
          const double x = mesh.point(edge[0])[axis];
          fixed += x == mesh.point(edge[1])[axis] && (x == 0 || x == 2);
        }
        if (fixed >= 2) features.edges[edge] = 9;
      }
    }
  features.tet_colours.resize(mesh.num_tets());
  for (std::size_t t = 0; t < mesh.num_tets(); ++t)
    features.tet_colours[t] = centroid(mesh, TetId(static_cast<std::int64_t>(t))).z() < 1 ? 1 : 2;
  return features;
}

double length(const TetMesh& mesh, const Features& features) {
  double sum = 0;
  for (const auto& [edge, colour] : features.edges) sum += (mesh.point(edge[0]) - mesh.point(edge[1])).norm();
  return sum;
}

double area(const TetMesh& mesh, const Features& features, int colour) {
  double sum = 0;
  for (const auto& [f, c] : features.faces)
    if (c == colour) sum += (mesh.point(f[1]) - mesh.point(f[0])).cross(mesh.point(f[2]) - mesh.point(f[0])).norm() / 2;
  return sum;
}

// Keeps the keys of all half-faces, to compare origins with.
struct OriginCheck : MeshAttribute {
  std::vector<std::array<FaceKey, 4>> keys;
  std::size_t checked = 0;

  void note(const TetMesh& mesh) {
    for (std::size_t t = keys.size(); t < mesh.num_tets(); ++t) {
      auto& k = keys.emplace_back();
      for (int i = 0; i < 4; ++i) k[static_cast<std::size_t>(i)] = mesh.key(HalfFaceId(TetId(t), i));
    }
  }
  void on_split(const TetMesh& mesh, const SplitRecord& record) override {
    EXPECT_EQ(record.half_faces.size(), 4 * record.child_of.size());
    for (const auto& [child, old] : record.child_of) {
      EXPECT_TRUE(mesh.alive(child));
      EXPECT_FALSE(mesh.alive(old));
    }
    for (std::size_t k = 0; k < record.half_faces.size(); ++k) {
      const NewHalfFace& part = record.half_faces[k];
      const auto& [child, old] = record.child_of[k / 4];
      EXPECT_EQ(part.half_face, HalfFaceId(child, static_cast<int>(k % 4)));
      if (!part.origin.valid()) {
        const HalfFaceId beyond = mesh.opposite_half_face(part.half_face);
        ASSERT_TRUE(beyond.valid());
        bool siblings = false;
        for (const auto& pair : record.child_of) siblings |= pair.first == beyond.tet() && pair.second == old;
        EXPECT_TRUE(siblings);
        continue;
      }
      EXPECT_EQ(part.origin.tet(), old);
      EXPECT_EQ(part.origin.local(), part.half_face.local());
      EXPECT_EQ(origin_face(mesh, record, part),
                keys[part.origin.tet().index()][static_cast<std::size_t>(part.origin.local())]);
      ++checked;
    }
    note(mesh);
  }
  void on_compact(const std::vector<TetId>&) override {}
};

}  // namespace

TEST(Edit, OneTetSplitsInEveryWay) {
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::array<VertexId, 4> tet = {VertexId(0), VertexId(1), VertexId(2), VertexId(3)};
  TetMesh edge = build_tet_mesh(points, {tet});
  EXPECT_EQ(split_edge(edge, VertexId(2), VertexId(0), {}), VertexId(4));
  EXPECT_EQ(edge.point(VertexId(4)), Vec3(0, 0.5, 0));
  EXPECT_EQ(edge.num_tets(), 3u);
  TetMesh face = build_tet_mesh(points, {tet});
  split_face(face, HalfFaceId(TetId(0), 3), {});
  EXPECT_NEAR((face.point(VertexId(4)) - Vec3(1, 1, 0) / 3).norm(), 0, 1e-15);
  EXPECT_EQ(face.num_tets(), 4u);
  TetMesh inner = build_tet_mesh(points, {tet});
  split_tet(inner, TetId(0), {});
  EXPECT_EQ(inner.num_tets(), 5u);
  for (const TetMesh& mesh : {edge, face, inner}) {
    EXPECT_TRUE(check(mesh).empty());
    EXPECT_FALSE(mesh.alive(TetId(0)));
    EXPECT_NEAR(total_volume(mesh), 1.0 / 6, 1e-15);
    expect_rebuild_agrees(mesh);
  }
}

TEST(Edit, MissingSimplicesAreRefused) {
  TetMesh mesh = kuhn_box(2, 2, 2);
  EXPECT_THROW(split_edge(mesh, VertexId(0), VertexId(26), {}), Error);
  EXPECT_THROW(split_edge(mesh, VertexId(0), VertexId(0), {}), Error);
  split_tet(mesh, TetId(0), {});
  EXPECT_THROW(split_tet(mesh, TetId(0), {}), Error);
  EXPECT_THROW(split_face(mesh, HalfFaceId(TetId(0), 1), {}), Error);
  EXPECT_TRUE(check(mesh).empty());
}

TEST(Edit, HundredsOfRandomSplitsKeepMeshFeaturesAndOrigins) {
  TetMesh mesh = kuhn_box(2, 2, 2);
  Features features = box_features(mesh);
  const Features before = features;
  const double length_before = length(mesh, features);
  EXPECT_NEAR(length_before, 24, 1e-12);
  EXPECT_EQ(surface_euler_characteristic(features), 3);  // a sphere with a disc inside
  FeatureAttribute feature_attribute(features);
  OriginCheck origins;
  origins.note(mesh);
  std::mt19937 random(5);
  for (int round = 0; round < 4; ++round) {
    for (int i = 0; i < 150; ++i) random_split(mesh, random, {&feature_attribute, &origins});
    EXPECT_TRUE(check(mesh).empty());
    EXPECT_NEAR(total_volume(mesh), 8, 1e-11);
    EXPECT_NEAR(length(mesh, features), length_before, 1e-11);
    EXPECT_EQ(surface_euler_characteristic(features), 3);
    for (int colour = 1; colour <= 7; ++colour) EXPECT_NEAR(area(mesh, features, colour), 4, 1e-11);
  }
  EXPECT_GT(origins.checked, 5000u);
  EXPECT_GT(features.faces.size(), before.faces.size());
  expect_rebuild_agrees(mesh);

  const std::size_t slots = mesh.num_tets();
  compact(mesh, {&feature_attribute});
  EXPECT_LT(mesh.num_tets(), slots);
  EXPECT_TRUE(check(mesh).empty());
  ASSERT_EQ(features.tet_colours.size(), mesh.num_tets());
  double volumes[2] = {0, 0};
  for (std::size_t t = 0; t < mesh.num_tets(); ++t) {
    ASSERT_TRUE(mesh.alive(TetId(t)));
    volumes[features.tet_colours[t] - 1] += signed_volume6(mesh, TetId(t)) / 6;
    EXPECT_EQ(features.tet_colours[t], centroid(mesh, TetId(t)).z() < 1 ? 1 : 2);
  }
  EXPECT_NEAR(volumes[0], 4, 1e-11);
  for (const auto& [f, colour] : features.faces) EXPECT_TRUE(find_half_face(mesh, f).valid());
  for (const auto& [e, colour] : features.edges) EXPECT_TRUE(find_tet_with_edge(mesh, e[0], e[1]).valid());
}

TEST(Edit, SplitFeatureEdgeAndFaceInheritTheirColours) {
  TetMesh mesh = kuhn_box(1, 1, 1);
  Features features;
  features.edges[edge_key(VertexId(0), VertexId(7))] = 4;  // the diagonal, inside
  const HalfFaceId h(TetId(0), 0);
  features.faces[mesh.key(h)] = 5;
  FeatureAttribute attribute(features);
  const VertexId on_edge = split_edge(mesh, VertexId(7), VertexId(0), {&attribute});
  EXPECT_EQ(features.edges,
            (std::map<EdgeKey, int>{{edge_key(VertexId(0), on_edge), 4}, {edge_key(VertexId(7), on_edge), 4}}));
  const FaceKey face = features.faces.begin()->first;
  const VertexId on_face = split_face(mesh, find_half_face(mesh, face), {&attribute});
  EXPECT_EQ(features.faces, (std::map<FaceKey, int>{{face_key(face[0], face[1], on_face), 5},
                                                    {face_key(face[0], face[2], on_face), 5},
                                                    {face_key(face[1], face[2], on_face), 5}}));
}
