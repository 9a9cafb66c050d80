#include "hexfield/repair/vertex_repair.hpp"

#include <gtest/gtest.h>

#include "hexfield/repair/neighbourhood.hpp"
#include "hexfield/repair/ring_patch.hpp"
#include "support/repair_states.hpp"

using namespace hexfield;
using namespace hexfield::testing;

namespace {

const Vec3 middle(2, 2, 2);

// Two arcs of code -1 along x that touch at the middle of a box, one below and one above, in the plane y = 2.
// (Fact 14 speaks of arcs with different axes; those make the valid node of four arcs: see the test below.)
RepairState touching_arcs() {
  RepairState state = box_state(4);
  const Vec3 x(1, 0, 0), z(0, 0, 1), y(0, 1, 0);
  const int below[4] = {1, 1, 2, 2}, above[4] = {2, 2, 3, 3};
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k) {
      const Vec3 p(i, 2, k);
      const bool lower = i == 1 && k == 1, upper = i == 2 && k == 2;
      if (k < below[i] || lower) turn_face(state, {p, p + x, p + x + z}, 1, y);
      if (k < below[i]) turn_face(state, {p, p + z, p + x + z}, 1, y);
      if (k >= above[i] || upper) turn_face(state, {p, p + z, p + x + z}, 1, -y);
      if (k >= above[i]) turn_face(state, {p, p + x, p + x + z}, 1, -y);
    }
  state.codes = compute_codes(state.mesh, state.features, state.field);
  return state;
}

// Straight arcs of code -1 along x and y through the middle.
RepairState crossing_arcs() {
  RepairState state = box_state(4);
  add_straight_arc(state, middle, 0, -1, -1);
  add_straight_arc(state, middle, 1, 1, -1);
  state.codes = compute_codes(state.mesh, state.features, state.field);
  return state;
}

// Arcs +1 and -1 that run along x into the middle and end there, and an arc of code -1 along y (fact 15).
RepairState zipper_on_an_arc() {
  RepairState state = box_state(4);
  const Vec3 p(0, 1, 1), x(1, 0, 0), d(1, 1, 1), up(0, 1, 1), normal(0, 1, -1);
  turn_face(state, {p, p + x, p + d}, 0, normal);
  turn_face(state, {p, p + up, p + d}, 0, normal);
  turn_face(state, {p + x, p + d, p + x + d}, 0, normal);
  add_straight_arc(state, middle, 1, 1, -1);
  state.codes = compute_codes(state.mesh, state.features, state.field);
  return state;
}

// Two arcs along x from x = 0 to x = 4; one of them starts on the edge x = y = 0 of the box.
RepairState arc_on_an_edge() {
  RepairState state = box_state(4);
  const Vec3 x(1, 0, 0), d(1, 1, 1), up(0, 1, 1), normal(0, 1, -1);
  for (int i = 0; i < 4; ++i) {
    const Vec3 p(i, 1, 1);
    turn_face(state, {p, p + x, p + d}, 0, normal);
    turn_face(state, {p, p + up, p + d}, 0, normal);
  }
  turn_face(state, {Vec3(0, 0, 1), Vec3(0, 1, 1), Vec3(1, 1, 1)}, 0, Vec3(0, 0, -1));
  state.codes = compute_codes(state.mesh, state.features, state.field);
  return state;
}

EdgeCounts counts_at(const RepairState& state, VertexId v) {
  return classify_vertex(state.mesh, state.features, state.field, state.codes, v, singular_edges_at(state, v)).counts;
}

NodeKind kind_at(const RepairState& state, VertexId v) {
  return classify_vertex(state.mesh, state.features, state.field, state.codes, v, singular_edges_at(state, v)).kind;
}

}  // namespace

TEST(OneRing, AnIsolatedStarHasNothingSpecialOnItsLink) {
  for (RepairState state : {touching_arcs(), zipper_on_an_arc(), arc_on_an_edge()})
    for (const Vec3& p : {middle, Vec3(1, 1, 1), Vec3(0, 0, 1), Vec3(0, 1, 1)}) {
      const VertexId v = vertex_at(state.mesh, p);
      isolate_star(state, v);
      EXPECT_EQ(isolate_star(state, v), 0);
      for (TetId t : vertex_star(state.mesh, v)) {
        EXPECT_FALSE(is_feature_face(state, HalfFaceId(t, state.mesh.local_index(t, v))));
        for (VertexId a : state.mesh.vertices(t))
          for (VertexId b : state.mesh.vertices(t)) {
            EXPECT_FALSE(a < b && a != v && b != v && is_special(state, {a, b}));
          }
      }
      EXPECT_TRUE(check(state).empty());
      EXPECT_EQ(state.codes, compute_codes(state.mesh, state.features, state.field));
    }
}

