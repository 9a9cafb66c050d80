#include "hexfield/repair/zipper_nodes.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "hexfield/base/parallel.hpp"
#include "hexfield/field/edge_codes.hpp"
#include "hexfield/field/singularity_graph.hpp"
#include "hexfield/repair/state_ops.hpp"
#include "support/repair_states.hpp"

using namespace hexfield;
using hexfield::testing::box_state;
using hexfield::testing::vertex_at;
using hexfield::testing::zipper_state;

namespace {

std::string sentences(const std::vector<Violation>& violations) {
  std::string all;
  for (const Violation& v : violations) all += v.sentence + "\n";
  return all;
}

std::vector<std::string> defects(const RepairState& state) {
  std::vector<std::string> all;
  for (const Defect& d : find_defects(state.mesh, state.features, state.field, state.codes)) all.push_back(d.sentence);
  return all;
}

std::size_t num_zippers(const RepairState& state) {
  const auto graph = singularity_graph(state.mesh, state.features, state.field, state.codes);
  return static_cast<std::size_t>(
      std::ranges::count_if(graph.nodes, [](const SingularNode& n) { return n.kind == NodeKind::zipper; }));
}

// Inner arcs with both ends on the boundary, by code.
std::map<EdgeCode, int> arcs_through(const RepairState& state) {
  std::map<EdgeCode, int> found;
  for (const SingularArc& arc : singularity_graph(state.mesh, state.features, state.field, state.codes).arcs)
    if (!arc.boundary && on_boundary(state.mesh, arc.vertices.front()) && on_boundary(state.mesh, arc.vertices.back()))
      ++found[arc.code];
  return found;
}

}  // namespace

TEST(ZipperSelection, AClosedLoopOfTwoArcsKeepsBothZipperNodes) {
  const RepairState state = zipper_state();
  const auto chains = flow_chains(state);
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_TRUE(chains[0].closed);
  EXPECT_EQ(chains[0].vertices.size(), 9u);
  EXPECT_EQ(chains[0].zippers.size(), 2u);
  EXPECT_NEAR(chains[0].flow.back(), 0.0, 1e-9);
  const auto selected = select_free_zippers(state);
  ASSERT_EQ(selected.size(), 2u);
  for (const FreeZipper& z : selected) {
    EXPECT_EQ(state.codes.at(z.edges[0]), -1);
    EXPECT_EQ(state.codes.at(z.edges[1]), 1);
  }
}

TEST(ZipperNodes, BothZipperNodesOfABoxUnzipToItsEnds) {
  RepairState state = zipper_state();
  EXPECT_EQ(num_zippers(state), 2u);
  EXPECT_EQ(unzip_free_zipper_nodes(state), 2);
  EXPECT_EQ(sentences(check(state)), "");
  EXPECT_EQ(num_zippers(state), 0u);
  EXPECT_EQ(defects(state), std::vector<std::string>());
  EXPECT_EQ(arcs_through(state), (std::map<EdgeCode, int>{{-1, 1}, {1, 1}}));
  const RepairState computed = state;
  EXPECT_EQ(compute_codes(state.mesh, state.features, state.field), computed.codes);
  EXPECT_FALSE(state.pairs.empty());
}

namespace {

// Adds a second loop of arcs of zipper_state() that starts at `corner`; `turns` = 1 or 3 quarter-turns.
void add_loop(RepairState& state, const Vec3& corner, int turns) {
  const Vec3 x(1, 0, 0), d(1, 1, 1), normal(0, 1, -1);
  for (int turn = 0; turn < turns; ++turn)
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b) {
        const Vec3 p = corner + a * x + b * d;
        hexfield::testing::turn_face(state, {p, p + x, p + d}, 0, normal);
        hexfield::testing::turn_face(state, {p + x, p + d, p + x + d}, 0, normal);
      }
  state.codes = compute_codes(state.mesh, state.features, state.field);
}

}  // namespace

