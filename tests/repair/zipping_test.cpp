#include "hexfield/repair/zipping.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <set>

#include "hexfield/field/edge_codes.hpp"
#include "support/repair_states.hpp"

using namespace hexfield;
using namespace hexfield::testing;
using octahedral::Rotation;

namespace {

const Vec3 x(1, 0, 0);

// Fact 11: a disc of eight triangles inside a constant field.
ZipPatch disc(const TetMesh& mesh) {
  const Vec3 corner(1, 1, 1);
  return patch_of(mesh, slanted_triangles(corner, 2, 2), {corner, corner + x});
}

ZipOptions unsmoothed() {
  ZipOptions options;
  options.sweeps = 0;
  return options;
}

void expect_same_field(const RepairState& a, const RepairState& b) {
  EXPECT_EQ(a.field.matchings, b.field.matchings);
  EXPECT_EQ(a.codes, b.codes);
  ASSERT_EQ(a.field.frames.size(), b.field.frames.size());
  EXPECT_EQ(0, std::memcmp(a.field.frames.data(), b.field.frames.data(), sizeof(Quaternion) * a.field.frames.size()));
}

// Faces of the link of v around one of them, grown while they are a disc.
std::vector<FaceKey> random_disc(const TetMesh& mesh, VertexId v, std::size_t size, std::mt19937& random) {
  std::vector<FaceKey> link;
  for (TetId t : vertex_star(mesh, v)) link.push_back(mesh.key(HalfFaceId(t, mesh.local_index(t, v))));
  auto edges = [](const FaceKey& f) {
    return std::array<EdgeKey, 3>{edge_key(f[0], f[1]), edge_key(f[0], f[2]), edge_key(f[1], f[2])};
  };
  std::vector<FaceKey> faces{link[random() % link.size()]};
  std::set<FaceKey> used(faces.begin(), faces.end());
  for (int tries = 0; tries < 500 && faces.size() < size; ++tries) {
    const FaceKey f = link[random() % link.size()];
    if (used.contains(f)) continue;
    std::set<EdgeKey> have;
    std::set<VertexId> vertices;
    for (const FaceKey& g : faces) {
      vertices.insert(g.begin(), g.end());
      for (const EdgeKey& e : edges(g)) have.insert(e);
    }
    std::size_t shared = 0, met = 0;
    for (const EdgeKey& e : edges(f)) shared += have.contains(e);
    for (VertexId w : f) met += vertices.contains(w);
    // One edge and its two ends, or two edges and all three vertices: the union stays a disc.
    if (shared == 0 || shared == 3 || met != shared + 1) continue;
    faces.push_back(f);
    used.insert(f);
  }
  return faces;
}

ZipPatch bounded(const std::vector<FaceKey>& faces) {
  ZipPatch patch;
  patch.faces = faces;
  std::map<EdgeKey, int> uses;
  for (const FaceKey& f : faces)
    for (const EdgeKey& e : {edge_key(f[0], f[1]), edge_key(f[0], f[2]), edge_key(f[1], f[2])}) ++uses[e];
  for (const auto& [e, n] : uses)
    if (n == 1) patch.boundary.push_back(e);
  patch.start = patch.boundary.front();
  return patch;
}

}  // namespace

TEST(Zipping, ADiscTurnsARegularStreamlineIntoTwoArcsThatMeetAtTwoZippers) {
  RepairState state = box_state(6, 4, 4);
  ASSERT_TRUE(zip_patch(state, disc(state.mesh), octahedral::quarter_turn(0)));
  EXPECT_EQ(count_code(state, 1), 4);
  EXPECT_EQ(count_code(state, -1), 4);
  EXPECT_EQ(count_kind(state, NodeKind::zipper), 2);
  EXPECT_EQ(count_kind(state, NodeKind::invalid) + count_kind(state, NodeKind::node), 0);
  EXPECT_TRUE(check(state).empty());
  EXPECT_EQ(state.codes, compute_codes(state.mesh, state.features, state.field));
}

TEST(Zipping, TheInverseRestoresEverything) {
  RepairState state = box_state(6, 4, 4);
  shuffle_gauges(state, 1);
  const RepairState before = state;
  const ZipPatch patch = disc(state.mesh);
  const EdgeRing ring = ring_of(state.mesh, patch.start[0], patch.start[1]);
  const auto axis = closest_label(state.field.frames[ring.tets[0].index()], x);
  ASSERT_TRUE(zip_patch(state, patch, octahedral::quarter_turn(axis), unsmoothed()));
  ASSERT_NE(state.field.matchings, before.field.matchings);
  ASSERT_TRUE(zip_patch(state, patch, octahedral::identity, unsmoothed()));
  expect_same_field(state, before);
}

