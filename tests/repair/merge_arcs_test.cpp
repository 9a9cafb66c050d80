#include "hexfield/repair/merge_arcs.hpp"

#include <gtest/gtest.h>

#include "hexfield/field/singularity_graph.hpp"
#include "hexfield/repair/vertex_repair.hpp"
#include "support/repair_states.hpp"

using namespace hexfield;
using namespace hexfield::testing;

namespace {

// Two arcs of code -1, along x at z = 2 and along y at z = 2 + gap.
RepairState crossing_arcs(int gap) {
  RepairState state = box_state(6, 6, 8);
  add_straight_arc(state, Vec3(0, 3, 3), 0, -1, -1);
  add_straight_arc(state, Vec3(3, 0, 3 + gap), 1, 1, -1);
  state.codes = compute_codes(state.mesh, state.features, state.field);
  return state;
}

}  // namespace

TEST(MergeArcs, TwoArcsBecomeOneNode) {
  for (int gap : {1, 2}) {
    RepairState state = crossing_arcs(gap);
    const VertexId p = vertex_at(state.mesh, Vec3(3, 3, 3)), q = vertex_at(state.mesh, Vec3(3, 3, 3 + gap));
    ASSERT_TRUE(merge_arcs(state, p, q)) << gap;
    for (const Violation& v : check(state)) ADD_FAILURE() << v.sentence;
    const auto edges = singular_edges_at(state, q);
    ASSERT_EQ(edges.size(), 4u);
    for (const EdgeKey& e : edges) EXPECT_EQ(code_of(state, e), -1);
    EXPECT_FALSE(needs_repair(state, q));
    EXPECT_EQ(compute_codes(state.mesh, state.features, state.field), state.codes);
  }
}

TEST(MergeArcs, FarArcsStayAsTheyAre) {
  RepairState state = crossing_arcs(4);
  const RepairState before = state;
  EXPECT_FALSE(merge_arcs(state, vertex_at(state.mesh, Vec3(3, 3, 3)), vertex_at(state.mesh, Vec3(3, 3, 7))));
  EXPECT_EQ(state.codes, before.codes);
  EXPECT_EQ(state.mesh.tets, before.mesh.tets);
}

TEST(MergeArcs, StraightArcsThatPassEachOtherStayTwo) {
  RepairState state = crossing_arcs(1);
  EXPECT_EQ(merge_crossing_arcs(state), 0);
}
