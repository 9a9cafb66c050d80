#include "hexfield/repair/remesh.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "hexfield/base/parallel.hpp"
#include "hexfield/field/edge_codes.hpp"
#include "hexfield/mesh/quality.hpp"
#include "hexfield/repair/neighbourhood.hpp"
#include "support/repair_states.hpp"

using namespace hexfield;
using hexfield::testing::box_state;
using hexfield::testing::surface_euler_characteristic;
using hexfield::testing::zipper_state;

namespace {

std::vector<TetId> all_tets(const TetMesh& mesh) {
  std::vector<TetId> tets;
  for (std::size_t t = 0; t < mesh.num_tets(); ++t)
    if (mesh.alive(TetId(t))) tets.emplace_back(t);
  return tets;
}

double curve_length(const RepairState& state) {
  double sum = 0;
  for (const auto& [e, c] : state.features.edges) sum += (state.mesh.point(e[0]) - state.mesh.point(e[1])).norm();
  return sum;
}

int inner_singular(const RepairState& state) {
  int n = 0;
  for (const auto& [e, code] : state.codes) n += !state.features.edges.contains(e);
  return n;
}

// Moves the inner vertices at random (boundary vertices stay, so that features keep their places).
void shake(RepairState& state, double most, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> d(-most, most);
  std::vector<char> fixed(state.mesh.num_vertices(), 0);
  for (const auto& [f, c] : state.features.faces)
    for (VertexId v : f) fixed[v.index()] = 1;
  for (std::size_t v = 0; v < state.mesh.num_vertices(); ++v) {
    const Vec3 step(d(random), d(random), d(random));
    if (fixed[v] == 0) state.mesh.points[v] += step;
  }
  state.codes = compute_codes(state.mesh, state.features, state.field);
}

RepairState shaken_zipper() {
  RepairState state = zipper_state();
  shake(state, 0.12, 5);
  std::mt19937 random(6);
  for (double& length : state.target_length) length = 0.5 + 1.5 * static_cast<double>(random() % 1000) / 1000;
  return state;
}

}  // namespace

TEST(Remesh, EditsKeepVolumeFeaturesAndCodes) {
  RepairState state = shaken_zipper();
  ASSERT_TRUE(check(state).empty());
  const int euler = surface_euler_characteristic(state.features);
  const double curves = curve_length(state);
  RemeshReport total;
  for (int round = 0; round < 4; ++round) {
    const EdgeCodes before = state.codes;
    const RemeshReport report = remesh(state, all_tets(state.mesh), {});
    total.splits += report.splits;
    total.collapses += report.collapses;
    total.swaps += report.swaps;
    const auto violations = check(state);
    ASSERT_TRUE(violations.empty()) << violations[0].sentence;
    EXPECT_NEAR(total_volume(state.mesh), 6 * 4 * 4, 1e-9);
    EXPECT_EQ(surface_euler_characteristic(state.features), euler);
    EXPECT_NEAR(curve_length(state), curves, 1e-9);
    EXPECT_EQ(state.codes, compute_codes(state.mesh, state.features, state.field));
    int kept = 0;
    for (const auto& [e, code] : before)
      if (find_tet_with_edge(state.mesh, e[0], e[1]).valid()) kept += code_of(state, e) == code ? 1 : -1000;
    EXPECT_GT(kept, 20);
  }
  EXPECT_GT(total.splits, 20);
  EXPECT_GT(total.collapses, 20);
  EXPECT_GT(total.swaps, 20);
}

TEST(Remesh, SwapsKeepEveryCodeAndImproveTheWorstTets) {
  RepairState state = shaken_zipper();
  const EdgeCodes before = state.codes;
  RemeshOptions options;
  options.split = options.collapse = false;
  const auto mean = [&] {
    double sum = 0;
    for (TetId t : all_tets(state.mesh)) sum += log_energy(tet_distortion(state.mesh, t));
    return sum / static_cast<double>(all_tets(state.mesh).size());
  };
  const double energy = mean();
  EXPECT_GT(remesh(state, all_tets(state.mesh), options).swaps, 10);
  EXPECT_EQ(state.codes, before);
  EXPECT_LT(mean(), energy);
  EXPECT_TRUE(check(state).empty());
}

TEST(Remesh, SmallZipperLoopsVanish) {
  RepairState state = zipper_state();
  const int before = inner_singular(state);
  ASSERT_GT(before, 0);
  state.target_length.assign(state.mesh.num_vertices(), 5.0);
  RemeshOptions options;
  options.split = options.swap = false;
  for (int round = 0; round < 6; ++round) {
    remesh_near_singularities(state, options);
    const auto violations = check(state);
    ASSERT_TRUE(violations.empty()) << violations[0].sentence;
  }
  EXPECT_LT(inner_singular(state), before);
  EXPECT_EQ(inner_singular(state), 0);
}

