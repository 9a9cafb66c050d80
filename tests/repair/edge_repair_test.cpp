#include "hexfield/repair/edge_repair.hpp"

#include <gtest/gtest.h>

#include "hexfield/field/edge_codes.hpp"
#include "hexfield/repair/meshability.hpp"
#include "support/cones.hpp"
#include "support/repair_states.hpp"

using namespace hexfield;
using hexfield::testing::box_state;
using hexfield::testing::change_gauges;
using hexfield::testing::turn_face;
using hexfield::testing::vertex_at;
using hexfield::testing::zipper_state;

namespace {

const Vec3 p(1, 1, 1), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), d(1, 1, 1);

EdgeKey diagonal(const RepairState& state) { return edge_key(vertex_at(state.mesh, p), vertex_at(state.mesh, p + d)); }

// A box with turns about u and w in two triangles at one space diagonal.
RepairState turned_state(int about_u, int about_w) {
  RepairState state = box_state(4);
  for (int i = 0; i < about_u; ++i) turn_face(state, {p, p + x, p + d}, 0, Vec3(0, 1, -1));
  for (int i = 0; i < about_w; ++i) turn_face(state, {p, p + z, p + d}, 4, Vec3(1, -1, 0));
  state.codes = compute_codes(state.mesh, state.features, state.field);
  return state;
}

int high_codes(const RepairState& state) {
  int high = 0;
  for (const auto& [edge, code] : state.codes) high += code != undetermined_code && std::abs(code) > 1;
  return high;
}

// Zipping keeps the sign of arcs nearby, which geometry may see otherwise after smoothing; undetermined edges may have
// got a code by it.
void expect_sound(const RepairState& state) {
  EXPECT_TRUE(check(state).empty());
  const EdgeCodes fresh = compute_codes(state.mesh, state.features, state.field);
  ASSERT_EQ(state.codes.size(), fresh.size());
  for (const auto& [edge, code] : state.codes) {
    ASSERT_TRUE(fresh.contains(edge));
    if (code != undetermined_code) {
      EXPECT_EQ(std::abs(code), std::abs(fresh.at(edge)));
    }
  }
}

}  // namespace

// The arcs beside the compound edge close to loops of two edges, which vanish with it.
TEST(EdgeRepair, AContractedCompoundEdgeTakesItsLoopsAlong) {
  RepairState state = turned_state(1, 1);
  ASSERT_EQ(code_of(state, diagonal(state)), compound_code);
  ASSERT_TRUE(contract_compound_edge(state, diagonal(state)));
  for (const Violation& v : check(state)) ADD_FAILURE() << v.sentence;
  EXPECT_EQ(state.codes, compute_codes(state.mesh, state.features, state.field));
  for (const auto& entry : state.codes) EXPECT_TRUE(state.features.edges.contains(entry.first));
  EXPECT_FALSE(contract_compound_edge(state, state.codes.begin()->first));
}

TEST(EdgeRepair, AThirdTurnBecomesTwoArcsOfQuarterTurns) {
  RepairState state = turned_state(1, 1);
  ASSERT_EQ(code_of(state, diagonal(state)), compound_code);
  ASSERT_TRUE(repair_compound_edge(state, diagonal(state)));
  EXPECT_EQ(std::abs(code_of(state, diagonal(state))), 1);
  EXPECT_TRUE(edge_meshable(state, diagonal(state)));
  EXPECT_EQ(high_codes(state), 0);
  expect_sound(state);
  EXPECT_FALSE(repair_compound_edge(state, diagonal(state)));
}

TEST(EdgeRepair, AnEdgeDiagonalHalfTurnTakesTwoSteps) {
  RepairState state = turned_state(2, 1);
  ASSERT_EQ(code_of(state, diagonal(state)), compound_code);
  ASSERT_TRUE(repair_compound_edge(state, diagonal(state)));
  EXPECT_EQ(std::abs(code_of(state, diagonal(state))), 2);
  ASSERT_TRUE(lower_index(state, diagonal(state)));
  EXPECT_EQ(std::abs(code_of(state, diagonal(state))), 1);
  for (const auto& [edge, code] : state.codes) EXPECT_NE(code, compound_code);
  expect_sound(state);
}

