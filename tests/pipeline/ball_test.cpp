#include <gtest/gtest.h>

#include <atomic>
#include <limits>

#include "hexfield/base/error.hpp"
#include "hexfield/base/parallel.hpp"
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

FieldResult field_of_ball() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  TetInput input;
  if (rank == 0) {
    input = read_tet_mesh(std::string(HEXFIELD_TEST_DATA) + "/ball.msh");
    complete_features(input.mesh, input.features);
    EXPECT_TRUE(input.features.edges.empty());
  }
  return compute_field(MPI_COMM_WORLD, input.mesh, input.features, {}, {});
}

}  // namespace

// spec-lmff section 12, fact 18: by Poincare and Hopf the trace of the field on the sphere has index 2.
TEST(Ball, TheArcsOfASmoothFieldMeetTheSurfaceWithIndexTwo) {
  const FieldResult f = field_of_ball();
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank != 0) return;
  EXPECT_EQ(index_of_surface(f), 8);
  const RepairResult repaired = repair_field(start_repair(f), f, {}, {});
  EXPECT_EQ(index_of_surface(repaired.field), 8);
  EXPECT_EQ(repaired.report.after.edges, 0U);
  EXPECT_EQ(repaired.report.after.vertices, 0U);
}

// A stop must not wait for the end of an operation on the whole mesh, nor a repair without success for ever.
TEST(Ball, TheRepairHearsAStopAndEndsWhenItsWorkIsSpent) {
  const FieldResult f = field_of_ball();
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank != 0) return;
  std::atomic<int> asked = 0;
  int limit = std::numeric_limits<int>::max();
  RepairControl control;
  control.stop_requested = [&] { return ++asked > limit; };
  const RepairResult whole = repair_field(start_repair(f, control), f, {}, control);
  const int all = asked;
  EXPECT_GT(all, 100);
  for (limit = 1; limit < all; limit += all / 5) {
    asked = 0;
    EXPECT_THROW(repair_field(start_repair(f, control), f, {}, control), Error) << limit;
    EXPECT_LT(asked, limit + 1 + threads());
  }
  RepairOptions little;
  little.work_per_tet = 1;
  const RepairResult spent = repair_field(start_repair(f), f, little, {});
  EXPECT_LT(spent.report.work, whole.report.work);
  EXPECT_EQ(spent.report.iterations, 1);
  EXPECT_TRUE(check(spent.field.mesh).empty());
}
