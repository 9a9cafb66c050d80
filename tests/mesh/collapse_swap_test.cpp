#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "hexfield/mesh/edit_legality.hpp"
#include "hexfield/mesh/manifold.hpp"
#include "hexfield/mesh/quality.hpp"
#include "support/mapped_meshes.hpp"

using namespace hexfield;
using hexfield::testing::kuhn_box;

namespace {

void expect_rebuild_agrees(TetMesh mesh) {
  compact(mesh, {});
  const TetMesh rebuilt = build_tet_mesh(mesh.points, mesh.tets);
  EXPECT_EQ(rebuilt.opposite, mesh.opposite);
  EXPECT_TRUE(find_non_manifold(mesh).empty());
}

int euler_characteristic(const Features& features, int colour) {
  std::set<VertexId> vertices;
  std::set<EdgeKey> edges;
  int faces = 0;
  for (const auto& [f, c] : features.faces) {
    if (c != colour) continue;
    ++faces;
    vertices.insert(f.begin(), f.end());
    edges.insert({edge_key(f[0], f[1]), edge_key(f[1], f[2]), edge_key(f[0], f[2])});
  }
  return static_cast<int>(vertices.size()) - static_cast<int>(edges.size()) + faces;
}

double area(const TetMesh& mesh, const Features& features, int colour) {
  double sum = 0;
  for (const auto& [f, c] : features.faces)
    if (c == colour) sum += (mesh.point(f[1]) - mesh.point(f[0])).cross(mesh.point(f[2]) - mesh.point(f[0])).norm() / 2;
  return sum;
}

double length(const TetMesh& mesh, const Features& features, int colour) {
  double sum = 0;
  for (const auto& [e, c] : features.edges)
    if (c == colour) sum += (mesh.point(e[0]) - mesh.point(e[1])).norm();
  return sum;
}

TetId random_tet(const TetMesh& mesh, std::mt19937& random) {
  for (;;) {
    const TetId t(static_cast<std::int64_t>(random() % mesh.num_tets()));
    if (mesh.alive(t)) return t;
  }
}

std::pair<VertexId, VertexId> random_edge(const TetMesh& mesh, std::mt19937& random) {
  const auto& v = mesh.vertices(random_tet(mesh, random));
  const auto& e = tet_edge_vertices[random() % 6];
  const auto a = v[static_cast<std::size_t>(e[0])], b = v[static_cast<std::size_t>(e[1])];
  return random() % 2 == 0 ? std::pair{a, b} : std::pair{b, a};
}

struct Counts {
  int splits = 0, collapses = 0, edge_swaps = 0, flips = 0, face_swaps = 0;
};

// A fan from a random vertex of the ring; with walls, from one of them.
RingTriangulation fan(std::size_t n, const std::vector<int>& walls, std::mt19937& random) {
  RingTriangulation t;
  const int size = static_cast<int>(n);
  int apex = static_cast<int>(random() % n);
  if (walls.size() == 2) t.walls = {walls[0], walls[1]}, apex = walls[random() % 2];
  for (int k = 1; k + 1 < size; ++k) {
    std::array<int, 3> corners{apex, (apex + k) % size, (apex + k + 1) % size};
    std::sort(corners.begin(), corners.end());
    t.triangles.push_back(corners);
  }
  return t;
}

void try_edge_swap(TetMesh& mesh, const Features& features, std::mt19937& random,
                   const std::vector<MeshAttribute*>& attributes, Counts& counts) {
  const auto [a, b] = random_edge(mesh, random);
  const TetId seed = find_tet_with_edge(mesh, a, b);
  const EdgeRing ring = edge_ring(mesh, seed, a, b);
  const auto around = ring_vertices(mesh, ring, a, b);
  const auto walls = ring_walls(features, ring, around, a, b);
  if (walls.size() != 0 && walls.size() != 2) return;
  const RingTriangulation t = fan(around.size(), walls, random);
  if (!swap_keeps_topology(mesh, features, ring, around, t, a, b) || !swap_keeps_positive(mesh, around, t, a, b))
    return;
  const double before = total_volume(mesh);
  const bool flat = std::abs(before - 8) < 1e-9;
  swap_edge(mesh, seed, a, b, t, attributes);
  EXPECT_TRUE(flat && std::abs(total_volume(mesh) - before) < 1e-11);
  ++(walls.empty() ? counts.edge_swaps : counts.flips);
}

void random_edit(TetMesh& mesh, const Features& features, std::mt19937& random,
                 const std::vector<MeshAttribute*>& attributes, Counts& counts) {
  switch (random() % 8) {
    case 0:
    case 4: {
      const auto [a, b] = random_edge(mesh, random);
      split_edge(mesh, a, b, attributes);
      ++counts.splits;
      break;
    }
    case 1:
    case 5: {
      const HalfFaceId h(random_tet(mesh, random), static_cast<int>(random() % 4));
      if (!can_swap_face(mesh, features, h)) break;
      swap_face(mesh, h, attributes);
      ++counts.face_swaps;
      break;
    }
    case 2:
    case 3:
      try_edge_swap(mesh, features, random, attributes, counts);
      break;
    default: {
      const auto [from, to] = random_edge(mesh, random);
      if (!collapse_keeps_topology(mesh, features, from, to) || !collapse_keeps_positive(mesh, from, to)) break;
      collapse_edge(mesh, from, to, attributes);
      ++counts.collapses;
      EXPECT_FALSE(mesh.vertex_tet[from.index()].valid());
    }
  }
}

// The box of side 2 with its sides, edges, corners and an inner wall between two materials.
Features two_materials(const TetMesh& mesh) {
  Features features = hexfield::testing::box_features(mesh, Vec3(2, 2, 2));
  for (std::size_t t = 0; t < mesh.num_tets(); ++t) {
    features.tet_colours.push_back(centroid(mesh, TetId(t)).z() < 1 ? 1 : 2);
    for (int i = 0; i < 4; ++i) {
      const FaceKey f = mesh.key(HalfFaceId(TetId(static_cast<std::int64_t>(t)), i));
      if (std::all_of(f.begin(), f.end(), [&](VertexId v) { return mesh.point(v).z() == 1; })) features.faces[f] = 7;
    }
  }
  complete_features(mesh, features);
  return features;
}

}  // namespace

