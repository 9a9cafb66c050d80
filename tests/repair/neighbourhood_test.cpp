#include "hexfield/repair/neighbourhood.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/meshes.hpp"

using namespace hexfield;

namespace {

RepairState box_state(int n) {
  RepairState state;
  state.mesh = hexfield::testing::kuhn_box(n, n, n);
  for (std::size_t t = 0; t < state.mesh.num_tets(); ++t)
    for (int f = 0; f < 4; ++f)
      if (const HalfFaceId h(TetId(static_cast<std::int64_t>(t)), f); state.mesh.is_boundary(h))
        state.features.faces[state.mesh.key(h)] = 1;
  state.field.frames.assign(state.mesh.num_tets(), Quaternion::Identity());
  state.field.matchings.assign(state.mesh.num_tets(), {});
  state.target_length.assign(state.mesh.num_vertices(), 1.0);
  return state;
}

double volume6(const TetMesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.num_tets(); ++i)
    if (const TetId t(static_cast<std::int64_t>(i)); mesh.alive(t)) sum += signed_volume6(mesh, t);
  return sum;
}

// Splits the edge (a, b) of the parent inside a neighbourhood of a and commits it.
void split_through_neighbourhood(RepairState& state, VertexId a, VertexId b) {
  const VertexId seeds[] = {a};
  Neighbourhood n(state, tets_around(state.mesh, seeds, 1));
  FeatureAttribute features(n.local.features);
  FieldAttribute field(n.local.field);
  n.local.target_length.push_back(1.0);
  split_edge(n.local.mesh, n.to_local(a), n.to_local(b), {&features, &field});
  n.commit(state);
}

}  // namespace

TEST(Neighbourhood, CommitOfAnUntouchedCopyChangesNothing) {
  RepairState state = box_state(4);
  const RepairState before = state;
  const VertexId seeds[] = {VertexId(62)};
  Neighbourhood n(state, tets_around(state.mesh, seeds, 0));
  EXPECT_LT(n.footprint().size(), state.mesh.num_tets());
  n.commit(state);
  EXPECT_EQ(state.mesh.tets, before.mesh.tets);
  EXPECT_EQ(state.mesh.opposite, before.mesh.opposite);
  EXPECT_EQ(state.features.faces, before.features.faces);
  EXPECT_EQ(state.field.matchings, before.field.matchings);
  EXPECT_TRUE(check(state.mesh).empty());
}

TEST(Neighbourhood, SplitsInsideAndOnTheBoundaryComeBackConforming) {
  RepairState state = box_state(4);
  split_through_neighbourhood(state, VertexId(62), VertexId(63));  // inside
  EXPECT_TRUE(check(state.mesh).empty());
  const std::size_t faces = state.features.faces.size();
  split_through_neighbourhood(state, VertexId(6), VertexId(7));  // on the face z = 0
  EXPECT_TRUE(check(state.mesh).empty());
  EXPECT_EQ(state.features.faces.size(), faces + 2);
  for (const auto& [face, colour] : state.features.faces) {
    const HalfFaceId h = find_half_face(state.mesh, face);
    ASSERT_TRUE(h.valid());
    EXPECT_TRUE(state.mesh.is_boundary(h));
  }
  EXPECT_NEAR(volume6(state.mesh), 6 * 64, 1e-9);
  EXPECT_EQ(state.field.frames.size(), state.mesh.num_tets());
  EXPECT_EQ(state.target_length.size(), state.mesh.num_vertices());
}

TEST(Neighbourhood, RegionEdgesAreInsideAndShellEdgesAreNot) {
  const RepairState state = box_state(4);
  const VertexId seeds[] = {VertexId(62)};
  const Neighbourhood n(state, tets_around(state.mesh, seeds, 0));
  EXPECT_TRUE(n.edge_inside(n.to_local(VertexId(62)), n.to_local(VertexId(63))));
  EXPECT_FALSE(n.edge_inside(n.to_local(VertexId(63)), n.to_local(VertexId(68))));
}

TEST(Neighbourhood, ChangedCodesAndMatchingsArriveInTheParent) {
  RepairState state = box_state(4);
  const VertexId seeds[] = {VertexId(62)};
  Neighbourhood n(state, tets_around(state.mesh, seeds, 0));
  const VertexId a = n.to_local(VertexId(62));
  const VertexId b = n.to_local(VertexId(63));
  n.local.codes[edge_key(a, b)] = -1;
  const TetId t = find_tet_with_edge(n.local.mesh, a, b);
  const HalfFaceId h = edge_ring(n.local.mesh, t, a, b).crossings[0];
  n.local.field.matchings[h.tet().index()][static_cast<std::size_t>(h.local())] = 4;
  n.commit(state);
  EXPECT_EQ(state.codes.at(edge_key(VertexId(62), VertexId(63))), -1);
  std::size_t changed = 0;
  for (const auto& m : state.field.matchings) changed += m != std::array<octahedral::Rotation, 4>{};
  EXPECT_EQ(changed, 1u);
}

TEST(Neighbourhood, RingsAreTheSameForFewAndForManySeeds) {
  const TetMesh mesh = hexfield::testing::kuhn_box(7, 7, 7);
  std::vector<VertexId> many;
  for (int v = 0; v < 60; ++v) many.emplace_back(2 * v);
  const std::vector<std::vector<VertexId>> cases = {{VertexId(0)}, {VertexId(100), VertexId(300)}, many};
  for (const std::vector<VertexId>& seeds : cases)
    for (int rings = 0; rings <= 2; ++rings) {
      std::vector<VertexId> vertices = seeds;
      std::vector<TetId> expected;
      for (int ring = 0; ring <= rings; ++ring) {
        expected.clear();
        for (std::size_t i = 0; i < mesh.num_tets(); ++i)
          if (const TetId t(static_cast<std::int64_t>(i));
              std::ranges::any_of(vertices, [&](VertexId v) { return mesh.has_vertex(t, v); }))
            expected.push_back(t);
        vertices.clear();
        for (TetId t : expected) vertices.insert(vertices.end(), mesh.vertices(t).begin(), mesh.vertices(t).end());
      }
      EXPECT_EQ(tets_around(mesh, seeds, rings), expected) << seeds.size() << " seeds, " << rings << " rings";
    }
}
