#include "hexfield/mesh/surface.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/meshes.hpp"

using namespace hexfield;
using hexfield::testing::kuhn_box;

namespace {

Vec3 random_point(std::mt19937& random, double low, double high) {
  std::uniform_real_distribution<double> x(low, high);
  const double a = x(random), b = x(random), c = x(random);
  return {a, b, c};
}

// Boundary faces in colours 1..6 by side of the box [0, n]^3, edges along z at x = y = 0 in colour 8.
Features sides(const TetMesh& mesh, double n) {
  Features features;
  for (std::size_t t = 0; t < mesh.num_tets(); ++t)
    for (int i = 0; i < 4; ++i) {
      const HalfFaceId h(TetId(static_cast<std::int64_t>(t)), i);
      if (!mesh.is_boundary(h)) continue;
      const Vec3 normal = outward_normal(mesh, h);
      for (int axis = 0; axis < 3; ++axis)
        if (std::abs(normal[axis]) > 0.9) features.faces[mesh.key(h)] = 1 + 2 * axis + (normal[axis] > 0);
    }
  for (std::int64_t v = 0; v < static_cast<std::int64_t>(mesh.num_vertices()); ++v)
    for (std::int64_t w = v + 1; w < static_cast<std::int64_t>(mesh.num_vertices()); ++w) {
      const Vec3 d = mesh.point(VertexId(w)) - mesh.point(VertexId(v));
      if (d == Vec3(0, 0, 1) && mesh.point(VertexId(v)).head<2>().isZero())
        features.edges[{VertexId(v), VertexId(w)}] = 8;
    }
  EXPECT_EQ(features.edges.size(), static_cast<std::size_t>(n));
  return features;
}

}  // namespace

TEST(Surface, ClosestPointOfATriangleBeatsASampleOfIt) {
  std::mt19937 random(3);
  for (int round = 0; round < 200; ++round) {
    const Vec3 a = random_point(random, -1, 1), b = random_point(random, -1, 1), c = random_point(random, -1, 1);
    const Vec3 p = random_point(random, -2, 2);
    const Vec3 q = closest_on_triangle(p, a, b, c);
    const double best = (q - p).norm();
    double sampled = 1e9;
    constexpr int n = 60;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j) sampled = std::min(sampled, (a + (b - a) * i / n + (c - a) * j / n - p).norm());
    EXPECT_LE(best, sampled + 1e-12);
    EXPECT_GE(best, sampled - 3.0 / n * std::sqrt(3.0));
    const Vec3 n_abc = (b - a).cross(c - a).normalized();
    EXPECT_NEAR(n_abc.dot(q - a), 0, 1e-9);
  }
}

TEST(Surface, DegenerateTrianglesAndSegmentsAreHarmless) {
  const Vec3 o(0, 0, 0), x(1, 0, 0), p(0.25, 1, 0);
  EXPECT_EQ(closest_on_triangle(p, o, x, x), Vec3(0.25, 0, 0));
  EXPECT_EQ(closest_on_triangle(p, o, x, Vec3(0.5, 0, 0)), Vec3(0.25, 0, 0));
  EXPECT_EQ(closest_on_triangle(p, x, x, x), x);
  EXPECT_EQ(closest_on_segment(p, x, x), x);
  EXPECT_EQ(closest_on_segment(p, Vec3(2, 0, 0), x), x);
}

TEST(Surface, ProjectsOntoTheSideOfTheColourWithItsNormal) {
  const TetMesh mesh = kuhn_box(4, 4, 4);
  const Features features = sides(mesh, 4);
  const ClosestSurface surface(mesh, features);
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    const Vec3 p = random_point(random, -2, 6);
    for (int axis = 0; axis < 3; ++axis)
      for (int side = 0; side < 2; ++side) {
        const auto found = surface.project(p, 1 + 2 * axis + side);
        Vec3 expected = p.cwiseMax(0).cwiseMin(4);
        expected[axis] = 4 * side;
        EXPECT_NEAR((found.point - expected).norm(), 0, 1e-12);
        EXPECT_NEAR(found.distance, (p - expected).norm(), 1e-12);
        Vec3 normal = Vec3::Zero();
        normal[axis] = side == 1 ? 1 : -1;
        EXPECT_EQ(found.normal, normal);
        EXPECT_EQ(features.faces.at(found.face), 1 + 2 * axis + side);
      }
  }
  EXPECT_TRUE(surface.has(1));
  EXPECT_FALSE(surface.has(7));
  EXPECT_THROW(surface.project(Vec3::Zero(), 7), Error);
  EXPECT_THROW(surface.project(Vec3::Constant(std::nan("")), 1), Error);
}