TEST(CollapseSwap, HundredsOfRandomEditsKeepMeshAndFeatures) {
  TetMesh mesh = kuhn_box(2, 2, 2);
  Features features = two_materials(mesh);
  ASSERT_TRUE(check(mesh, features).empty());
  const Features before = features;
  const TetMesh start = mesh;
  FeatureAttribute attribute(features);
  std::mt19937 random(11);
  Counts counts;
  for (int round = 0; round < 60; ++round) {
    for (int i = 0; i < 100; ++i) random_edit(mesh, features, random, {&attribute}, counts);
    ASSERT_TRUE(check(mesh).empty());
    ASSERT_TRUE(check(mesh, features).empty()) << check(mesh, features)[0].sentence;
    EXPECT_NEAR(total_volume(mesh), 8, 1e-10);
    std::set<int> surfaces, curves;
    for (const auto& [f, colour] : before.faces) surfaces.insert(colour);
    for (const auto& [e, colour] : before.edges) curves.insert(colour);
    for (int colour : surfaces) {
      EXPECT_EQ(euler_characteristic(features, colour), euler_characteristic(before, colour));
      EXPECT_NEAR(area(mesh, features, colour), area(start, before, colour), 1e-10);
    }
    for (int colour : curves) EXPECT_NEAR(length(mesh, features, colour), length(start, before, colour), 1e-10);
    EXPECT_EQ(features.points, before.points);
  }
  for (std::size_t t = 0; t < mesh.num_tets(); ++t) {
    if (!mesh.alive(TetId(t))) continue;
    EXPECT_EQ(features.tet_colours[t], centroid(mesh, TetId(t)).z() < 1 ? 1 : 2);
  }
  EXPECT_GT(counts.collapses, 100);
  EXPECT_GT(counts.edge_swaps, 50);
  EXPECT_GT(counts.flips, 10);
  EXPECT_GT(counts.face_swaps, 50);
  expect_rebuild_agrees(mesh);
}

