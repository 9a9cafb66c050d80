#include "hexfield/mesh/tet_mesh.hpp"

#include <gtest/gtest.h>

#include "support/meshes.hpp"

using namespace hexfield;
using hexfield::testing::kuhn_box;

TEST(TetMesh, KuhnBoxIsValidAndFillsTheBox) {
  const TetMesh mesh = kuhn_box(2, 3, 4);
  EXPECT_TRUE(check(mesh).empty());
  double volume6 = 0;
  for (std::size_t t = 0; t < mesh.num_tets(); ++t) volume6 += signed_volume6(mesh, TetId(t));
  EXPECT_NEAR(volume6 / 6, 24, 1e-12);
}

TEST(TetMesh, RingsCloseInsideAndAreCounterClockwise) {
  const TetMesh mesh = kuhn_box(2, 2, 2);
  for (std::size_t i = 0; i < mesh.num_tets(); ++i)
    for (const auto& e : tet_edge_vertices) {
      const TetId t(i);
      const VertexId a = mesh.vertices(t)[static_cast<std::size_t>(e[0])];
      const VertexId b = mesh.vertices(t)[static_cast<std::size_t>(e[1])];
      const EdgeRing ring = edge_ring(mesh, t, a, b);
      double angle = 0;
      for (TetId r : ring.tets) angle += dihedral_angle(mesh, r, a, b);
      if (ring.closed) {
        EXPECT_NEAR(angle, 2 * M_PI, 1e-12);
      }
      EXPECT_EQ(ring.closed, !ring.first_boundary.valid());
      for (std::size_t k = 0; k + 1 < ring.tets.size(); ++k)
        EXPECT_EQ(mesh.opposite_half_face(ring.crossings[k]).tet(), ring.tets[k + 1]);
      const Vec3 axis = mesh.point(b) - mesh.point(a);
      if (ring.tets.size() > 1) {
        const Vec3 from = centroid(mesh, ring.tets[0]) - mesh.point(a);
        const Vec3 to = centroid(mesh, ring.tets[1]) - mesh.point(a);
        EXPECT_GT(from.cross(to).dot(axis), 0);
      }
    }
}

TEST(TetMesh, StarsFindEdgesAndFaces) {
  const TetMesh mesh = kuhn_box(2, 2, 2);
  EXPECT_EQ(vertex_star(mesh, VertexId(13)).size(), 24u);  // the centre of 8 cells
  const HalfFaceId h(TetId(5), 2);
  EXPECT_EQ(mesh.key(find_half_face(mesh, mesh.key(h))), mesh.key(h));
  for (std::size_t i = mesh.num_tets(); i-- > 0;)
    for (const auto& e : tet_edge_vertices) {
      const TetId t(i);
      const VertexId a = mesh.vertices(t)[static_cast<std::size_t>(e[0])];
      const VertexId b = mesh.vertices(t)[static_cast<std::size_t>(e[1])];
      std::size_t smallest = 0;
      while (!mesh.has_vertex(TetId(smallest), a) || !mesh.has_vertex(TetId(smallest), b)) ++smallest;
      EXPECT_EQ(find_tet_with_edge(mesh, a, b), TetId(smallest));
      EXPECT_EQ(find_tet_with_edge(mesh, b, a), TetId(smallest));
    }
  EXPECT_TRUE(find_tet_with_edge(mesh, VertexId(0), VertexId(26)) == TetId());
}

TEST(TetMesh, ThreeTetsAtAFaceAreRefusedByName) {
  std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {0, 0, 2}};
  using V = VertexId;
  std::vector<std::array<V, 4>> tets = {{V(0), V(1), V(2), V(3)}, {V(0), V(2), V(1), V(4)}, {V(0), V(1), V(2), V(5)}};
  try {
    build_tet_mesh(points, tets);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    EXPECT_EQ(error.ids(), (std::vector<std::int64_t>{0, 1, 2}));
    EXPECT_EQ(error.places().size(), 1u);
  }
}
