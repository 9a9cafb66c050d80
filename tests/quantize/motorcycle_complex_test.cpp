#include "hexfield/quantize/motorcycle_complex.hpp"

#include <gtest/gtest.h>

#include "hexfield/quantize/exact_seamless.hpp"
#include "support/mapped_meshes.hpp"

using namespace hexfield;
using namespace hexfield::testing;

namespace {

struct Numbers {
  std::size_t nodes, arcs, patches, blocks;
  bool operator==(const Numbers&) const = default;
};
void PrintTo(const Numbers& n, std::ostream* out) {
  *out << n.nodes << " nodes, " << n.arcs << " arcs, " << n.patches << " patches, " << n.blocks << " blocks";
}

Numbers numbers(const BlockComplex& c) { return {c.nodes.size(), c.arcs.size(), c.patches.size(), c.blocks.size()}; }

BlockComplex complex_of(const MappedMesh& m, const Features& features = {}, bool reduce = true) {
  const ExactSeamless exact = make_exactly_seamless(m.mesh, features, m.map);
  EXPECT_EQ(exact.failure, ExactFailure::none);
  BlockComplex complex = motorcycle_complex(m.mesh, features, exact.codes, exact.map, {reduce});
  for (const Violation& v : check(complex)) ADD_FAILURE() << v.sentence;
  long double volume = 0;
  for (const auto& b : complex.blocks) {
    long double v = 1;
    for (std::size_t k = 0; k < 3; ++k) v *= static_cast<long double>(b.high[k] - b.low[k]);
    volume += v;
  }
  long double whole = 0;
  for (const auto& f : m.map.uvw) whole += (f[1] - f[0]).cross(f[2] - f[0]).dot(f[3] - f[0]) / 6;
  EXPECT_NEAR(static_cast<double>(std::ldexp(volume, -3 * complex.grid_exponent) / whole), 1, 1e-9);
  return complex;
}

}  // namespace

TEST(MotorcycleComplex, ACubeIsOneBlock) {
  const MappedMesh box = scaled_box(2, 3, 2, Vec3(1.2, 0.7, 2.3));
  const BlockComplex c = complex_of(box);
  EXPECT_EQ(numbers(c), (Numbers{8, 12, 6, 1}));
  EXPECT_EQ(numbers(complex_of(box, box_features(box.mesh, Vec3(2, 3, 2)))), (Numbers{8, 12, 6, 1}));
}

TEST(MotorcycleComplex, ChartsDoNotMatter) {
  MappedMesh box = scaled_box(3, 3, 3, Vec3(1.2, 0.7, 2.3));
  for (std::int64_t t = 0; t < 60; ++t)
    change_chart(box, TetId(t), static_cast<octahedral::Rotation>(t % 24), Vec3(t % 5, 2, -t % 3));
  EXPECT_EQ(numbers(complex_of(box)), (Numbers{8, 12, 6, 1}));
}

TEST(MotorcycleComplex, PrismsHaveABlockPerSide) {
  const BlockComplex three = complex_of(polygon_prism({3, 4, 5}, 2));
  EXPECT_EQ(numbers(three), (Numbers{14, 25, 15, 3}));
  EXPECT_EQ(three.euler(), 1);
  const BlockComplex five = complex_of(polygon_prism({3, 4, 5, 2, 6}, 2));
  EXPECT_EQ(five.blocks.size(), 5u);
  EXPECT_EQ(five.euler(), 1);
}

TEST(MotorcycleComplex, SolidTorusIsCutIntoTwo) {
  const BlockComplex c = complex_of(square_torus(6, 5, 2, 3), {}, false);
  EXPECT_EQ(c.blocks.size(), 2u);
  EXPECT_EQ(c.euler(), 0);
  EXPECT_EQ(numbers(c), (Numbers{8, 16, 10, 2}));
}
