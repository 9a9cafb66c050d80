// Maps, walls and lengths with one defect each are refused, and the place is named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../src/quantize/wall_cells.hpp"
#include "hexfield/quantize/exact_seamless.hpp"
#include "hexfield/quantize/map_quantizer.hpp"
#include "hexfield/quantize/motorcycle_complex.hpp"
#include "hexfield/quantize/quantization.hpp"
#include "support/block_maps.hpp"

using namespace hexfield;
using namespace hexfield::testing;

namespace {

ExactSeamless exact_of(const MappedMesh& m) {
  ExactSeamless exact = make_exactly_seamless(m.mesh, {}, m.map);
  EXPECT_EQ(exact.failure, ExactFailure::none);
  return exact;
}

std::vector<std::int64_t> real_lengths(const BlockComplex& c) {
  std::vector<std::int64_t> lengths;
  for (std::size_t a = 0; a < c.arcs.size(); ++a) lengths.push_back(std::llround(c.length(a)));
  return lengths;
}

// The error of building the cells of walls that were damaged; fails the test when there is none.
void expect_refused(quantize::WallCells& cells, const std::vector<Vec3>& near) {
  try {
    cells.build();
    ADD_FAILURE() << "damaged walls were taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::no_integer_grid_map);
    ASSERT_EQ(error.places().size(), 1u) << error.sentence();
    ASSERT_EQ(error.ids().size(), 1u);
    // A corner of the damaged face.
    EXPECT_THAT(near, ::testing::Contains(error.places()[0])) << error.sentence();
  }
}

std::vector<Vec3> corners(const quantize::ChartMesh& walls, std::int32_t h) {
  std::vector<Vec3> places;
  for (std::int32_t k = 0; k < 4; ++k)
    if (k != h % 4)
      places.push_back(walls.places[static_cast<std::size_t>(walls.tet(h / 4).vertices[static_cast<std::size_t>(k)])]);
  return places;
}

}  // namespace

TEST(DamagedMaps, ABrokenTransitionIsNamedByItsTetsAndPlace) {
  MappedMesh box = scaled_box(3, 3, 3, Vec3(1, 1, 1));
  // One tet in a chart that is sheared along one of its faces: the face fits, two others do not.
  const TetId broken(70);
  for (Vec3& p : box.map.uvw[broken.index()]) p.y() += 0.02 * p.x();
  const ExactSeamless exact = make_exactly_seamless(box.mesh, {}, box.map);
  ASSERT_EQ(exact.failure, ExactFailure::not_seamless);
  ASSERT_FALSE(exact.violations.empty());
  for (const Violation& v : exact.violations) {
    EXPECT_THAT(v.ids, ::testing::Contains(broken.value)) << v.sentence;
    ASSERT_EQ(v.places.size(), 1u);
    EXPECT_LT((v.places[0] - centroid(box.mesh, broken)).norm(), 0.5);
  }
}

TEST(DamagedMaps, EveryInvertedTetIsNamedByItsPlace) {
  for (const std::size_t t : {0UL, 17UL, 40UL}) {
    MappedMesh m = ball(2, 2, 2, 1);
    std::swap(m.map.uvw[t][1], m.map.uvw[t][2]);
    const ExactSeamless exact = make_exactly_seamless(m.mesh, {}, m.map);
    EXPECT_EQ(exact.failure, ExactFailure::inverted_input);
    ASSERT_EQ(exact.violations.size(), 1u);
    EXPECT_EQ(exact.violations[0].ids, std::vector<std::int64_t>{static_cast<std::int64_t>(t)});
    ASSERT_EQ(exact.violations[0].places.size(), 1u);
    EXPECT_EQ(exact.violations[0].places[0], centroid(m.mesh, TetId(t)));
  }
}

TEST(DamagedMaps, AWallFaceThatIsMissingOrTooManyIsRefused) {
  for (const MappedMesh& m : {polygon_prism({2, 3, 2}, 2), l_prism(2, 3, 2, 1, 2), ball(1, 2, 1, 1)}) {
    const ExactSeamless exact = exact_of(m);
    int tried = 0;
    for (std::int32_t h = 0; tried < 8; ++h) {
      quantize::ChartMesh walls(m.mesh, {}, exact.codes, exact.map);
      quantize::WallCells cells(walls);
      quantize::trace_and_reduce(walls, cells, true);
      ASSERT_TRUE(check(cells.complex).empty());
      if (h >= static_cast<std::int32_t>(4 * walls.num_tets())) break;
      if (!walls.alive(h / 4) || !walls.is_wall(h) || walls.opposite(h) < h) continue;
      ++tried;
      walls.clear_wall(h);
      expect_refused(cells, corners(walls, h));
    }
    EXPECT_GT(tried, 2);
  }
  // A face of the Kuhn subdivision that lies in a plane of the map, inside the only block.
  const MappedMesh box = scaled_box(2, 2, 2, Vec3(1, 1, 1));
  const ExactSeamless exact = exact_of(box);
  quantize::ChartMesh walls(box.mesh, {}, exact.codes, exact.map);
  quantize::WallCells cells(walls);
  quantize::trace_and_reduce(walls, cells, true);
  std::int32_t added = -1;
  for (std::int32_t h = 0; added < 0 && h < static_cast<std::int32_t>(4 * walls.num_tets()); ++h) {
    if (walls.is_wall(h)) continue;
    const std::vector<Vec3> x = corners(walls, h);
    for (int axis = 0; axis < 3; ++axis)
      if (x[0][axis] == x[1][axis] && x[0][axis] == x[2][axis]) {
        // The axis in the chart of the tet, which may be turned.
        for (int k = 0; k < 3; ++k) {
          const auto value = [&](int i) { return walls.points.value(walls.point(h / 4, i), k); };
          double low = 1e300, high = -1e300;
          for (int i = 0; i < 4; ++i)
            if (i != h % 4) low = std::min(low, value(i)), high = std::max(high, value(i));
          if (low == high) walls.set_wall(h, k, 0), added = h;
        }
      }
  }
  ASSERT_GE(added, 0);
  expect_refused(cells, corners(walls, added));
}