TEST(Remesh, OnlyTheNeighbourhoodOfSingularitiesChanges) {
  RepairState state = zipper_state({12, 8, 8}, Vec3(1, 1, 1));
  state.target_length.assign(state.mesh.num_vertices(), 0.5);
  const RepairState before = state;
  RemeshOptions options;
  options.split_above = 1;
  EXPECT_GT(remesh_near_singularities(state, options).touched.size(), 100u);
  for (std::size_t i = 0; i < before.mesh.num_tets(); ++i) {
    const TetId t(static_cast<std::int64_t>(i));
    EXPECT_TRUE(centroid(before.mesh, t).x() < 10 || state.mesh.tets[i] == before.mesh.tets[i]);
  }
}

TEST(Remesh, NeighbourhoodsAreRemeshedInsideAndCommitted) {
  RepairState state = shaken_zipper();
  const VertexId seed = hexfield::testing::vertex_at(zipper_state().mesh, Vec3(3, 2, 2));
  const VertexId seeds[] = {seed};
  Neighbourhood n(state, tets_around(state.mesh, seeds, 1));
  RemeshOptions options;
  options.editable = [&](TetId t) { return n.editable(t); };
  const RemeshReport report = remesh(n.local, all_tets(n.local.mesh), options);
  EXPECT_GT(report.splits + report.collapses + report.swaps, 3);
  n.commit(state);
  const auto violations = check(state);
  EXPECT_TRUE(violations.empty()) << violations[0].sentence;
  EXPECT_NEAR(total_volume(state.mesh), 6 * 4 * 4, 1e-9);
}

TEST(Remesh, SameBytesForAnyNumberOfThreads) {
  std::vector<std::array<VertexId, 4>> tets[2];
  for (int threads : {1, 2}) {
    set_threads(threads);
    RepairState state = shaken_zipper();
    remesh_near_singularities(state);
    tets[threads - 1] = state.mesh.tets;
  }
  EXPECT_EQ(tets[0], tets[1]);
}

TEST(PostRemesh, RaisesQualityAndKeepsFeaturesAndCodes) {
  RepairState state = shaken_zipper();
  const ClosestSurface surface(state.mesh, state.features);
  const ClosestCurve curves(state.mesh, state.features);
  const int euler = surface_euler_characteristic(state.features);
  const PostRemeshReport report = post_remesh(state, surface, curves);
  EXPECT_LT(report.worst_after, report.worst_before);
  EXPECT_LT(report.mean_after, report.mean_before);
  const auto violations = check(state);
  ASSERT_TRUE(violations.empty()) << violations[0].sentence;
  EXPECT_NEAR(total_volume(state.mesh), 6 * 4 * 4, 1e-9);
  EXPECT_EQ(surface_euler_characteristic(state.features), euler);
  EXPECT_NEAR(curve_length(state), 4 * (6 + 4 + 4), 1e-9);
  for (std::size_t t = 0; t < state.mesh.num_tets(); ++t) EXPECT_TRUE(state.mesh.alive(TetId(t)));
  for (TetId t : state.mesh.vertex_tet) EXPECT_TRUE(t.valid());
}

TEST(PostRemesh, LengthsAreShorterWhereTheFieldTurns) {
  RepairState state = box_state(10, 4, 4);
  for (std::size_t t = 0; t < state.mesh.num_tets(); ++t)
    if (centroid(state.mesh, TetId(t)).x() > 5)
      state.field.frames[t] = Quaternion(Eigen::AngleAxisd(0.7, Vec3::UnitZ()));
  const auto lengths = field_adapted_lengths(state);
  const auto at = [&](const Vec3& p) { return lengths[hexfield::testing::vertex_at(state.mesh, p).index()]; };
  EXPECT_NEAR(*std::max_element(lengths.begin(), lengths.end()), 1, 1e-12);
  EXPECT_LT(at(Vec3(5, 2, 2)), 0.8 * at(Vec3(0, 2, 2)));
  EXPECT_NEAR(at(Vec3(0, 2, 2)), 1, 1e-12);
  EXPECT_GT(*std::min_element(lengths.begin(), lengths.end()), 0.3);
}

TEST(PostRemesh, VerticesMoveToBetterPlacesForAnyNumberOfThreads) {
  std::vector<Vec3> points[2];
  for (int threads : {1, 2}) {
    set_threads(threads);
    RepairState state = box_state(5);
    shake(state, 0.2, 3);
    std::vector<TetId> tets = all_tets(state.mesh);
    const auto worst = [&] {
      double most = 0;
      for (TetId t : tets) most = std::max(most, tet_distortion(state.mesh, t));
      return most;
    };
    const double before = worst();
    EXPECT_GT(optimise_vertices(state, ClosestSurface(state.mesh, state.features),
                                ClosestCurve(state.mesh, state.features), 4),
              50);
    EXPECT_LT(worst(), 0.3 * before);
    EXPECT_TRUE(check(state.mesh).empty());
    EXPECT_TRUE(check(state.mesh, state.features).empty());
    points[threads - 1] = state.mesh.points;
  }
  EXPECT_EQ(points[0], points[1]);
}