TEST(OneRing, SurfaceSectorsOfABoxHoldOneQuadAtCornersAndTwoOnEdges) {
  RepairState state = box_state(3);
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(3, 3, 3), Vec3(3, 0, 0), Vec3(0, 3, 0)}) {
    const OneRing ring(state, vertex_at(state.mesh, p));
    const auto found = surface_sectors(state, ring);
    EXPECT_EQ(found.size(), 3u);
    for (const SurfaceSector& s : found) EXPECT_EQ(s.quads, 1);
  }
  const auto found = surface_sectors(state, OneRing(state, vertex_at(state.mesh, Vec3(0, 0, 1))));
  EXPECT_EQ(found.size(), 2u);
  for (const SurfaceSector& s : found) EXPECT_EQ(s.quads, 2);
}

TEST(OneRing, SurfaceSectorsSeeAnArcThatEndsOnAnEdge) {
  RepairState state = arc_on_an_edge();
  const VertexId v = vertex_at(state.mesh, Vec3(0, 0, 1));
  const OneRing ring(state, v);
  const EdgeCode code = code_of(state, edge_key(v, vertex_at(state.mesh, Vec3(1, 1, 1))));
  ASSERT_EQ(std::abs(code), 1);
  std::vector<int> quads;
  for (const SurfaceSector& s : surface_sectors(state, ring)) quads.push_back(s.quads);
  std::sort(quads.begin(), quads.end());
  EXPECT_EQ(quads, (code > 0 ? std::vector<int>{2, 3} : std::vector<int>{1, 2}));
}

TEST(RingSearch, ParabolicSectorsAreFoundWhereTheyAre) {
  RepairState corner = box_state(3);
  EXPECT_TRUE(parabolic_sectors(corner, OneRing(corner, vertex_at(corner.mesh, Vec3(0, 0, 0)))).empty());
  RepairState zipper = zipper_state();
  int found = 0;
  for (std::size_t i = 0; i < zipper.mesh.num_vertices(); ++i) {
    const VertexId v(static_cast<std::int64_t>(i));
    const auto sectors = parabolic_sectors(zipper, OneRing(zipper, v));
    EXPECT_EQ(sectors.size(), kind_at(zipper, v) == NodeKind::zipper ? 1u : 0u);
    found += static_cast<int>(sectors.size());
  }
  EXPECT_EQ(found, 2);
  RepairState three = zipper_on_an_arc();
  EXPECT_EQ(parabolic_sectors(three, OneRing(three, vertex_at(three.mesh, middle))).size(), 1u);
}

TEST(RingSearch, PathsDoNotDependOnGauges) {
  RepairState plain = touching_arcs();
  RepairState turned = plain;
  shuffle_gauges(turned, 11);
  const VertexId v = vertex_at(plain.mesh, middle);
  const OneRing a(plain, v), b(turned, v);
  ASSERT_EQ(a.spokes().size(), 4u);
  for (const Spoke& s : a.spokes()) {
    RingQuery query;
    query.start = s.end;
    const auto p = find_ring_paths(plain, a, query), q = find_ring_paths(turned, b, query);
    ASSERT_GE(p.size(), 1u);
    ASSERT_EQ(p.size(), q.size());
    for (std::size_t i = 0; i < p.size(); ++i) {
      EXPECT_EQ(p[i].to, q[i].to);
      EXPECT_EQ(p[i].tets, q[i].tets);
      // The streamline goes on in x.
      EXPECT_LT((plain.mesh.point(p[i].to) - middle).x() * (plain.mesh.point(s.end) - middle).x(), 0);
    }
  }
}

TEST(VertexRepair, TwoTouchingArcsAreDetached) {
  RepairState state = touching_arcs();
  const VertexId v = vertex_at(state.mesh, middle);
  EXPECT_EQ(counts_at(state, v).inner_minus, 4);
  EXPECT_FALSE(vertex_meshable(state, v));
  EXPECT_TRUE(needs_repair(state, v));
  ASSERT_TRUE(detach_arc(state, v));
  EXPECT_TRUE(check(state).empty());
  EXPECT_EQ(counts_at(state, v).inner_minus, 2);
  EXPECT_EQ(count_kind(state, NodeKind::zipper) + count_kind(state, NodeKind::invalid), 0);
  EXPECT_EQ(count_kind(state, NodeKind::compound), 0);
  EXPECT_TRUE(vertex_meshable(state, v));
  EXPECT_FALSE(needs_repair(state, v));
}