TEST(Zipping, SmoothedFramesComeBackToTheConstantField) {
  RepairState state = box_state(6, 4, 4);
  const RepairState before = state;
  const ZipPatch patch = disc(state.mesh);
  ASSERT_TRUE(zip_patch(state, patch, octahedral::quarter_turn(0)));
  double moved = 0;
  for (const Quaternion& q : state.field.frames) moved = std::max(moved, q.angularDistance(Quaternion::Identity()));
  EXPECT_GT(moved, 0.1);
  ASSERT_TRUE(zip_patch(state, patch, octahedral::identity, {.sweeps = 400}));
  EXPECT_EQ(state.field.matchings, before.field.matchings);
  EXPECT_EQ(state.codes, before.codes);
  for (const Quaternion& q : state.field.frames) EXPECT_LT(q.angularDistance(Quaternion::Identity()), 1e-6);
}

TEST(Zipping, OneZipperRemainsWhereThePatchReachesATransversalBoundary) {
  RepairState state = box_state(6, 4, 4);
  const Vec3 p(0, 1, 1), d(1, 1, 1), up(0, 1, 1);
  const auto patch =
      patch_of(state.mesh, {{p, p + x, p + d}, {p, p + up, p + d}, {p + x, p + d, p + x + d}}, {p, p + x});
  ASSERT_TRUE(zip_patch(state, patch, octahedral::quarter_turn(0)));
  EXPECT_EQ(count_kind(state, NodeKind::zipper), 1);
  EXPECT_EQ(count_kind(state, NodeKind::invalid), 0);
  EXPECT_EQ(count_code(state, 1) + count_code(state, -1), 4);
}

TEST(Zipping, NoZipperRemainsWhereBothEndsLieOnTransversalBoundaries) {
  RepairState state = box_state(4, 3, 3);
  const Vec3 d(1, 1, 1), up(0, 1, 1);
  std::vector<std::array<Vec3, 3>> triangles;
  for (int i = 0; i < 4; ++i) {
    const Vec3 p(i, 1, 1);
    triangles.push_back({p, p + x, p + d});
    triangles.push_back({p, p + up, p + d});
  }
  const auto patch = patch_of(state.mesh, triangles, {Vec3(0, 1, 1), Vec3(1, 1, 1)});
  ASSERT_TRUE(zip_patch(state, patch, octahedral::quarter_turn(0)));
  EXPECT_EQ(count_kind(state, NodeKind::zipper), 0);
  EXPECT_EQ(count_kind(state, NodeKind::invalid), 0);
  EXPECT_EQ(count_code(state, 1), 4);
  EXPECT_EQ(count_code(state, -1), 4);
}

TEST(Zipping, InnerEdgesOfRandomPatchesStayRegularInRandomGauges) {
  RepairState state = box_state(4);
  shuffle_gauges(state, 7);
  const RepairState before = state;
  std::mt19937 random(3);
  int with_inner_edges = 0;
  for (int round = 0; round < 60; ++round) {
    const VertexId v = vertex_at(state.mesh, Vec3(1 + static_cast<int>(random() % 3), 2, 2));
    const ZipPatch patch = bounded(random_disc(state.mesh, v, 1 + random() % 12, random));
    const auto target = octahedral::quarter_turn(static_cast<octahedral::Label>(random() % 6));
    if (!zip_patch(state, patch, target, unsmoothed())) {
      expect_same_field(state, before);
      continue;
    }
    const std::set<EdgeKey> bounds(patch.boundary.begin(), patch.boundary.end());
    for (const FaceKey& f : patch.faces)
      for (const EdgeKey& e : {edge_key(f[0], f[1]), edge_key(f[0], f[2]), edge_key(f[1], f[2])}) {
        const EdgeRing ring = ring_of(state.mesh, e[0], e[1]);
        if (bounds.contains(e) || !ring.closed) continue;
        ++with_inner_edges;
        EXPECT_EQ(monodromy(state.field, ring), octahedral::identity);
      }
    const auto [a, b] = patch.start;
    EXPECT_EQ(closed_monodromy(state, ring_of(state.mesh, a, b), a, b), target);
    state = before;
  }
  EXPECT_GT(with_inner_edges, 50);
}

