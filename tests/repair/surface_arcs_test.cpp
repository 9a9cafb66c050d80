#include <gtest/gtest.h>

#include <algorithm>

#include "hexfield/repair/edge_repair.hpp"
#include "support/cones.hpp"
#include "support/repair_states.hpp"

using namespace hexfield;
using hexfield::testing::box_state;
using hexfield::testing::change_gauges;
using hexfield::testing::turn_face;
using hexfield::testing::vertex_at;

namespace {

constexpr double height = 2;  // of the feature surface

// Triangles of two adjacent corners p, p + a, p + b, p + a + b of a Kuhn box, turned by a quarter about z.
void turn_square(RepairState& state, const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& normal) {
  turn_face(state, {p, p + a, p + a + b}, 4, normal);
  turn_face(state, {p, p + b, p + a + b}, 4, normal);
}

// A box with a feature surface z = 2 and a loop whose axis is z. On both sides of a strip of the surface it runs in it
// from (1, y, 2) to (3, y, 2); at x = 1 it comes from above and at x = 3 from above or from below.
RepairState loop_in_surface(bool crossing) {
  RepairState state = box_state(4, 4, 4);
  state.features = {};
  const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  for (std::size_t t = 0; t < state.mesh.num_tets(); ++t)
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(TetId(static_cast<std::int64_t>(t)), f);
      const auto corners = state.mesh.face_vertices(h);
      if (std::ranges::all_of(corners, [&](VertexId v) { return state.mesh.point(v).z() == height; }))
        state.features.faces[state.mesh.key(h)] = 7;
    }
  complete_features(state.mesh, state.features);
  turn_square(state, {1, 1, 2}, x, y, z);
  turn_square(state, {2, 1, 2}, x, y, z);
  turn_square(state, {1, 1, 2}, y, z, x);
  if (crossing)
    turn_square(state, {3, 1, 1}, y, z, x);
  else
    turn_square(state, {3, 1, 2}, y, z, -x);
  state.codes = compute_codes(state.mesh, state.features, state.field);
  // Edges across the axis have no sign of their own.
  for (auto& [edge, code] : state.codes)
    if (code == undetermined_code) code = 1;
  return state;
}

std::vector<EdgeKey> arcs_in_surface(const RepairState& state) {
  std::vector<EdgeKey> edges;
  for (const auto& [edge, code] : state.codes)
    if (ring_of(state.mesh, edge[0], edge[1]).closed && in_feature_face(state, edge)) edges.push_back(edge);
  return edges;
}

// Vertices of the surface inside the domain with arcs.
std::vector<VertexId> crossings(const RepairState& state) {
  std::set<VertexId> found;
  for (const auto& entry : state.codes)
    for (VertexId v : entry.first)
      if (!on_boundary(state.mesh, v) && on_feature_face(state, v)) found.insert(v);
  return {found.begin(), found.end()};
}

bool above(const RepairState& state, const EdgeKey& e) {
  return state.mesh.point(e[0]).z() + state.mesh.point(e[1]).z() > 2 * height;
}

// What check() has to say, nothing when all is well.
std::string violations(const RepairState& state) {
  std::string all;
  for (const Violation& v : check(state)) all += v.sentence + "\n";
  return all;
}

double volume(const TetMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.num_tets(); ++t) sum += signed_volume6(mesh, TetId(static_cast<std::int64_t>(t)));
  return sum / 6;
}

double smallest_volume(const TetMesh& mesh) {
  double least = 1;
  for (std::size_t t = 0; t < mesh.num_tets(); ++t)
    least = std::min(least, signed_volume6(mesh, TetId(static_cast<std::int64_t>(t))));
  return least;
}

}  // namespace

