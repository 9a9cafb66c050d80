#include "hexfield/repair/zipper_nodes.hpp"

#include <gtest/gtest.h>

#include <algorithm>

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
