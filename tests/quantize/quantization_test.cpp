#include "hexfield/quantize/quantization.hpp"

#include <gtest/gtest.h>

#include "../../src/quantize/arc_system.hpp"
#include "../../src/quantize/separation.hpp"
#include "hexfield/base/parallel.hpp"
#include "hexfield/quantize/exact_seamless.hpp"
#include "hexfield/quantize/motorcycle_complex.hpp"
#include "support/block_maps.hpp"

using namespace hexfield;
using namespace hexfield::testing;

namespace {

BlockComplex complex_of(MappedMesh m, const Vec3& scale, const Features& features = {}) {
  for (auto& tet : m.map.uvw)
    for (Vec3& p : tet) p = p.cwiseProduct(scale);
  const ExactSeamless exact = make_exactly_seamless(m.mesh, features, m.map);
  EXPECT_EQ(exact.failure, ExactFailure::none);
  return motorcycle_complex(m.mesh, features, exact.codes, exact.map);
}

double volume(const BlockComplex& c) {
  double sum = 0;
  for (const auto& b : c.blocks) {
    double v = 1;
    for (std::size_t k = 0; k < 3; ++k) v *= std::ldexp(static_cast<double>(b.high[k] - b.low[k]), -c.grid_exponent);
    sum += v;
  }
  return sum;
}

Quantization at_scale_one(const BlockComplex& c, QuantizeMethod method) {
  return quantize_complex(c, {.method = method, .target_hexes = volume(c)});
}

std::vector<std::int64_t> distinct(std::vector<std::int64_t> x) {
  std::sort(x.begin(), x.end());
  x.erase(std::unique(x.begin(), x.end()), x.end());
  return x;
}

}  // namespace

class Quantizers : public ::testing::TestWithParam<QuantizeMethod> {};

TEST_P(Quantizers, ABoxRoundsItsThreeLengths) {
  const BlockComplex c = complex_of(scaled_box(2, 2, 2, Vec3(1.2, 1.8, 0.15)), Vec3(1, 1, 1));
  const Quantization q = at_scale_one(c, GetParam());
  EXPECT_NEAR(q.scale, 1, 1e-12);
  EXPECT_EQ(distinct(q.lengths), (std::vector<std::int64_t>{1, 2, 4}));
  EXPECT_EQ(q.hexes, 8);
  EXPECT_TRUE(check(c, q.lengths).empty());
  EXPECT_EQ(q.method, GetParam());
}

TEST_P(Quantizers, IntegerLengthsAreReturned) {
  for (const auto& lengths : {std::vector<int>{3, 4, 5}, std::vector<int>{3, 4, 5, 2, 6}}) {
    const BlockComplex c = complex_of(polygon_prism(lengths, 2), Vec3(1, 1, 1));
    const Quantization q = at_scale_one(c, GetParam());
    for (std::size_t a = 0; a < c.arcs.size(); ++a) EXPECT_EQ(static_cast<double>(q.lengths[a]), c.length(a));
    EXPECT_EQ(q.objective, 0);
    std::int64_t section = 0;
    for (std::size_t i = 0; i < lengths.size(); ++i) section += lengths[i] * lengths[(i + 1) % lengths.size()];
    EXPECT_EQ(q.hexes, 2 * section);
  }
}

// Statics alone allow one of the three lengths to be 0: the axis would lie on a side.
TEST_P(Quantizers, TheAxisOfAPrismStaysOffItsSides) {
  const BlockComplex c = complex_of(polygon_prism({1, 1, 1}, 1), Vec3(0.2, 0.2, 2.2));
  const Quantization q = at_scale_one(c, GetParam());
  EXPECT_EQ(distinct(q.lengths), (std::vector<std::int64_t>{1, 2}));
  EXPECT_EQ(q.hexes, 6);
  EXPECT_TRUE(check(c, q.lengths).empty());
}

INSTANTIATE_TEST_SUITE_P(All, Quantizers,
                         ::testing::Values(QuantizeMethod::pump, QuantizeMethod::ilp, QuantizeMethod::positive));

TEST(CriticalSet, ThePrismHasTheEntitiesOfItsShape) {
  const auto set = quantize::critical_set(complex_of(polygon_prism({3, 4, 5}, 2), Vec3(1, 1, 1)));
  EXPECT_EQ(std::count(set.nodes.begin(), set.nodes.end(), 1), 8);
  EXPECT_EQ(set.links.size(), 10u);
  EXPECT_EQ(set.statics.size(), 10u + 5u);
  const BlockComplex box = complex_of(scaled_box(2, 2, 2, Vec3(1, 1, 1)), Vec3(1, 1, 1));
  const auto cube = quantize::critical_set(box);
  EXPECT_EQ(std::count(cube.nodes.begin(), cube.nodes.end(), 1), 8);
  EXPECT_EQ(cube.links.size(), 12u);
  EXPECT_EQ(quantize::bundle_system(box, 1).num_bundles(), 3u);
}

TEST(SeparationSearch, NamesACollapsedDirectionAndUnequalSides) {
  const BlockComplex c = complex_of(polygon_prism({3, 4, 5}, 2), Vec3(1, 1, 1));
  std::vector<std::int64_t> lengths;
  for (std::size_t a = 0; a < c.arcs.size(); ++a) lengths.push_back(std::llround(c.length(a)));
  EXPECT_TRUE(check(c, lengths).empty());
  std::vector<std::int64_t> collapsed = lengths;
  for (auto& l : collapsed)
    if (l == 4) l = 0;
  EXPECT_FALSE(check(c, collapsed).empty());
  lengths[0] += 1;
  EXPECT_FALSE(check(c, lengths).empty());
}

// All arcs of a ball with 7 blocks at 0, so that every sector of every source has a coincidence.
TEST(SeparationSearch, FindsTheSameInTheSameOrderOnAnyNumberOfThreads) {
  const BlockComplex c = complex_of(ball(2, 3, 2, 1), Vec3(1, 1, 1));
  const quantize::CriticalSet critical = quantize::critical_set(c);
  const quantize::SeparationSearch search(c, critical);
  const std::vector<std::int64_t> nothing(c.arcs.size(), 0);
  const int before = threads();
  set_threads(1);
  const std::vector<quantize::Separation> alone = search.run(nothing);
  EXPECT_GT(alone.size(), 64u);
  for (const int n : {2, 4}) {
    set_threads(n);
    const std::vector<quantize::Separation> found = search.run(nothing);
    ASSERT_EQ(found.size(), alone.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].cut, alone[i].cut);
      EXPECT_EQ(found[i].positive_only, alone[i].positive_only);
      EXPECT_EQ(found[i].node, alone[i].node);
    }
  }
  set_threads(before);
}