TEST(SurfaceArcs, AnArcFromAboveGoesAboveAsAWhole) {
  RepairState state = loop_in_surface(false);
  ASSERT_EQ(arcs_in_surface(state).size(), 4U);
  EXPECT_EQ(violations(state), "");
  const std::size_t faces = state.features.faces.size();
  EXPECT_EQ(lift_arcs_from_surfaces(state), 6);
  EXPECT_EQ(violations(state), "");
  EXPECT_TRUE(arcs_in_surface(state).empty());
  EXPECT_TRUE(crossings(state).empty());
  EXPECT_EQ(hexfield::testing::count_code(state, 1) + hexfield::testing::count_code(state, -1), 10);
  for (const auto& [edge, code] : state.codes) EXPECT_TRUE(state.features.edges.contains(edge) || above(state, edge));
  EXPECT_EQ(state.features.faces.size(), faces);
  EXPECT_NEAR(volume(state.mesh), 64, 1e-9);
  EXPECT_GT(smallest_volume(state.mesh), 0);
  const TetMesh rebuilt = build_tet_mesh(state.mesh.points, state.mesh.tets);
  EXPECT_EQ(rebuilt.opposite, state.mesh.opposite);
  EXPECT_EQ(lift_arcs_from_surfaces(state), 0);
}

TEST(SurfaceArcs, AnArcFromAboveToBelowCrossesOnce) {
  RepairState state = loop_in_surface(true);
  ASSERT_EQ(arcs_in_surface(state).size(), 4U);
  ASSERT_EQ(crossings(state).size(), 6U);
  EXPECT_EQ(lift_arcs_from_surfaces(state), 6);
  EXPECT_EQ(violations(state), "");
  EXPECT_TRUE(arcs_in_surface(state).empty());
  const auto left = crossings(state);
  ASSERT_EQ(left.size(), 2U);
  for (VertexId v : left) {
    const auto arcs = singular_edges_at(state, v);
    ASSERT_EQ(arcs.size(), 2U);
    EXPECT_NE(above(state, arcs[0]), above(state, arcs[1]));
    EXPECT_EQ(code_of(state, arcs[0]), code_of(state, arcs[1]));
  }
}

TEST(SurfaceArcs, AVertexThatTouchesFollows) {
  RepairState state = loop_in_surface(false);
  const VertexId middle = vertex_at(state.mesh, {2, 1, 2}), top = vertex_at(state.mesh, {2, 2, 3});
  const TetId side = find_tet_with_edge(state.mesh, middle, top);
  ASSERT_TRUE(push_off_surface(state, middle, side));
  ASSERT_EQ(arcs_in_surface(state).size(), 2U);
  const VertexId touching = vertex_at(state.mesh, {1, 1, 2});
  ASSERT_TRUE(on_feature_face(state, touching));
  EXPECT_EQ(lift_arcs_from_surfaces(state), 5);
  EXPECT_FALSE(on_feature_face(state, touching));
  EXPECT_TRUE(crossings(state).empty());
}

TEST(SurfaceArcs, CurvesAndBoundariesHoldAVertex) {
  RepairState state = loop_in_surface(false);
  const VertexId middle = vertex_at(state.mesh, {2, 1, 2}), next = vertex_at(state.mesh, {2, 2, 2});
  state.features.edges[edge_key(middle, next)] = 9;
  const RepairState before = state;
  EXPECT_FALSE(push_off_surface(state, middle, vertex_star(state.mesh, middle).front()));
  const VertexId rim = vertex_at(state.mesh, {0, 2, 2});
  EXPECT_FALSE(push_off_surface(state, rim, vertex_star(state.mesh, rim).front()));
  EXPECT_EQ(state.mesh.tets, before.mesh.tets);
  EXPECT_EQ(state.codes, before.codes);
}

TEST(SurfaceArcs, GaugesChangeNothing) {
  RepairState plain = loop_in_surface(true);
  RepairState gauged = plain;
  change_gauges(gauged, 5);
  EXPECT_EQ(lift_arcs_from_surfaces(plain), lift_arcs_from_surfaces(gauged));
  EXPECT_EQ(plain.mesh.tets, gauged.mesh.tets);
  EXPECT_EQ(plain.codes, gauged.codes);
}