TEST(Zipping, GaugesChangeNothing) {
  RepairState plain = box_state(6, 4, 4);
  RepairState turned = plain;
  const auto gauges = shuffle_gauges(turned, 5);
  const ZipPatch patch = disc(plain.mesh);
  const TetId first = ring_of(plain.mesh, patch.start[0], patch.start[1]).tets[0];
  const Rotation g = gauges[first.index()], target = octahedral::quarter_turn(0);
  const Rotation same = octahedral::product(octahedral::product(octahedral::inverse(g), target), g);
  ASSERT_TRUE(zip_patch(plain, patch, target));
  ASSERT_TRUE(zip_patch(turned, patch, same));
  EXPECT_EQ(plain.codes, turned.codes);
  for (std::size_t t = 0; t < gauges.size(); ++t)
    change_gauge(turned.mesh, turned.field, TetId(static_cast<std::int64_t>(t)), octahedral::inverse(gauges[t]));
  EXPECT_EQ(plain.field.matchings, turned.field.matchings);
  for (std::size_t t = 0; t < gauges.size(); ++t)
    EXPECT_LT(plain.field.frames[t].angularDistance(turned.field.frames[t]), 1e-6);
}

TEST(Zipping, BoundaryEdgesAreClosedThroughTheOutside) {
  RepairState state = box_state(3);
  for (const auto& [edge, code] : state.codes) {
    ASSERT_EQ(code, -1);
    const auto m = closed_monodromy(state, ring_of(state.mesh, edge[0], edge[1]), edge[0], edge[1]);
    const Vec3 e = state.mesh.point(edge[1]) - state.mesh.point(edge[0]);
    EXPECT_EQ(m, octahedral::inverse(octahedral::quarter_turn(closest_label(Quaternion::Identity(), e))));
  }
  // A flat edge of the bottom and a face that stands on it.
  const Vec3 a(1, 1, 0), b(2, 1, 0), top(2, 1, 1);
  const auto patch = patch_of(state.mesh, {{a, b, top}}, {a, b});
  const RepairState before = state;
  ASSERT_TRUE(zip_patch(state, patch, octahedral::quarter_turn(0), unsmoothed()));
  const EdgeKey e = edge_key(vertex_at(state.mesh, a), vertex_at(state.mesh, b));
  EXPECT_EQ(closed_monodromy(state, ring_of(state.mesh, e[0], e[1]), e[0], e[1]), octahedral::quarter_turn(0));
  EXPECT_EQ(state.codes.at(e), 1);
  ASSERT_TRUE(zip_patch(state, patch, octahedral::identity, unsmoothed()));
  expect_same_field(state, before);
}

TEST(Zipping, WhatCannotBeZippedLeavesTheStateAsItWas) {
  RepairState state = zipper_state();
  const RepairState before = state;
  const ZipPatch patch = disc(state.mesh);
  // The arcs are there already: the opposite turn would make half-turns of the start when applied twice.
  EXPECT_FALSE(zip_patch(state, patch, octahedral::product(octahedral::quarter_turn(0), octahedral::quarter_turn(0))));
  expect_same_field(state, before);
  // Two faces that share no edge: the second one stays undetermined.
  ZipPatch apart;
  apart.faces = {patch.faces.front(), patch.faces.back()};
  apart.start = patch.start;
  EXPECT_FALSE(zip_patch(state, apart, octahedral::identity));
  expect_same_field(state, before);
  // A turn about two axes.
  EXPECT_FALSE(zip_patch(state, patch, Rotation(20)));
  expect_same_field(state, before);
}

TEST(Zipping, AnEmptySectorAtTheBoundaryIsRefused) {
  RepairState state = box_state(3);
  // An edge of the box and a face inside it: one quad less would leave none.
  const Vec3 a(1, 0, 0), b(2, 0, 0), inside(2, 1, 1);
  const auto patch = patch_of(state.mesh, {{a, b, inside}}, {a, b});
  const RepairState before = state;
  const EdgeKey e = patch.start;
  const auto now = closed_monodromy(state, ring_of(state.mesh, e[0], e[1]), e[0], e[1]);
  EXPECT_FALSE(zip_patch(state, patch, octahedral::product(now, now)));
  expect_same_field(state, before);
  ASSERT_TRUE(zip_patch(state, patch, octahedral::identity, unsmoothed()));
  EXPECT_EQ(code_of(state, e), 0);
}
