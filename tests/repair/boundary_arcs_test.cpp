#include <gtest/gtest.h>

#include <algorithm>

#include "hexfield/repair/edge_repair.hpp"
#include "hexfield/repair/meshability.hpp"
#include "hexfield/repair/vertex_repair.hpp"
#include "support/cones.hpp"
#include "support/repair_states.hpp"

using namespace hexfield;
using hexfield::testing::box_state;
using hexfield::testing::change_gauges;
using hexfield::testing::vertex_at;

namespace {

// A box whose edge y = z = 0 is no feature and opened from 90 degrees to `degrees`, the frames with it: an arc of code
// -1 along a surface that is smooth when the angle is wide.
RepairState opened_box(double degrees, int length = 4) {
  RepairState state = box_state(length, 4, 4);
  for (auto e = state.features.edges.begin(); e != state.features.edges.end();) {
    const Vec3 middle = (state.mesh.point(e->first[0]) + state.mesh.point(e->first[1])) / 2;
    e = middle.y() == 0 && middle.z() == 0 ? state.features.edges.erase(e) : std::next(e);
  }
  // One surface on both sides of the edge.
  for (auto& [face, colour] : state.features.faces)
    for (int axis : {1, 2})
      if (std::ranges::all_of(face, [&](VertexId v) { return state.mesh.point(v)[axis] == 0; })) colour = 1000;
  const double stretch = degrees / 90;
  for (std::size_t t = 0; t < state.mesh.num_tets(); ++t) {
    const Vec3 c = centroid(state.mesh, TetId(static_cast<std::int64_t>(t)));
    const double turn = (stretch - 1) * std::atan2(c.z(), c.y());
    state.field.frames[t] = Quaternion(Eigen::AngleAxisd(turn, Vec3::UnitX()));
  }
  for (Vec3& p : state.mesh.points) {
    const double angle = stretch * std::atan2(p.z(), p.y()), r = std::hypot(p.y(), p.z());
    p = {p.x(), r * std::cos(angle), r * std::sin(angle)};
  }
  state.codes = compute_codes(state.mesh, state.features, state.field);
  return state;
}

std::vector<VertexId> arc_of(const RepairState& state, int length = 4) {
  std::vector<VertexId> arc;
  for (int x = 0; x <= length; ++x) arc.push_back(vertex_at(state.mesh, Vec3(x, 0, 0)));
  return arc;
}

bool runs_inside(const RepairState& state, VertexId a, VertexId b) {
  return code_of(state, edge_key(a, b)) == -1 && ring_of(state.mesh, a, b).closed;
}

double volume(const TetMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.num_tets(); ++t)
    if (const TetId id(static_cast<std::int64_t>(t)); mesh.alive(id)) sum += signed_volume6(mesh, id) / 6;
  return sum;
}

}  // namespace

TEST(BoundaryArcs, TheWholeArcGoesBelowTheSurface) {
  RepairState state = opened_box(160);
  const auto arc = arc_of(state);
  const double before = volume(state.mesh);
  const std::size_t singular = state.codes.size(), faces = state.features.faces.size();
  for (std::size_t i = 0; i + 1 < arc.size(); ++i) {
    ASSERT_EQ(code_of(state, edge_key(arc[i], arc[i + 1])), -1);
    ASSERT_FALSE(ring_of(state.mesh, arc[i], arc[i + 1]).closed);
  }
  EXPECT_EQ(push_arcs_inside(state), 3);
  EXPECT_TRUE(check(state).empty());
  EXPECT_NEAR(volume(state.mesh), before, 1e-9);
  EXPECT_EQ(state.features.faces.size(), faces);
  EXPECT_EQ(state.codes.size(), singular);  // it is the same arc, and the covers are regular
  EXPECT_EQ(compute_codes(state.mesh, state.features, state.field), state.codes);
  for (std::size_t i = 0; i + 1 < arc.size(); ++i) EXPECT_TRUE(runs_inside(state, arc[i], arc[i + 1]));
  for (std::size_t i = 1; i + 1 < arc.size(); ++i) {
    EXPECT_FALSE(on_boundary(state.mesh, arc[i]));
    EXPECT_TRUE(vertex_meshable(state, arc[i]));
  }
  EXPECT_EQ(push_arcs_inside(state), 0);
  const TetMesh rebuilt = build_tet_mesh(state.mesh.points, state.mesh.tets);
  EXPECT_EQ(rebuilt.opposite, state.mesh.opposite);
}

