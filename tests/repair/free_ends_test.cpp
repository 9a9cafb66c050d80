#include "hexfield/repair/free_ends.hpp"

#include <gtest/gtest.h>

#include "hexfield/repair/neighbourhood_loop.hpp"
#include "hexfield/repair/state_ops.hpp"
#include "support/repair_states.hpp"

using namespace hexfield;
using namespace hexfield::testing;

namespace {

// A valence-5 arc along x through a box, and a feature curve along y in the face x = 0 through the end of the arc.
RepairState arc_that_ends_on_a_curve(VertexId& end) {
  RepairState state = box_state(4, 4, 4);
  add_straight_arc(state, Vec3(0, 2, 2), 0, -1, 1);
  for (int y = 0; y < 4; ++y)
    state.features.edges[edge_key(vertex_at(state.mesh, Vec3(0, y, 2)), vertex_at(state.mesh, Vec3(0, y + 1, 2)))] = 77;
  for (int y : {0, 4}) state.features.points[vertex_at(state.mesh, Vec3(0, y, 2))] = 78;
  state.codes = compute_codes(state.mesh, state.features, state.field);
  end = vertex_at(state.mesh, Vec3(0, 2, 2));
  return state;
}

}  // namespace

TEST(FreeEnds, AnArcThatEndsOnACurveLeavesItForTheFace) {
  VertexId end{};
  RepairState state = arc_that_ends_on_a_curve(end);
  ASSERT_EQ(ends_on_curves(state), std::vector<VertexId>{end});
  const std::vector<Place> places = {{{end}, 1}};
  const auto commits = for_places(state, places, [](Neighbourhood& copy, std::span<const VertexId> seeds) {
    return free_arc_end(copy.local, seeds[0]);
  });
  EXPECT_EQ(commits, std::vector<char>{1});
  EXPECT_TRUE(ends_on_curves(state).empty());
  EXPECT_TRUE(singular_edges_at(state, end).empty());
  for (const Violation& v : check(state)) ADD_FAILURE() << v.sentence;
  // The arc now ends at one vertex of the face x = 0 off the curve.
  int ends = 0;
  for (const auto& [edge, code] : state.codes)
    for (VertexId v : edge) {
      const Vec3& p = state.mesh.point(v);
      if (code != 1 || p.x() != 0 || state.features.edges.contains(edge)) continue;
      ++ends;
      EXPECT_GT(std::abs(p.z() - 2), 0.1);
    }
  EXPECT_EQ(ends, 1);
}

TEST(FreeEnds, CornersAndRegularVerticesOfCurvesAreNoEnds) {
  const RepairState state = box_state(3);
  EXPECT_TRUE(ends_on_curves(state).empty());
}
