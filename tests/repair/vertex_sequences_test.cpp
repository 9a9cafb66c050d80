#include <gtest/gtest.h>

#include "hexfield/repair/neighbourhood.hpp"
#include "hexfield/repair/one_ring.hpp"
#include "hexfield/repair/ring_search.hpp"
#include "hexfield/repair/vertex_repair.hpp"
#include "support/pyramid_states.hpp"

using namespace hexfield;
using namespace hexfield::testing;

namespace {

const VertexId apex(0);

EdgeCounts counts_at(const RepairState& state, VertexId v) {
  return classify_vertex(state.mesh, state.features, state.field, state.codes, v, singular_edges_at(state, v)).counts;
}

int empty_surface_sectors(RepairState& state) {
  int n = 0;
  for (const SurfaceSector& s : surface_sectors(state, OneRing(state, apex))) n += s.quads == 0;
  return n;
}

}  // namespace

class PyramidApex : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Faces, PyramidApex, ::testing::Values(3, 4));

TEST_P(PyramidApex, HasParabolicSectorsOnlyWhereTheFieldConverges) {
  RepairState state = pyramid_state(GetParam(), 2.5);
  EXPECT_TRUE(check(state).empty());
  EXPECT_EQ(counts_at(state, apex).boundary_minus, GetParam());
  EXPECT_EQ(empty_surface_sectors(state), GetParam());
  EXPECT_TRUE(needs_repair(state, apex));
}

TEST_P(PyramidApex, IsMadeMeshableByASequenceOfOperations) {
  RepairState state = pyramid_state(GetParam(), 2.5);
  shuffle_gauges(state, 5);
  const VertexId seeds[] = {apex};
  Neighbourhood place(state, tets_around(state.mesh, seeds, 1));
  ASSERT_TRUE(repair_vertex(place.local, place.to_local(apex)));
  place.commit(state);
  EXPECT_TRUE(check(state).empty());
  EXPECT_TRUE(vertex_meshable(state, apex));
  EXPECT_TRUE(parabolic_sectors(state, OneRing(state, apex)).empty());
  EXPECT_EQ(count_kind(state, NodeKind::invalid) + count_kind(state, NodeKind::compound), 0);
}

TEST(PyramidApex, TransversalUnzippingOpensOneSectorAndItsInverseIsTheZip) {
  RepairState state = pyramid_state(5, 2.5);
  const int plus = counts_at(state, apex).inner_plus, minus = counts_at(state, apex).inner_minus;
  ASSERT_TRUE(unzip_transversally(state, apex));
  EXPECT_TRUE(check(state).empty());
  EXPECT_EQ(empty_surface_sectors(state), 4);
  EXPECT_EQ(counts_at(state, apex).inner_plus, plus + 1);
  EXPECT_EQ(counts_at(state, apex).inner_minus, minus);
  EXPECT_EQ(counts_at(state, apex).boundary_minus, 5);
}

TEST(PyramidApex, NothingIsKeptWhenTheCallerDeclines) {
  RepairState state = pyramid_state(5, 2.5);
  RingScope scope;
  int asked = 0;
  scope.accept = [&](RepairState&) { return ++asked < 0; };
  const EdgeCounts before = counts_at(state, apex);
  EXPECT_FALSE(unzip_transversally(state, apex, scope));
  EXPECT_GE(asked, 5);
  EXPECT_EQ(empty_surface_sectors(state), 5);
  EXPECT_EQ(counts_at(state, apex).inner_plus, before.inner_plus);
  EXPECT_EQ(state.codes, compute_codes(state.mesh, state.features, state.field));
}
