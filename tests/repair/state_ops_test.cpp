#include "hexfield/repair/state_ops.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "hexfield/field/edge_codes.hpp"
#include "hexfield/field/matchings.hpp"
#include "support/repair_states.hpp"

using namespace hexfield;
using hexfield::testing::box_state;
using hexfield::testing::vertex_at;
using hexfield::testing::zipper_state;

TEST(StateOps, AValidStateHasNoViolations) {
  EXPECT_TRUE(check(box_state(3)).empty());
  EXPECT_TRUE(check(zipper_state()).empty());
}

TEST(StateOps, ADiscOfQuarterTurnsBoundsTwoArcsOfOppositeCode) {
  const RepairState state = zipper_state();
  int plus = 0, minus = 0;
  for (const auto& [edge, code] : state.codes) {
    if (state.features.edges.contains(edge)) continue;
    plus += code == 1, minus += code == -1;
    EXPECT_TRUE(code == 1 || code == -1) << code;
  }
  EXPECT_EQ(plus, 4);
  EXPECT_EQ(minus, 4);
}

TEST(StateOps, SplitsCarryCodesPairsKeptEdgesAndLengths) {
  RepairState state = zipper_state();
  ASSERT_FALSE(state.codes.empty());
  const EdgeKey edge = edge_key(vertex_at(state.mesh, {1, 1, 1}), vertex_at(state.mesh, {2, 1, 1}));
  ASSERT_TRUE(state.codes.contains(edge));
  const EdgeCode code = state.codes.at(edge);
  state.pairs[edge] = 7;
  state.kept.insert(edge);
  state.target_length[edge[0].index()] = 3.0;
  const VertexId v = split_edge(state, edge[0], edge[1]);
  EXPECT_DOUBLE_EQ(state.target_length[v.index()], 2.0);
  EXPECT_FALSE(state.codes.contains(edge));
  for (VertexId end : edge) {
    EXPECT_EQ(state.codes.at(edge_key(end, v)), code);
    EXPECT_EQ(state.pairs.at(edge_key(end, v)), 7);
    EXPECT_TRUE(state.kept.contains(edge_key(end, v)));
  }
  EXPECT_TRUE(check(state).empty());
  EXPECT_EQ(state.codes, compute_codes(state.mesh, state.features, state.field));
}

TEST(StateOps, UpdatedCodesAreThoseOfTheWholeMesh) {
  RepairState state = box_state(4);
  const EdgeCodes before = state.codes;
  const FaceKey key =
      face_key(vertex_at(state.mesh, {1, 1, 1}), vertex_at(state.mesh, {2, 1, 1}), vertex_at(state.mesh, {2, 2, 2}));
  const HalfFaceId inner = find_half_face(state.mesh, key);
  set_matching(state, inner, octahedral::quarter_turn(4));
  EXPECT_TRUE(check(state.mesh, state.field).empty());
  const FaceKey face = state.mesh.key(inner);
  const EdgeKey edges[] = {edge_key(face[0], face[1]), edge_key(face[1], face[2]), edge_key(face[0], face[2])};
  update_codes(state, edges);
  EXPECT_NE(state.codes, before);
  EXPECT_EQ(state.codes, compute_codes(state.mesh, state.features, state.field));
  set_matching(state, inner, octahedral::identity);
  update_codes(state, edges);
  EXPECT_EQ(state.codes, before);
}

TEST(StateOps, SmoothingAlignsTheNamedTetsOnly) {
  RepairState state = zipper_state();
  const auto before = state.field.frames;
  const VertexId seed = vertex_at(state.mesh, {2, 1, 1});
  const auto tets = vertex_star(state.mesh, seed);
  smooth(state, tets, 20);
  for (std::size_t t = 0; t < before.size(); ++t) {
    const bool inside = std::find(tets.begin(), tets.end(), TetId(static_cast<std::int64_t>(t))) != tets.end();
    if (inside) continue;
    EXPECT_EQ(state.field.frames[t].coeffs(), before[t].coeffs());
  }
  EXPECT_TRUE(check(state.mesh, state.field).empty());
}

TEST(StateOps, SmoothingIsIndependentOfTheOrderOfTheTets) {
  RepairState a = zipper_state();
  RepairState b = a;
  auto tets = vertex_star(a.mesh, vertex_at(a.mesh, {2, 1, 1}));
  smooth(a, tets, 5);
  std::reverse(tets.begin(), tets.end());
  smooth(b, tets, 5);
  for (std::size_t t = 0; t < a.field.frames.size(); ++t)
    EXPECT_EQ(a.field.frames[t].coeffs(), b.field.frames[t].coeffs());
}
