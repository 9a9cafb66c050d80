#include <gtest/gtest.h>

#include "hexfield/field/compute_field.hpp"
#include "hexfield/io/tet_io.hpp"
#include "hexfield/repair/repair_field.hpp"

using namespace hexfield;

namespace {

std::vector<char> boundary_vertices(const TetMesh& mesh) {
  std::vector<char> on(mesh.num_vertices(), 0);
  for (std::size_t i = 0; i < mesh.num_tets(); ++i)
    for (int f = 0; f < 4; ++f)
      if (const HalfFaceId h(TetId(static_cast<std::int64_t>(i)), f); mesh.is_boundary(h))
        for (VertexId v : mesh.face_vertices(h)) on[v.index()] = 1;
  return on;
}

// Sum of the indices of the points where singular arcs meet the surface, in quarters of a turn.
int index_of_surface(const FieldResult& f) {
  const auto on = boundary_vertices(f.mesh);
  int sum = 0;
  for (const auto& [edge, code] : f.codes) {
    EXPECT_TRUE(on[edge[0].index()] == 0 || on[edge[1].index()] == 0) << "an arc runs on the surface";
    if (on[edge[0].index()] == on[edge[1].index()]) continue;
    EXPECT_LT(std::abs(code), 3);
    sum -= code;
  }
  return sum;
}

}  // namespace

// spec-lmff section 12, fact 18: by Poincare and Hopf the trace of the field on the sphere has index 2.
TEST(Ball, TheArcsOfASmoothFieldMeetTheSurfaceWithIndexTwo) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  TetInput input;
  if (rank == 0) {
    input = read_tet_mesh(std::string(HEXFIELD_TEST_DATA) + "/ball.msh");
    complete_features(input.mesh, input.features);
    EXPECT_TRUE(input.features.edges.empty());
  }
  const FieldResult f = compute_field(MPI_COMM_WORLD, input.mesh, input.features, {}, {});
  if (rank != 0) return;
  EXPECT_EQ(index_of_surface(f), 8);
  const RepairResult repaired = repair_field(start_repair(f), f, {}, {});
  EXPECT_EQ(index_of_surface(repaired.field), 8);
  EXPECT_EQ(repaired.report.after.edges, 0U);
  EXPECT_EQ(repaired.report.after.vertices, 0U);
}