TEST(ZipperNodes, AntiParallelPartnersUnzipIntoEachOther) {
  for (int turns : {1, 3}) {
    RepairState state = zipper_state({14, 6, 6}, {2, 1, 1});
    add_loop(state, {8, 3, 3}, turns);
    ASSERT_EQ(num_zippers(state), 4u);
    const auto zippers = select_free_zippers(state);
    ASSERT_EQ(zippers.size(), 4u);
    const auto right = std::ranges::find(zippers, vertex_at(state.mesh, {6, 3, 3}), &FreeZipper::node);
    ASSERT_NE(right, zippers.end());
    const auto path = find_unzip_path(state, unzip_seeds(state, *right), unzip_partners(state, zippers), {}, {});
    ASSERT_TRUE(path && path->partner);
    EXPECT_EQ(path->partner->node, vertex_at(state.mesh, {8, 3, 3}));
    ASSERT_TRUE(unzip(state, *path, {}));
    EXPECT_EQ(num_zippers(state), 2u) << turns;
    EXPECT_EQ(unzip_free_zipper_nodes(state), 2);
    EXPECT_EQ(sentences(check(state)), "");
    EXPECT_EQ(defects(state), std::vector<std::string>());
    EXPECT_EQ(arcs_through(state), (std::map<EdgeCode, int>{{-1, 1}, {1, 1}}));
    EXPECT_EQ(compute_codes(state.mesh, state.features, state.field), state.codes);
  }
}

TEST(ZipperNodes, APatchThatReachesATransversalBoundaryLeavesOneZipperNode) {
  RepairState state = zipper_state({6, 4, 4}, {0, 1, 1});
  // One triangle more, so that the patch meets x = 0 in an edge and not in a vertex.
  hexfield::testing::turn_face(state, {Vec3(0, 1, 1), Vec3(0, 2, 2), Vec3(1, 2, 2)}, 0, Vec3(0, 1, -1));
  state.codes = compute_codes(state.mesh, state.features, state.field);
  EXPECT_EQ(num_zippers(state), 1u);
  EXPECT_EQ(unzip_free_zipper_nodes(state), 1);
  EXPECT_EQ(sentences(check(state)), "");
  EXPECT_EQ(defects(state), std::vector<std::string>());
  EXPECT_EQ(arcs_through(state), (std::map<EdgeCode, int>{{-1, 1}, {1, 1}}));
}

TEST(ZipperNodes, AnArcThatMeetsTheSurfaceWithReversedFlowUnzipsThroughTheDomain) {
  RepairState state = box_state(5, 4, 4);
  hexfield::testing::turn_face(state, {Vec3(0, 1, 1), Vec3(0, 2, 2), Vec3(1, 2, 2)}, 0, Vec3(0, 1, -1));
  state.codes = compute_codes(state.mesh, state.features, state.field);
  const VertexId tip = vertex_at(state.mesh, {1, 2, 2});
  ASSERT_EQ(num_zippers(state), 1u);
  ASSERT_TRUE(is_free_zipper(state, tip));
  // The sign of the whole arc is that of its plus side: the zipper node moves into the surface.
  EdgeKey minus{};
  for (const EdgeKey& e : singular_edges_at(state, tip))
    if (state.codes.at(e) == -1) minus = e;
  state.codes[minus] = 1;
  const VertexId end = minus[0] == tip ? minus[1] : minus[0];
  ASSERT_TRUE(is_free_zipper(state, end));
  const auto selected = select_free_zippers(state);
  ASSERT_EQ(selected.size(), 1u);
  EXPECT_EQ(selected[0].node, end);
  EXPECT_EQ(unzip_free_zipper_nodes(state), 1);
  EXPECT_EQ(sentences(check(state)), "");
  EXPECT_EQ(defects(state), std::vector<std::string>());
  EXPECT_EQ(arcs_through(state), (std::map<EdgeCode, int>{{-1, 1}, {1, 1}}));
}

