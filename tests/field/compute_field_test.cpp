#include "hexfield/field/compute_field.hpp"

#include <gtest/gtest.h>

#include "box_features.hpp"
#include "hexfield/field/matchings.hpp"
#include "support/meshes.hpp"

using namespace hexfield;

namespace {

int rank() {
  int r = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &r);
  return r;
}

FieldResult field_of(const TetMesh& mesh, const Features& features) {
  return rank() == 0 ? compute_field(MPI_COMM_WORLD, mesh, features, {}, {})
                     : compute_field(MPI_COMM_WORLD, {}, {}, {}, {});
}

}  // namespace

TEST(ComputeField, BoxGetsTheConstantFieldAndTwelveConvexEdges) {
  const TetMesh mesh = hexfield::testing::kuhn_box(3, 2, 4);
  const FieldResult r = field_of(mesh, hexfield::testing::sharp_features(mesh));
  if (rank() != 0) {
    EXPECT_EQ(r.mesh.num_tets(), 0U);
    return;
  }
  EXPECT_TRUE(check(r.mesh).empty());
  EXPECT_TRUE(check(r.mesh, r.field).empty());
  for (const Quaternion& q : r.field.frames) {
    const Quaternion rest = octahedral::quaternion(octahedral::closest(q)).conjugate() * q;
    EXPECT_LT(rest.vec().norm(), 1e-8);
  }
  EXPECT_EQ(r.codes.size(), r.features.edges.size());
  for (const auto& [edge, code] : r.codes) {
    EXPECT_EQ(code, -1);
    EXPECT_EQ(r.features.edges.count(edge), 1U);
  }
}

TEST(ComputeField, LShapedPrismHasOneConcaveEdge) {
  const TetMesh mesh = hexfield::testing::l_prism(2, 2);
  const FieldResult r = field_of(mesh, hexfield::testing::sharp_features(mesh));
  if (rank() != 0) return;
  int convex = 0, concave = 0;
  for (const auto& [edge, code] : r.codes) {
    const Vec3 middle = (r.mesh.point(edge[0]) + r.mesh.point(edge[1])) / 2;
    const bool at_notch = std::abs(middle.x() - 2) < 1e-9 && std::abs(middle.y() - 2) < 1e-9;
    EXPECT_EQ(code, at_notch ? 1 : -1);
    (at_notch ? concave : convex) += 1;
  }
  EXPECT_GE(concave, 2);
  EXPECT_EQ(static_cast<std::size_t>(concave + convex), r.features.edges.size());
}