TEST(CollapseSwap, FaceSwapIsUndoneByEdgeSwap) {
  const std::vector<Vec3> points = {{0, 0, -1}, {1, 0, 0}, {-0.5, 0.8, 0}, {-0.5, -0.8, 0}, {0, 0, 1}};
  const auto tet = [](int a, int b, int c, int d) {
    return std::array{VertexId(a), VertexId(b), VertexId(c), VertexId(d)};
  };
  TetMesh mesh = build_tet_mesh(points, {tet(1, 3, 2, 0), tet(1, 2, 3, 4)});
  ASSERT_TRUE(check(mesh).empty());
  const HalfFaceId h = find_half_face(mesh, face_key(VertexId(1), VertexId(2), VertexId(3)));
  ASSERT_TRUE(can_swap_face(mesh, {}, h));
  swap_face(mesh, h, {});
  EXPECT_TRUE(check(mesh).empty());
  const TetId seed = find_tet_with_edge(mesh, VertexId(0), VertexId(4));
  const EdgeRing ring = edge_ring(mesh, seed, VertexId(0), VertexId(4));
  const auto around = ring_vertices(mesh, ring, VertexId(0), VertexId(4));
  ASSERT_EQ(around.size(), 3u);
  RingTriangulation t{{{0, 1, 2}}};
  ASSERT_TRUE(swap_keeps_topology(mesh, {}, ring, around, t, VertexId(0), VertexId(4)));
  ASSERT_TRUE(swap_keeps_positive(mesh, around, t, VertexId(0), VertexId(4)));
  swap_edge(mesh, seed, VertexId(0), VertexId(4), t, {});
  EXPECT_TRUE(check(mesh).empty());
  EXPECT_FALSE(find_tet_with_edge(mesh, VertexId(0), VertexId(4)).valid());
  compact(mesh, {});
  EXPECT_EQ(mesh.num_tets(), 2u);
}

TEST(CollapseSwap, WhatWouldTearFeaturesIsRefused) {
  const TetMesh mesh = kuhn_box(2, 2, 2);
  const Features features = two_materials(mesh);
  const VertexId corner(0), on_edge(1), on_side(4), centre(13);
  EXPECT_FALSE(collapse_keeps_topology(mesh, features, corner, on_edge));  // a feature point
  EXPECT_TRUE(collapse_keeps_topology(mesh, features, on_edge, corner));
  EXPECT_FALSE(collapse_keeps_topology(mesh, features, on_edge, on_side));  // off the curve
  EXPECT_FALSE(collapse_keeps_topology(mesh, features, on_side, centre));   // off the surface
  // The wall in the middle has one inner vertex: it may move in the wall only.
  ASSERT_EQ(mesh.point(centre), Vec3(1, 1, 1));
  EXPECT_FALSE(collapse_keeps_topology(mesh, features, centre, on_side));
  EXPECT_TRUE(collapse_keeps_topology(mesh, features, centre, VertexId(14)));
}

TEST(CollapseSwap, LinkConditionSeesAHandle) {
  // A solid torus of three prisms around: collapsing along it would close the hole.
  const auto torus = hexfield::testing::square_torus(4, 4, 1, 1);
  const Features none;
  int allowed = 0;
  for (std::size_t v = 0; v < torus.mesh.num_vertices(); ++v)
    for (std::size_t w = 0; w < torus.mesh.num_vertices(); ++w) {
      const VertexId a(v), b(w);
      if (a == b || !find_tet_with_edge(torus.mesh, a, b).valid()) continue;
      if (!collapse_keeps_topology(torus.mesh, none, a, b)) continue;
      ++allowed;
      TetMesh copy = torus.mesh;
      collapse_edge(copy, a, b, {});
      compact(copy, {});
      const TetMesh rebuilt = build_tet_mesh(copy.points, copy.tets);
      EXPECT_EQ(rebuilt.opposite, copy.opposite);
      EXPECT_TRUE(find_non_manifold(rebuilt).empty());
    }
  EXPECT_GT(allowed, 0);
}

TEST(Quality, DistortionIsScaleFreeAndBestForTheRegularTet) {
  const Vec3 a(1, 1, 1), b(-1, 1, -1), c(1, -1, -1), d(-1, -1, 1);
  EXPECT_NEAR(tet_distortion(a, b, c, d), 27, 1e-12);
  EXPECT_NEAR(tet_distortion(3 * a, 3 * b, 3 * c, 3 * d), 27, 1e-12);
  EXPECT_NEAR(log_energy(27), std::log(3), 1e-15);
  EXPECT_GT(tet_distortion(a, b, c, Vec3(1, 1, 2)), 27.1);
  EXPECT_TRUE(std::isinf(tet_distortion(a, c, b, d)));
}
