#include "hexfield/map/conforming_space.hpp"

#include <gtest/gtest.h>

#include "hexfield/map/verify.hpp"
#include "support/maps.hpp"

using namespace hexfield;
using hexfield::testing::change_charts;
using hexfield::testing::mapped_box;
using hexfield::testing::MappedMesh;
using hexfield::testing::valence_prism;

namespace {

CutGraph cut_of(const MappedMesh& m) { return cut_graph(m.mesh, matchings_of(m.map), singular_edges(m.codes)); }

ConformingSpace space_of(const MappedMesh& m) {
  return conforming_space(m.mesh, cut_of(m), alignments_of_map(m.mesh, m.features, m.codes, m.map));
}

}  // namespace

TEST(CutGraph, IsConsistentAndNeedsNoCutWithoutSingularities) {
  for (int k : {3, 4, 5}) {
    MappedMesh m = valence_prism(k, 2, 3);
    change_charts(m, 7);
    const CutGraph cut = cut_of(m);
    EXPECT_TRUE(check(m.mesh, cut).empty());
    EXPECT_EQ(cut.num_patches == 0, k == 4);
    EXPECT_EQ(cut.num_classes() == m.mesh.num_vertices(), k == 4);
    EXPECT_EQ(cut.num_components, 1);
  }
}

TEST(CutGraph, CutMeetsItselfOnlyAtSingularEdgesAndTheBoundary) {
  const MappedMesh m = valence_prism(5, 3, 2);
  const CutGraph cut = cut_of(m);
  std::map<EdgeKey, int> count;
  for (std::size_t i = 0; i < m.mesh.num_tets(); ++i)
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(TetId(i), f);
      if (cut.patch(h) <= 0) continue;
      const auto v = m.mesh.face_vertices(h);
      for (std::size_t s = 0; s < 3; ++s) ++count[edge_key(v[s], v[(s + 1) % 3])];
    }
  for (const auto& [edge, n] : count) {
    if (m.codes.contains(edge) || n > 1) continue;
    EXPECT_FALSE(edge_ring(m.mesh, find_tet_with_edge(m.mesh, edge[0], edge[1]), edge[0], edge[1]).closed);
  }
}

TEST(ConformingSpace, IntegersAreTheFreeLengthsOfTheModel) {
  EXPECT_EQ(space_of(mapped_box(2, 3, 2)).num_integers, 3u);
  for (int k : {3, 5}) {
    MappedMesh m = valence_prism(k, 2, 2);
    EXPECT_EQ(space_of(m).num_integers, static_cast<std::size_t>(k + 1)) << "a_1 .. a_k and h";
    change_charts(m, 3);
    EXPECT_EQ(space_of(m).num_integers, static_cast<std::size_t>(k + 1));
  }
}

TEST(ConformingSpace, ReproducesAMapInAnyCharts) {
  for (int k : {3, 5}) {
    MappedMesh m = valence_prism(k, 2, 3);
    change_charts(m, 11);
    const ConformingSpace space = space_of(m);
    EXPECT_TRUE(space.collapsed.empty());
    const std::vector<double> y = unknowns_of(m.mesh, space, m.map);
    const CornerMap map = to_corner_map(space, coordinates(space, y));
    EXPECT_NEAR(parametric_volume(map), k * 2 * 2 * 3, 1e-12);
    EXPECT_TRUE(verify_map(m.mesh, m.features, m.codes, map).valid());
    EXPECT_TRUE(check_integer_grid(m.mesh, m.features, m.codes, map).empty());
    for (std::size_t i = space.num_reals; i < y.size(); ++i) EXPECT_EQ(y[i], std::nearbyint(y[i]));
  }
}

