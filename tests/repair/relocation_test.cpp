#include "hexfield/repair/relocation.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "hexfield/base/parallel.hpp"
#include "hexfield/field/matchings.hpp"
#include "support/repair_states.hpp"

using namespace hexfield;
using hexfield::testing::box_state;
using hexfield::testing::turn_face;
using hexfield::testing::vertex_at;

namespace {

// Turns the strip x_from <= x <= x_to at y, so that its two borders become singular lines along z.
void add_lines(RepairState& state, int x_from, int x_to, int y, int height, octahedral::Label about) {
  const Vec3 x(1, 0, 0), z(0, 0, 1);
  for (int i = x_from; i < x_to; ++i)
    for (int k = 0; k < height; ++k) {
      const Vec3 p(i, y, k);
      turn_face(state, {p, p + x, p + x + z}, about, Vec3::UnitY());
      turn_face(state, {p, p + z, p + x + z}, about, Vec3::UnitY());
    }
}

// A box with singular lines along z through (1, 2) and (3, 2); the first zigzags by `noise`.
RepairState noisy_line(double noise) {
  RepairState state = box_state(4, 4, 6);
  add_lines(state, 1, 3, 2, 6, 4);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> d(-noise, noise);
  for (int k = 0; k <= 6; ++k) {
    const VertexId v = vertex_at(state.mesh, Vec3(1, 2, k));
    state.mesh.points[v.index()] += Vec3(d(random), d(random), k == 0 || k == 6 ? 0 : d(random));
  }
  state.codes = compute_codes(state.mesh, state.features, state.field);
  return state;
}

double spread(const RepairState& state) {
  Eigen::AlignedBox2d box;
  for (const auto& [e, code] : state.codes)
    if (!state.features.edges.contains(e) && state.mesh.point(e[0]).x() < 2)
      for (VertexId v : e) box.extend(state.mesh.point(v).head<2>());
  return box.sizes().maxCoeff();
}

RelocationReport relocate(RepairState& state, const RelocationOptions& options = {}) {
  return relocate_singularities(state, ClosestSurface(state.mesh, state.features),
                                ClosestCurve(state.mesh, state.features), options);
}

}  // namespace

TEST(Relocation, ANoisyArcBecomesStraightAndItsEndsStayInTheirSurfaces) {
  RepairState state = noisy_line(0.3);
  ASSERT_TRUE(check(state.mesh).empty());
  int inner = 0;
  for (const auto& [e, code] : state.codes) inner += !state.features.edges.contains(e);
  ASSERT_EQ(inner, 12);
  const double before = spread(state);
  const RepairState start = state;
  const RelocationReport report = relocate(state);
  EXPECT_EQ(report.vertices, 14);
  EXPECT_EQ(report.restored, 0);
  EXPECT_LT(report.newton.end, report.newton.start);
  EXPECT_LT(spread(state), 0.1 * before);
  EXPECT_TRUE(check(state).empty());
  EXPECT_EQ(state.mesh.point(VertexId(2 * 5 + 1)).z(), 0);
  std::set<VertexId> singular;
  for (const auto& [e, code] : state.codes) singular.insert(e.begin(), e.end());
  for (std::size_t v = 0; v < state.mesh.num_vertices(); ++v)
    EXPECT_TRUE(singular.contains(VertexId(v)) || state.mesh.points[v] == start.mesh.points[v]);
  EXPECT_FALSE(report.touched.empty());
}

TEST(Relocation, OnlyVerticesThatMayMoveDo) {
  RepairState state = noisy_line(0.3);
  const RepairState start = state;
  RelocationOptions options;
  const VertexId pinned(static_cast<std::int64_t>(3 * 25 + 2 * 5 + 1));
  options.may_move = [&](VertexId v) { return v != pinned; };
  EXPECT_EQ(relocate(state, options).vertices, 13);
  EXPECT_EQ(state.mesh.point(pinned), start.mesh.point(pinned));
}

TEST(Relocation, CompoundEdgesShrink) {
  RepairState state = noisy_line(0.0);
  const EdgeKey e = edge_key(vertex_at(state.mesh, Vec3(1, 2, 3)), vertex_at(state.mesh, Vec3(1, 2, 4)));
  ASSERT_EQ(state.codes.count(e), 1u);
  state.codes[e] = compound_code;
  RelocationOptions options;
  options.compound_shrink = 10;
  relocate(state, options);
  EXPECT_LT((state.mesh.point(e[0]) - state.mesh.point(e[1])).norm(), 0.6);
  EXPECT_TRUE(check(state.mesh).empty());
}

TEST(Relocation, PairedArcsRepelEachOther) {
  RepairState state = box_state(7, 6, 4);
  add_lines(state, 3, 4, 3, 4, 4);  // two lines of opposite codes, one apart
  state.codes = compute_codes(state.mesh, state.features, state.field);
  const auto distance = [&] {
    const auto at = [&](int x) { return state.mesh.point(VertexId(2 * 56 + 3 * 8 + x)); };
    return (at(3) - at(4)).norm();
  };
  ASSERT_NEAR(distance(), 1, 1e-12);
  for (const auto& [e, code] : state.codes)
    if (!state.features.edges.contains(e)) state.pairs[e] = 5;
  ASSERT_EQ(state.pairs.size(), 8u);
  RepairState without = state;
  without.pairs.clear();
  state.target_length.assign(state.mesh.num_vertices(), 1.5);
  RelocationOptions options;
  options.repulsion = 10;
  relocate(state, options);
  EXPECT_GT(distance(), 1.2);
  EXPECT_TRUE(check(state.mesh).empty());
  state = without;
  relocate(state, options);
  EXPECT_LT(distance(), 1.1);
}

TEST(Relocation, SameBytesForAnyNumberOfThreads) {
  std::vector<Vec3> points[2];
  for (int threads : {1, 2}) {
    set_threads(threads);
    RepairState state = noisy_line(0.3);
    relocate(state);
    points[threads - 1] = state.mesh.points;
  }
  EXPECT_EQ(points[0], points[1]);
}

TEST(Relocation, ZipperArcsShrinkWithoutInvertingTets) {
  RepairState state = hexfield::testing::zipper_state();
  const auto total = [&] {
    double sum = 0;
    for (const auto& [e, code] : state.codes)
      if (!state.features.edges.contains(e)) sum += (state.mesh.point(e[0]) - state.mesh.point(e[1])).norm();
    return sum;
  };
  const double before = total();
  for (int k = 0; k < 5; ++k) relocate(state);
  EXPECT_LT(total(), before);
  EXPECT_TRUE(check(state.mesh).empty());
  EXPECT_TRUE(check(state.mesh, state.field).empty());
}