TEST(EdgeRepair, AllCompoundAndHighEdgesOfTheStateGo) {
  for (int u = 0; u < 4; ++u)
    for (int w = 0; w < 4; ++w) {
      RepairState state = turned_state(u, w);
      const int before = high_codes(state);
      const EdgeRepairCounts counts = repair_edges(state);
      EXPECT_EQ(high_codes(state), 0) << u << " " << w;
      EXPECT_EQ(counts.total() > 0, before > 0 || counts.triangles > 0);
      expect_sound(state);
    }
}

TEST(EdgeRepair, GaugesChangeNothing) {
  RepairState plain = turned_state(1, 1);
  RepairState gauged = plain;
  change_gauges(gauged, 3);
  ASSERT_TRUE(repair_compound_edge(plain, diagonal(plain)));
  ASSERT_TRUE(repair_compound_edge(gauged, diagonal(gauged)));
  EXPECT_EQ(plain.mesh.tets, gauged.mesh.tets);
  EXPECT_EQ(plain.codes, gauged.codes);
}

TEST(EdgeRepair, AnEmptySectorIsOpened) {
  RepairState state;
  state.mesh = build_tet_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0.1}, {0, 1, -0.1}},
                              {{VertexId(0), VertexId(2), VertexId(1), VertexId(3)}});
  complete_features(state.mesh, state.features);
  state.field.frames.assign(1, Quaternion::Identity());
  state.field.matchings.assign(1, {});
  state.target_length.assign(4, 1.0);
  state.codes = compute_codes(state.mesh, state.features, state.field);
  const EdgeKey sharp = edge_key(VertexId(0), VertexId(1));
  ASSERT_EQ(code_of(state, sharp), -2);
  ASSERT_TRUE(repair_sectors(state, sharp));
  EXPECT_EQ(code_of(state, sharp), -1);
  EXPECT_TRUE(edge_meshable(state, sharp));
  EXPECT_TRUE(check(state).empty());
  EXPECT_FALSE(repair_sectors(state, sharp));
}

TEST(EdgeRepair, ASingularTriangleIsRemovedByItsMatching) {
  const RepairState before = box_state(4);
  RepairState state = before;
  turn_face(state, {p, p + x, p + d}, 2, Vec3(0, 1, -1));
  const FaceKey face = face_key(vertex_at(state.mesh, p), vertex_at(state.mesh, p + x), vertex_at(state.mesh, p + d));
  state.codes = compute_codes(state.mesh, state.features, state.field);
  ASSERT_EQ(state.codes.size(), before.codes.size() + 3);
  ASSERT_TRUE(remove_singular_triangle(state, face));
  EXPECT_EQ(state.codes, before.codes);
  EXPECT_EQ(state.field.matchings, before.field.matchings);
  EXPECT_FALSE(remove_singular_triangle(state, face));
}

TEST(EdgeRepair, SplitsIsolateAOneRing) {
  RepairState state = zipper_state();
  const VertexId v = vertex_at(state.mesh, {3, 1, 1});
  ASSERT_EQ(singular_edges_at(state, v).size(), 2u);
  EXPECT_GT(split_one_ring(state, v), 0);
  expect_sound(state);
  for (const EdgeKey& e : edges_of(state.mesh, vertex_star(state.mesh, v))) {
    if (e[0] != v && e[1] != v) {
      EXPECT_FALSE(is_special(state, e));
      continue;
    }
    const VertexId w = e[0] == v ? e[1] : e[0];
    if (is_special(state, e)) continue;
    for (const EdgeKey& other : edges_at(state.mesh, w)) EXPECT_FALSE(is_special(state, other));
  }
  EXPECT_EQ(split_one_ring(state, v), 0);
}