TEST(ZipperNodes, AZipperNodeBesideTheBoundaryIsZipped) {
  RepairState state = box_state(5, 4, 4);
  const EdgeCodes before = state.codes;
  hexfield::testing::turn_face(state, {Vec3(0, 1, 1), Vec3(0, 2, 2), Vec3(1, 2, 2)}, 0, Vec3(0, 1, -1));
  state.codes = compute_codes(state.mesh, state.features, state.field);
  ASSERT_EQ(num_zippers(state), 1u);
  EXPECT_EQ(zip_near_boundary(state), 1);
  EXPECT_EQ(state.codes, before);
  EXPECT_EQ(sentences(check(state)), "");
}

namespace {

// Another chart in every tet (spec-lmff section 0, gauge change); the field is the same.
void change_gauge(RepairState& state) {
  for (std::size_t i = 0; i < state.mesh.num_tets(); ++i) {
    const TetId t(static_cast<std::int64_t>(i));
    const auto g = static_cast<octahedral::Rotation>((7 * i + 3) % octahedral::order);
    state.field.frames[i] = state.field.frames[i] * octahedral::quaternion(g);
    for (int f = 0; f < 4; ++f)
      if (const HalfFaceId h(t, f); !state.mesh.is_boundary(h))
        set_matching(state, h, octahedral::product(octahedral::inverse(g), state.field.matching(h)));
  }
}

}  // namespace

TEST(ZipperNodes, ChartsChangeNothing) {
  RepairState a = zipper_state({14, 6, 6}, {2, 1, 1});
  add_loop(a, {8, 3, 3}, 1);
  RepairState b = a;
  change_gauge(b);
  ASSERT_EQ(compute_codes(b.mesh, b.features, b.field), b.codes);
  EXPECT_EQ(unzip_free_zipper_nodes(a), 4);
  EXPECT_EQ(unzip_free_zipper_nodes(b), 4);
  EXPECT_TRUE(a.mesh.tets == b.mesh.tets);
  EXPECT_TRUE(a.codes == b.codes);
  EXPECT_TRUE(a.pairs == b.pairs);
}

TEST(ZipperNodes, ThreadsChangeNothing) {
  RepairState a = zipper_state({14, 6, 6}, {2, 1, 1});
  add_loop(a, {8, 3, 3}, 1);
  RepairState b = a;
  const int before = threads();
  set_threads(1);
  unzip_free_zipper_nodes(a);
  set_threads(2);
  unzip_free_zipper_nodes(b);
  set_threads(before);
  EXPECT_TRUE(a.mesh.tets == b.mesh.tets);
  EXPECT_TRUE(a.codes == b.codes);
  for (std::size_t t = 0; t < a.field.frames.size(); ++t)
    EXPECT_EQ(a.field.frames[t].coeffs(), b.field.frames[t].coeffs());
}

TEST(ZipperNodes, AFailedUnzipLeavesTheField) {
  RepairState state = zipper_state();
  const auto zippers = select_free_zippers(state);
  const auto path = find_unzip_path(state, unzip_seeds(state, zippers[0]), {}, {}, {});
  ASSERT_TRUE(path.has_value());
  // All faces are blocked: no way out.
  std::set<FaceKey> wall;
  for (std::size_t i = 0; i < state.mesh.num_tets(); ++i)
    for (int f = 0; f < 4; ++f) wall.insert(state.mesh.key(HalfFaceId(TetId(static_cast<std::int64_t>(i)), f)));
  EXPECT_FALSE(find_unzip_path(state, {&path->seed, 1}, {}, wall, {}).has_value());
  // The zipper node is gone after the first unzip: a second one along a stale path does nothing.
  ASSERT_TRUE(unzip(state, *path, {}));
  const RepairState once = state;
  EXPECT_FALSE(unzip(state, *path, {}));
  EXPECT_EQ(state.codes, once.codes);
  EXPECT_EQ(state.mesh.tets, once.mesh.tets);
}