TEST(VertexRepair, CrossingArcsOfDifferentAxesMakeTheNodeOfFourArcsAndStay) {
  RepairState state = crossing_arcs();
  const VertexId v = vertex_at(state.mesh, middle);
  EXPECT_EQ(counts_at(state, v).inner_minus, 4);
  EXPECT_TRUE(vertex_meshable(state, v));
  EXPECT_TRUE(parabolic_sectors(state, OneRing(state, v)).empty());
  EXPECT_FALSE(repair_vertex(state, v));
}

TEST(VertexRepair, ZippingTheDetachedArcBackMakesThemTouchAgain) {
  RepairState state = touching_arcs();
  const VertexId v = vertex_at(state.mesh, middle);
  isolate_star(state, v);
  const RepairState before = state;
  RingQuery query;
  query.start = OneRing(state, v).spokes().front().end;
  const auto paths = find_ring_paths(state, OneRing(state, v), query);
  ASSERT_GE(paths.size(), 1u);
  const auto fan = ring_patch(state, v, paths[0], Flow::through);
  ASSERT_TRUE(fan.has_value());
  const auto codes = state.codes;
  const auto matchings = state.field.matchings;
  const auto [a, b] = fan->patch.start;
  const auto old = closed_monodromy(state, ring_of(state.mesh, a, b), a, b);
  ASSERT_TRUE(zip_patch(state, fan->patch, octahedral::identity));
  EXPECT_EQ(counts_at(state, v).inner_minus, 2);
  ASSERT_TRUE(zip_patch(state, fan->patch, old));
  EXPECT_EQ(state.field.matchings, matchings);
  EXPECT_EQ(state.codes, codes);
}

TEST(VertexRepair, AZipperNodeIsDetachedFromAnArc) {
  RepairState state = zipper_on_an_arc();
  const VertexId v = vertex_at(state.mesh, middle);
  EXPECT_EQ(counts_at(state, v).inner_minus, 3);
  EXPECT_EQ(counts_at(state, v).inner_plus, 1);
  ASSERT_TRUE(detach_zipper(state, v));
  EXPECT_TRUE(check(state).empty());
  EXPECT_EQ(counts_at(state, v).inner_minus, 2);
  EXPECT_EQ(counts_at(state, v).inner_plus, 0);
  EXPECT_EQ(count_kind(state, NodeKind::zipper), 1);
  EXPECT_EQ(count_kind(state, NodeKind::invalid), 0);
}

TEST(VertexRepair, AnArcLeavesAnEdgeOfTheBoxThroughTheTransversalFace) {
  RepairState state = arc_on_an_edge();
  const VertexId v = vertex_at(state.mesh, Vec3(0, 0, 1));
  ASSERT_EQ(kind_at(state, v), NodeKind::invalid);
  ASSERT_TRUE(detach_to_boundary(state, v, Flow::through));
  EXPECT_TRUE(check(state).empty());
  EXPECT_EQ(kind_at(state, v), NodeKind::arc);
  EXPECT_EQ(count_kind(state, NodeKind::invalid) + count_kind(state, NodeKind::zipper), 0);
  for (const SurfaceSector& s : surface_sectors(state, OneRing(state, v))) EXPECT_EQ(s.quads, 2);
}

TEST(VertexRepair, TheDriverMendsInANeighbourhoodAndLeavesGoodVerticesAlone) {
  for (RepairState state : {touching_arcs(), zipper_on_an_arc(), arc_on_an_edge()}) {
    shuffle_gauges(state, 3);
    std::vector<VertexId> bad;
    for (std::size_t i = 0; i < state.mesh.num_vertices(); ++i)
      if (const VertexId v(static_cast<std::int64_t>(i)); kind_at(state, v) == NodeKind::invalid) bad.push_back(v);
    if (bad.empty()) bad.push_back(vertex_at(state.mesh, middle));
    for (VertexId v : bad) {
      const VertexId seeds[] = {v};
      Neighbourhood place(state, tets_around(state.mesh, seeds, 1));
      ASSERT_TRUE(repair_vertex(place.local, place.to_local(v)));
      place.commit(state);
      EXPECT_TRUE(check(state).empty());
      // A detached through-arc may leave a zipper node, which is left to unzipping.
      EXPECT_TRUE(vertex_meshable(state, v) || kind_at(state, v) == NodeKind::zipper);
    }
    EXPECT_EQ(count_kind(state, NodeKind::invalid), 0);
    const VertexId good = vertex_at(state.mesh, Vec3(1, 3, 3));
    const std::size_t tets = state.mesh.num_tets();
    EXPECT_FALSE(repair_vertex(state, good));
    EXPECT_EQ(state.mesh.num_tets(), tets);
  }
}
