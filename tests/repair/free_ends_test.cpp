#include "hexfield/repair/free_ends.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "hexfield/field/singularity_graph.hpp"
#include "hexfield/repair/neighbourhood_loop.hpp"
#include "hexfield/repair/state_ops.hpp"
#include "hexfield/repair/vertex_repair.hpp"
#include "hexfield/repair/zipper_nodes.hpp"
#include "support/repair_states.hpp"

using namespace hexfield;
using namespace hexfield::testing;

namespace {

// A valence-5 arc along x through a box, and a feature curve along y in the face x = 0 through the end of the arc.
RepairState arc_that_ends_on_a_curve(VertexId& end) {
  RepairState state = box_state(4, 4, 4);
  add_straight_arc(state, Vec3(0, 2, 2), 0, -1, 1);
  for (int y = 0; y < 4; ++y)
    state.features.edges[edge_key(vertex_at(state.mesh, Vec3(0, y, 2)), vertex_at(state.mesh, Vec3(0, y + 1, 2)))] = 77;
  for (int y : {0, 4}) state.features.points[vertex_at(state.mesh, Vec3(0, y, 2))] = 78;
  state.codes = compute_codes(state.mesh, state.features, state.field);
  end = vertex_at(state.mesh, Vec3(0, 2, 2));
  return state;
}

// A box with a block on its half x > 2, so that the curve x = z = 2 is reentrant. An arc of code +1 or -1 comes down
// the block and ends at the vertex (2, 2, 2) of the curve, parallel to the wall x = 2: a zipper node on the curve.
RepairState arc_against_a_reentrant_curve(EdgeCode code) {
  RepairState state;
  const TetMesh box = kuhn_box(5, 4, 5);
  std::vector<std::array<VertexId, 4>> tets;
  for (std::size_t i = 0; i < box.num_tets(); ++i) {
    const Vec3 c = centroid(box, TetId(static_cast<std::int64_t>(i)));
    if (c.x() > 2 || c.z() < 2) tets.push_back(box.vertices(TetId(static_cast<std::int64_t>(i))));
  }
  state.mesh = build_tet_mesh(box.points, std::move(tets));
  complete_features(state.mesh, state.features);
  state.field.frames.assign(state.mesh.num_tets(), Quaternion::Identity());
  state.field.matchings.assign(state.mesh.num_tets(), {});
  state.target_length.assign(state.mesh.num_vertices(), 1.0);
  const octahedral::Label about = code > 0 ? 4 : 5;
  for (std::size_t i = 0; i < 4 * state.mesh.num_tets(); ++i) {
    const HalfFaceId h(TetId(static_cast<std::int64_t>(i / 4)), static_cast<int>(i % 4));
    if (state.mesh.is_boundary(h) || outward_normal(state.mesh, h).y() < 0.9) continue;
    const auto v = state.mesh.face_vertices(h);
    const Vec3 c = (state.mesh.point(v[0]) + state.mesh.point(v[1]) + state.mesh.point(v[2])) / 3;
    if (std::abs(c.y() - 2) < 1e-9 && (c.z() < 2 || c.x() > std::min(3.0, c.z())))
      set_matching(state, h, octahedral::product(state.field.matching(h), octahedral::quarter_turn(about)));
  }
  state.codes = compute_codes(state.mesh, state.features, state.field);
  return state;
}

}  // namespace

TEST(FreeEnds, AnArcThatEndsOnACurveLeavesItForTheFace) {
  VertexId end{};
  RepairState state = arc_that_ends_on_a_curve(end);
  ASSERT_EQ(ends_on_curves(state), std::vector<VertexId>{end});
  const std::vector<Place> places = {{{end}, 1}};
  const auto commits = for_places(state, places, [](Neighbourhood& copy, std::span<const VertexId> seeds) {
    return free_arc_end(copy.local, seeds[0]);
  });
  EXPECT_EQ(commits, std::vector<char>{1});
  EXPECT_TRUE(ends_on_curves(state).empty());
  EXPECT_TRUE(singular_edges_at(state, end).empty());
  for (const Violation& v : check(state)) ADD_FAILURE() << v.sentence;
  // The arc now ends at one vertex of the face x = 0 off the curve.
  int ends = 0;
  for (const auto& [edge, code] : state.codes)
    for (VertexId v : edge) {
      const Vec3& p = state.mesh.point(v);
      if (code != 1 || p.x() != 0 || state.features.edges.contains(edge)) continue;
      ++ends;
      EXPECT_GT(std::abs(p.z() - 2), 0.1);
    }
  EXPECT_EQ(ends, 1);
}

TEST(FreeEnds, CornersAndRegularVerticesOfCurvesAreNoEnds) {
  const RepairState state = box_state(3);
  EXPECT_TRUE(ends_on_curves(state).empty());
}

TEST(FreeEnds, AnArcAgainstTheWallOfAReentrantCurveEndsAtAZipperNode) {
  for (EdgeCode code : {EdgeCode{1}, EdgeCode{-1}}) {
    RepairState state = arc_against_a_reentrant_curve(code);
    const VertexId end = vertex_at(state.mesh, Vec3(2, 2, 2));
    ASSERT_EQ(ends_on_curves(state), std::vector<VertexId>{end});
    ASSERT_EQ(code_of(state, edge_key(end, vertex_at(state.mesh, Vec3(3, 2, 3)))), code);
    EXPECT_TRUE(is_zipper_on_curve(state, end));
    EXPECT_TRUE(needs_repair(state, end));
    shuffle_gauges(state, 7);
    EXPECT_TRUE(is_zipper_on_curve(state, end));
  }
  VertexId end{};
  const RepairState through = arc_that_ends_on_a_curve(end);
  EXPECT_FALSE(is_zipper_on_curve(through, end));
}

// The arc goes on below, to the face z = 0; one of opposite code comes up from there to the curve.
TEST(FreeEnds, AZipperNodeOnAReentrantCurveComesApartInside) {
  for (EdgeCode code : {EdgeCode{1}, EdgeCode{-1}}) {
    RepairState state = arc_against_a_reentrant_curve(code);
    const VertexId end = vertex_at(state.mesh, Vec3(2, 2, 2));
    ASSERT_EQ(unzip_free_zipper_nodes(state), 1);
    for (const Violation& v : check(state)) ADD_FAILURE() << v.sentence;
    EXPECT_FALSE(is_zipper_on_curve(state, end));
    EXPECT_FALSE(needs_repair(state, end));
    std::map<EdgeCode, std::multiset<double>> ends;
    for (const SingularArc& arc : singularity_graph(state.mesh, state.features, state.field, state.codes).arcs)
      if (!arc.boundary)
        for (VertexId v : {arc.vertices.front(), arc.vertices.back()}) ends[arc.code].insert(state.mesh.point(v).z());
    EXPECT_EQ(ends[code], (std::multiset<double>{0, 5}));
    EXPECT_EQ(ends[-code], (std::multiset<double>{0, 2}));
  }
}