// Any real choice of the unknowns is seamless and aligned, bit by bit once they are on a dyadic grid.
TEST(ConformingSpace, EveryMemberIsExactlySeamless) {
  MappedMesh m = valence_prism(3, 2, 2);
  const ConformingSpace space = space_of(m);
  std::vector<double> y = unknowns_of(m.mesh, space, m.map);
  std::mt19937 random(5);
  for (double& value : y) value += 0.01 * std::uniform_real_distribution<double>(-1, 1)(random);
  quantize_to_dyadic_grid(space, y);
  const MapReport report = verify_map(m.mesh, m.features, m.codes, to_corner_map(space, coordinates(space, y)));
  EXPECT_TRUE(report.valid());
  EXPECT_EQ(report.max_residual, 0);
}

// spec-quantization section 9, row "perturbation": noise on every corner does not change the structure.
TEST(ConformingSpace, RemovesNoiseFromAMap) {
  MappedMesh m = valence_prism(3, 2, 2);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> noise(-1e-9, 1e-9);
  for (auto& f : m.map.uvw)
    for (Vec3& x : f) x += Vec3(noise(random), noise(random), noise(random));
  const ConformingSpace space = space_of(m);
  EXPECT_EQ(space.num_integers, 4u);
  std::vector<double> y = unknowns_of(m.mesh, space, m.map);
  quantize_to_dyadic_grid(space, y);
  const CornerMap map = to_corner_map(space, coordinates(space, y));
  EXPECT_EQ(verify_map(m.mesh, m.features, m.codes, map).max_residual, 0);
  EXPECT_NEAR(parametric_volume(map), 24, 1e-6);
}

TEST(ConformingSpace, NamesTetsThatTheConstraintsMakeFlat) {
  MappedMesh m = mapped_box(1, 1, 1);
  Alignments alignments = alignments_of_map(m.mesh, m.features, m.codes, m.map);
  for (FaceAlignment& a : alignments.faces) a.axis = 0;
  const ConformingSpace space = conforming_space(m.mesh, cut_of(m), alignments);
  EXPECT_EQ(space.collapsed.size(), m.mesh.num_tets());
}

TEST(Verify, FindsTheCodesOfAMap) {
  for (int k : {3, 4, 5}) {
    const MappedMesh m = valence_prism(k, 2, 2);
    EXPECT_EQ(codes_of_map(m.mesh, m.map), m.codes);
    EXPECT_TRUE(verify_map(m.mesh, m.features, m.codes, m.map).valid());
  }
}

// Fact 25: the three maps that a verifier must not accept.
TEST(Verify, RejectsAFlippedTet) {
  MappedMesh m = valence_prism(3, 1, 1);
  std::swap(m.map.uvw[5][0], m.map.uvw[5][1]);
  const MapReport report = verify_map(m.mesh, m.features, m.codes, m.map);
  ASSERT_EQ(report.inverted.size(), 1u);
  EXPECT_EQ(report.inverted[0], TetId(5));
  EXPECT_FALSE(report.valid());
}

TEST(Verify, RejectsAnArcOfTheSameMonodromyButSevenQuarterTurns) {
  MappedMesh m = valence_prism(7, 1, 2);
  for (auto& [edge, code] : m.codes)
    if (code == 3) code = -1;
  const MapReport report = verify_map(m.mesh, m.features, m.codes, m.map);
  EXPECT_TRUE(report.inverted.empty());
  EXPECT_EQ(report.wrong_edges.size(), 2u);
  EXPECT_FALSE(report.valid());
}

TEST(Verify, RejectsAFeatureFaceOffItsPlane) {
  MappedMesh m = mapped_box(1, 1, 1);
  for (std::size_t i = 0; i < m.mesh.num_tets(); ++i)
    for (std::size_t k = 0; k < 4; ++k)
      if (m.mesh.tets[i][k] == VertexId(7)) m.map.uvw[i][k] += Vec3(0, 0, 1e-3);
  const MapReport report = verify_map(m.mesh, m.features, m.codes, m.map);
  EXPECT_NEAR(report.max_residual, 1e-3, 1e-9);
  EXPECT_FALSE(report.valid());
}