TEST(DamagedMaps, LengthsThatCollapseOrDifferAreRefusedWithTheirPlace) {
  const MappedMesh m = polygon_prism({3, 4, 5}, 2);
  const ExactSeamless exact = exact_of(m);
  const ConformingSpace space =
      conforming_space(m.mesh, cut_graph(m.mesh, matchings_of(exact.map), singular_edges(exact.codes)),
                       alignments_of_map(m.mesh, {}, exact.codes, exact.map));
  const MapQuantizer quantizer(m.mesh, {}, exact.codes, exact.map);
  const std::vector<std::int64_t> good = real_lengths(quantizer.complex());
  EXPECT_EQ(quantizer.integer_unknowns(space, good).size(), space.num_integers);
  std::vector<std::int64_t> unequal = good;
  unequal[0] += 1;
  std::vector<std::int64_t> coinciding = good;
  for (auto& l : coinciding)
    if (l == 4) l = 0;
  for (const auto& lengths : {unequal, coinciding}) {
    const std::vector<Violation> found = check(quantizer.complex(), lengths);
    ASSERT_FALSE(found.empty());
    for (const Violation& v : found) EXPECT_EQ(v.places.size(), 1u) << v.sentence;
    try {
      quantizer.integer_unknowns(space, lengths);
      ADD_FAILURE() << "wrong lengths were taken";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::no_integer_grid_map);
      EXPECT_FALSE(error.ids().empty());
      EXPECT_FALSE(error.places().empty());
    }
  }
}

// Closed curves whose length around the torus is 0: every way around it is a separation from the curve to itself.
TEST(DamagedMaps, CyclesOfNoLengthAreRefusedWithTheirPlace) {
  for (const MappedMesh& m : {square_torus(6, 4, 2, 3), disc_torus({2, 1, 2, 1}, 2, 3, 1)}) {
    const ExactSeamless exact = exact_of(m);
    const BlockComplex c = motorcycle_complex(m.mesh, {}, exact.codes, exact.map);
    std::vector<char> around(c.arcs.size(), 0);
    for (const auto& arc : c.arcs)
      if (arc.singular) around[static_cast<std::size_t>(&arc - c.arcs.data())] = 1;
    std::vector<std::int64_t> lengths = real_lengths(c);
    // All arcs along the curves, which are those that a patch has opposite to one of them.
    for (bool grown = true; grown;) {
      grown = false;
      for (const auto& patch : c.patches)
        for (std::size_t k = 0; k < 6; ++k)
          for (std::int32_t a : patch.sides[k])
            if (around[static_cast<std::size_t>(a)] != 0)
              for (std::int32_t b : patch.sides[k ^ 1U])
                if (std::exchange(around[static_cast<std::size_t>(b)], 1) == 0) grown = true;
    }
    for (std::size_t a = 0; a < lengths.size(); ++a)
      if (around[a] != 0) lengths[a] = 0;
    EXPECT_EQ(count_hexes(c, lengths), 0);
    const std::vector<Violation> found = check(c, lengths);
    ASSERT_FALSE(found.empty());
    for (const Violation& v : found) EXPECT_EQ(v.places.size(), 1u) << v.sentence;
    // The quantizer never gives such lengths, whatever is asked for.
    const Quantization q = quantize_complex(c, {.target_hexes = 1e-3});
    EXPECT_TRUE(check(c, q.lengths).empty());
    EXPECT_GT(q.hexes, 0);
  }
}

TEST(DamagedMaps, OptionsOutOfRangeAreRefused) {
  const MappedMesh m = scaled_box(1, 1, 1, Vec3(2, 2, 2));
  const ExactSeamless exact = exact_of(m);
  const BlockComplex c = motorcycle_complex(m.mesh, {}, exact.codes, exact.map);
  EXPECT_THROW(quantize_complex(c, {.target_hexes = 0}), Error);
  EXPECT_THROW(quantize_complex(c, {.min_layers = 0}), Error);
  EXPECT_THROW(quantize_complex(c, {.arc_share = 0}), Error);
  EXPECT_THROW(quantize_complex(c, {.least = {1, 2}}), Error);
  EXPECT_THROW(quantize_complex(c, {.least = std::vector<std::int64_t>(c.arcs.size(), -1)}), Error);
}