TEST(Surface, TiesGoToTheLowestFace) {
  const TetMesh mesh = kuhn_box(4, 4, 4);
  const Features features = sides(mesh, 4);
  const ClosestSurface surface(mesh, features);
  // An inner vertex of the side z = 0 belongs to six triangles.
  const VertexId v(2 * 5 + 2);
  FaceKey lowest{};
  for (const auto& [face, colour] : features.faces)
    if (colour == 5 && std::find(face.begin(), face.end(), v) != face.end()) {
      lowest = face;
      break;
    }
  EXPECT_EQ(surface.project(mesh.point(v), 5).face, lowest);
  EXPECT_EQ(surface.project(mesh.point(v) - Vec3(0, 0, 1), 5).face, lowest);
}

TEST(Surface, NormalsOfInnerFacesPointOutOfTheLowerMaterial) {
  const TetMesh mesh = kuhn_box(2, 2, 2);
  Features features;
  for (std::size_t t = 0; t < mesh.num_tets(); ++t) {
    features.tet_colours.push_back(centroid(mesh, TetId(t)).x() < 1 ? 5 : 3);
    for (int i = 0; i < 4; ++i) {
      const FaceKey f = mesh.key(HalfFaceId(TetId(t), i));
      if (std::all_of(f.begin(), f.end(), [&](VertexId v) { return mesh.point(v).x() == 1; })) features.faces[f] = 2;
    }
  }
  EXPECT_EQ(features.faces.size(), 8u);
  const ClosestSurface surface(mesh, features);
  for (double y : {0.2, 0.7, 1.2, 1.9})
    for (double z : {0.3, 0.8, 1.5}) EXPECT_EQ(surface.project({0.1, y, z}, 2).normal, Vec3(-1, 0, 0));
}

TEST(Surface, ProjectsOntoCurves) {
  const TetMesh mesh = kuhn_box(4, 4, 4);
  const ClosestCurve curve(mesh, sides(mesh, 4));
  std::mt19937 random(9);
  for (int round = 0; round < 100; ++round) {
    const Vec3 p = random_point(random, -2, 6);
    const auto found = curve.project(p, 8);
    const Vec3 expected(0, 0, std::clamp(p.z(), 0.0, 4.0));
    EXPECT_NEAR((found.point - expected).norm(), 0, 1e-12);
    EXPECT_NEAR(found.distance, (p - expected).norm(), 1e-12);
    EXPECT_EQ(found.tangent, Vec3(0, 0, 1));
  }
  EXPECT_THROW(curve.project(Vec3::Zero(), 1), Error);
}

TEST(AabbTree, FindsEveryOverlapOnce) {
  std::mt19937 random(11);
  std::vector<AabbTree::Box> boxes;
  for (int i = 0; i < 300; ++i) {
    const Vec3 p = random_point(random, 0, 10);
    boxes.emplace_back(p, p + random_point(random, 0, 1));
  }
  const AabbTree tree(boxes);
  for (int round = 0; round < 50; ++round) {
    const Vec3 p = random_point(random, -1, 10);
    const AabbTree::Box query(p, p + random_point(random, 0, 3));
    std::vector<int> found, expected;
    tree.overlapping(query, [&](std::int32_t i) {
      if (boxes[static_cast<std::size_t>(i)].intersects(query)) found.push_back(i);
    });
    for (int i = 0; i < 300; ++i)
      if (boxes[static_cast<std::size_t>(i)].intersects(query)) expected.push_back(i);
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
  }
  EXPECT_EQ(AabbTree().nearest(Vec3::Zero(), [](int) { return 0.0; }).primitive, -1);
}
