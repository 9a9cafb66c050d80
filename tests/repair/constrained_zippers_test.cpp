#include "hexfield/repair/constrained_zippers.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "hexfield/field/edge_codes.hpp"
#include "hexfield/field/singularity_graph.hpp"
#include "hexfield/repair/state_ops.hpp"
#include "support/repair_states.hpp"

using namespace hexfield;
using hexfield::testing::vertex_at;

namespace {

// Kuhn tets of unit cells under a map of their corners; vertices that coincide are one, tets without volume go.
class CellMesh {
 public:
  template <class Map>
  void add_cell(const std::array<int, 3>& cell, const Map& map) {
    const std::array<std::array<int, 3>, 6> orders = {
        {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
    for (const auto& order : orders) {
      std::array<int, 3> corner = cell;
      std::array<VertexId, 4> tet{vertex(map(corner))};
      for (std::size_t i = 0; i < 3; ++i) {
        ++corner[static_cast<std::size_t>(order[i])];
        tet[i + 1] = vertex(map(corner));
      }
      const double volume = (points[tet[1].index()] - points[tet[0].index()])
                                .cross(points[tet[2].index()] - points[tet[0].index()])
                                .dot(points[tet[3].index()] - points[tet[0].index()]);
      if (std::abs(volume) < 1e-9) continue;
      if (volume < 0) std::swap(tet[2], tet[3]);
      tets.push_back(tet);
    }
  }

  std::vector<Vec3> points;
  std::vector<std::array<VertexId, 4>> tets;

 private:
  VertexId vertex(const Vec3& p) {
    const auto [it, fresh] = ids_.try_emplace({p[0], p[1], p[2]}, VertexId(static_cast<std::int64_t>(points.size())));
    if (fresh) points.push_back(p);
    return it->second;
  }
  std::map<std::array<double, 3>, VertexId> ids_;
};

// A block with a fin on half of its top whose height grows from zero at z = 1: at (2, 4, 1) a convex and a concave
// feature curve leave in parallel, and the surface between them has no quad there. Constant field.
RepairState state_of(const CellMesh& cells, const std::vector<int>& guide) {
  RepairState state;
  state.mesh = build_tet_mesh(cells.points, cells.tets);
  if (!guide.empty()) {
    state.features = features_from_angles(state.mesh);
    for (int x : guide)
      state.features.edges[edge_key(vertex_at(state.mesh, Vec3(x, 4, 1)), vertex_at(state.mesh, Vec3(x + 1, 4, 1)))] =
          1;
  }
  complete_features(state.mesh, state.features);
  state.field.frames.assign(state.mesh.num_tets(), Quaternion::Identity());
  state.field.matchings.assign(state.mesh.num_tets(), {});
  state.target_length.assign(state.mesh.num_vertices(), 1.0);
  state.codes = compute_codes(state.mesh, state.features, state.field);
  return state;
}

// The fin covers first <= x < last of the top.
RepairState fin_state(int length, int first, int last, const std::vector<int>& guide) {
  CellMesh cells;
  auto corner = [](const std::array<int, 3>& c) {
    const double height = 0.25 * std::max(0, c[2] - 1);
    return Vec3(c[0], c[1] <= 4 ? c[1] : 4 + (c[1] - 4) * height, c[2]);
  };
  for (int x = 0; x < length; ++x)
    for (int y = 0; y < 5; ++y)
      for (int z = 0; z < 4; ++z)
        if (y < 4 || (x >= first && x < last)) cells.add_cell({x, y, z}, corner);
  return state_of(cells, guide);
}

std::vector<std::string> defects(const RepairState& state) {
  std::vector<std::string> all;
  for (const Defect& d : find_defects(state.mesh, state.features, state.field, state.codes)) all.push_back(d.sentence);
  return all;
}

}  // namespace

TEST(ConstrainedZippers, AGuideIsWalkedToTheTransversalBoundary) {
  const RepairState state = fin_state(4, 2, 4, {2, 3});
  const VertexId v = vertex_at(state.mesh, {2, 4, 1});
  const TetId tet = find_tet_with_edge(state.mesh, v, vertex_at(state.mesh, {3, 4, 1}));
  const Guide guide = walk_guide(state, {v, tet}, 0, Vec3(0, 0, 1));
  ASSERT_EQ(guide.places.size(), 3u);
  EXPECT_EQ(guide.places.back().vertex, vertex_at(state.mesh, {4, 4, 1}));
  ASSERT_TRUE(guide.exit.valid());
  EXPECT_NEAR(outward_normal(state.mesh, guide.exit)[0], 1.0, 1e-9);
}

TEST(ConstrainedZippers, ASectorBetweenParallelCurvesIsOpenedAlongTheGuide) {
  RepairState state = fin_state(4, 2, 4, {2, 3});
  ASSERT_EQ(defects(state).size(), 1u);
  EXPECT_EQ(repair_constrained_zipper_nodes(state), 1);
  EXPECT_TRUE(check(state).empty());
  EXPECT_EQ(defects(state), std::vector<std::string>());
  const EdgeCodes computed = compute_codes(state.mesh, state.features, state.field);
  EXPECT_EQ(state.codes, computed);
  // The line of code +1 stays on the guide.
  const VertexId a = vertex_at(state.mesh, {2, 4, 1}), b = vertex_at(state.mesh, {3, 4, 1});
  EXPECT_EQ(code_of(state, edge_key(a, b)), 1);
}

// The guides of both ends of the fin stop before its middle; one line goes from end to end, not one from each.
TEST(ConstrainedZippers, TwoSectorsOpenTowardsEachOtherAlongBothGuides) {
  RepairState state = fin_state(7, 2, 5, {2, 4});
  ASSERT_EQ(defects(state).size(), 2u);
  EXPECT_EQ(repair_constrained_zipper_nodes(state), 1);
  EXPECT_TRUE(check(state).empty());
  EXPECT_EQ(defects(state), std::vector<std::string>());
  EXPECT_EQ(state.codes, compute_codes(state.mesh, state.features, state.field));
  for (int x : {2, 4})
    EXPECT_EQ(code_of(state, edge_key(vertex_at(state.mesh, Vec3(x, 4, 1)), vertex_at(state.mesh, Vec3(x + 1, 4, 1)))),
              1);
  int arcs = 0, lines = 0;
  const std::set<VertexId> ends{vertex_at(state.mesh, {2, 4, 1}), vertex_at(state.mesh, {5, 4, 1})};
  for (const SingularArc& arc : singularity_graph(state.mesh, state.features, state.field, state.codes).arcs) {
    arcs += arc.code == -1 && !arc.boundary;
    lines += arc.code == 1 && std::set<VertexId>{arc.vertices.front(), arc.vertices.back()} == ends;
  }
  EXPECT_EQ(arcs, 1);
  EXPECT_EQ(lines, 1);
}
