#include "hexfield/map/refine_map.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "hexfield/field/matchings.hpp"
#include "hexfield/map/compute_map.hpp"
#include "hexfield/map/orientation.hpp"
#include "hexfield/map/verify.hpp"
#include "support/maps.hpp"

using namespace hexfield;
using hexfield::testing::MappedMesh;
using hexfield::testing::valence_prism;

namespace {

FieldResult field_of(const MappedMesh& m) {
  FieldResult f{m.mesh, m.features, {}, m.codes};
  f.field.frames.assign(m.mesh.num_tets(), Quaternion::Identity());
  f.field.matchings = matchings_of(m.map);
  return f;
}

double smallest_volume(const CornerMap& map) {
  double least = 1e300;
  for (const auto& f : map.uvw) least = std::min(least, (f[1] - f[0]).cross(f[2] - f[0]).dot(f[3] - f[0]));
  return least;
}

}  // namespace

// Every tet blocks: all bridges of the prism get a vertex, and the map stays the same map with all that belongs to it.
TEST(RefineMap, KeepsTheMapAndWhatBelongsToIt) {
  const MappedMesh m = valence_prism(5, 1, 1);
  FieldResult f = field_of(m);
  CornerMap map = m.map;
  CornerMap doubled = m.map;
  for (auto& corners : doubled.uvw)
    for (Vec3& p : corners) p *= 2;
  std::vector<TetId> all;
  for (std::size_t t = 0; t < m.mesh.num_tets(); ++t) all.emplace_back(static_cast<std::int64_t>(t));
  FieldResult again = field_of(m);
  CornerMap other = m.map;
  EXPECT_EQ(split_bridges(again, {&other}), 10);
  EXPECT_TRUE(check(again.mesh, again.features).empty());
  EXPECT_TRUE(verify_map(again.mesh, again.features, again.codes, other).valid());
  EXPECT_EQ(split_bridges(again, {&other}), 0);
  const int splits = refine_at_blocking_tets(f, {&map, &doubled}, all);
  // Of five cells of one layer: the diagonal of each cell through its inside, and nothing but it, is a bridge, and so
  // is the diagonal of each of the five walls between them.
  EXPECT_EQ(splits, 10);
  EXPECT_TRUE(check(f.mesh).empty());
  EXPECT_TRUE(check(f.mesh, f.features).empty());
  EXPECT_TRUE(check(f.mesh, f.field).empty());
  ASSERT_EQ(map.uvw.size(), f.mesh.num_tets());
  const MapReport report = verify_map(f.mesh, f.features, f.codes, map);
  EXPECT_TRUE(report.valid());
  EXPECT_LT(report.max_residual, 1e-15);
  EXPECT_NEAR(parametric_volume(map), parametric_volume(m.map), 1e-12);
  EXPECT_NEAR(parametric_volume(doubled), 8 * parametric_volume(m.map), 1e-12);
  EXPECT_EQ(matchings_of(map), f.field.matchings);
  // No bridge is left, so the next call splits the longest edges.
  const std::size_t tets = f.mesh.num_tets();
  EXPECT_EQ(refine_at_blocking_tets(f, {&map, &doubled}, {TetId(0)}), 1);
  EXPECT_GT(f.mesh.num_tets(), tets);
  EXPECT_TRUE(verify_map(f.mesh, f.features, f.codes, doubled).valid());
}

TEST(RelaxSeamlessMap, ThinTetsGrowAndTheMapStaysSeamless) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MappedMesh m = valence_prism(5, 2, 2);
  // The inner vertex in the middle of a sector is moved almost into the plane of its lowest neighbours.
  VertexId inner;
  for (std::size_t t = 0; t < m.mesh.num_tets(); ++t)
    for (std::size_t k = 0; k < 4; ++k)
      if (m.map.uvw[t][k] == Vec3(1, 1, 1) && !inner.valid()) inner = m.mesh.tets[t][k];
  for (std::size_t t = 0; t < m.mesh.num_tets(); ++t)
    for (std::size_t k = 0; k < 4; ++k)
      if (m.mesh.tets[t][k] == inner) m.map.uvw[t][k] = Vec3(1, 1, 1e-9);
  const double before = smallest_volume(m.map);
  ASSERT_GT(before, 0);
  ASSERT_LT(before, 1e-8);
  if (rank != 0) m = {};
  const SeamlessResult relaxed = relax_seamless_map(MPI_COMM_WORLD, m.mesh, m.features, m.codes, m.map, Control());
  EXPECT_TRUE(relaxed.report.valid());
  EXPECT_EQ(relaxed.report.max_residual, 0);
  if (rank == 0) {
    EXPECT_GT(smallest_volume(relaxed.map), 0.1);
  }
}