TEST(BoundaryArcs, ThenItEndsOnTheFlatFacesBesideTheFeatureCurves) {
  RepairState state = opened_box(160);
  const auto arc = arc_of(state);
  push_arcs_inside(state);
  for (VertexId end : {arc.front(), arc.back()}) {
    EXPECT_TRUE(needs_repair(state, end));
    ASSERT_TRUE(detach_to_boundary(state, end, Flow::through));
    EXPECT_FALSE(needs_repair(state, end));
  }
  EXPECT_TRUE(check(state).empty());
}

TEST(BoundaryArcs, AtASharpEdgeTheyStay) {
  RepairState state = opened_box(90);
  EXPECT_EQ(push_arcs_inside(state), 0);
  EXPECT_EQ(code_of(state, edge_key(arc_of(state)[1], arc_of(state)[2])), -1);
}

TEST(BoundaryArcs, AVertexHalfWayTouchesTheSurfaceNoLonger) {
  RepairState state = opened_box(160);
  const auto arc = arc_of(state);
  ASSERT_TRUE(push_inside(state, arc[1]));  // the arc touches the surface at its neighbour
  ASSERT_TRUE(push_inside(state, arc[3]));
  EXPECT_TRUE(needs_repair(state, arc[2]));
  EXPECT_EQ(push_arcs_inside(state), 1);
  EXPECT_FALSE(needs_repair(state, arc[2]));
}

TEST(BoundaryArcs, AnArcThatCrossesTheSurfaceGoesOnToTheCover) {
  RepairState state = box_state(4);
  hexfield::testing::add_straight_arc(state, {0, 2, 2}, 0, -1, 1);
  state.codes = compute_codes(state.mesh, state.features, state.field);
  const VertexId v = vertex_at(state.mesh, {0, 2, 2});
  ASSERT_EQ(singular_edges_at(state, v).size(), 1U);
  ASSERT_FALSE(needs_repair(state, v));
  ASSERT_TRUE(push_inside(state, v));
  EXPECT_TRUE(check(state).empty());
  ASSERT_EQ(singular_edges_at(state, v).size(), 2U);
  const VertexId cover = vertex_at(state.mesh, {0, 2, 2});
  EXPECT_EQ(code_of(state, edge_key(v, cover)), 1);
  EXPECT_FALSE(needs_repair(state, v));
  EXPECT_FALSE(needs_repair(state, cover));
}

TEST(BoundaryArcs, FeaturesHoldAVertex) {
  RepairState state = box_state(4);
  EXPECT_FALSE(push_inside(state, vertex_at(state.mesh, {2, 0, 0})));
  EXPECT_FALSE(push_inside(state, vertex_at(state.mesh, {2, 2, 2})));
  EXPECT_TRUE(push_inside(state, vertex_at(state.mesh, {2, 2, 0})));
  EXPECT_TRUE(check(state).empty());
}

TEST(BoundaryArcs, GaugesChangeNothing) {
  RepairState plain = opened_box(160);
  RepairState gauged = plain;
  change_gauges(gauged, 5);
  EXPECT_EQ(push_arcs_inside(plain), push_arcs_inside(gauged));
  EXPECT_EQ(plain.mesh.tets, gauged.mesh.tets);
  EXPECT_EQ(plain.codes, gauged.codes);
}
