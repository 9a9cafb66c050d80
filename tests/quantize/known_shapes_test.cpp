// The table of known answers of spec-quantization section 9: complex, quantization and their refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../src/quantize/arc_system.hpp"
#include "hexfield/quantize/exact_seamless.hpp"
#include "hexfield/quantize/map_quantizer.hpp"
#include "hexfield/quantize/motorcycle_complex.hpp"
#include "hexfield/quantize/quantization.hpp"
#include "support/block_maps.hpp"

using namespace hexfield;
using namespace hexfield::testing;

namespace {

struct Shape {
  const char* name;
  MappedMesh m;
  std::int64_t euler, hexes;
  std::size_t blocks;   ///< 0: depends on the order of ties
  std::size_t bundles;  ///< 0: not known
  Features features = {};
  bool lattice = true;  ///< all walls lie on the lattice; those that cut a torus open lie anywhere
};

std::vector<Shape> shapes() {
  const MappedMesh box = scaled_box(2, 3, 2, Vec3(2, 1, 3));
  std::vector<Shape> list;
  list.push_back({"box", box, 1, 4 * 3 * 6, 1, 3});
  list.push_back({"box with features", box, 1, 4 * 3 * 6, 1, 3, box_features(box.mesh, Vec3(2, 3, 2))});
  list.push_back({"triangular prism", polygon_prism({3, 4, 5}, 2), 1, 2 * (12 + 20 + 15), 3, 4});
  list.push_back({"pentagonal prism", polygon_prism({3, 4, 5, 2, 6}, 2), 1, 2 * (12 + 20 + 10 + 12 + 18), 5, 6});
  list.push_back({"L", l_prism(3, 4, 2, 5, 6), 1, 6 * (3 * 2 + 3 * 5 + 4 * 2), 3, 5});
  list.push_back({"U", slotted_box(3, 2, 4, 5, 2, 3), 1, 5 * ((3 + 2 + 4) * 2 + (3 + 4) * 3), 5, 7});
  list.push_back({"cube without a corner", cube_without_corner(2, 3), 1, 125 - 27, 0, 0});
  list.push_back({"ball", ball(3, 4, 5, 2), 1, 60 + 4 * (12 + 20 + 15), 7, 4});
  list.push_back({"square torus", square_torus(6, 5, 2, 3), 0, 30, 2, 0, {}, false});
  list.push_back({"disc torus", disc_torus({2, 3, 2, 4}, 3, 4, 2), 0, 11 * (12 + 4 * 7), 10, 0, {}, false});
  return list;
}

BlockComplex complex_of(const MappedMesh& m, const Features& features = {}, bool reduce = true) {
  const ExactSeamless exact = make_exactly_seamless(m.mesh, features, m.map);
  EXPECT_EQ(exact.failure, ExactFailure::none);
  return motorcycle_complex(m.mesh, features, exact.codes, exact.map, {reduce});
}

std::vector<std::int64_t> real_lengths(const BlockComplex& c) {
  std::vector<std::int64_t> lengths;
  for (std::size_t a = 0; a < c.arcs.size(); ++a) lengths.push_back(std::llround(c.length(a)));
  return lengths;
}

std::vector<double> sorted_lengths(const BlockComplex& c) {
  std::vector<double> lengths;
  for (std::size_t a = 0; a < c.arcs.size(); ++a) lengths.push_back(c.length(a));
  std::sort(lengths.begin(), lengths.end());
  return lengths;
}

std::array<std::size_t, 4> numbers(const BlockComplex& c) {
  return {c.nodes.size(), c.arcs.size(), c.patches.size(), c.blocks.size()};
}

std::size_t singular_arcs(const BlockComplex& c, bool boundary) {
  return static_cast<std::size_t>(
      std::count_if(c.arcs.begin(), c.arcs.end(), [&](const auto& a) { return a.singular && a.boundary == boundary; }));
}

// Every tet in a chart of its own.
MappedMesh in_other_charts(MappedMesh m) {
  for (std::size_t t = 0; t < m.mesh.num_tets(); ++t)
    change_chart(m, TetId(t), static_cast<octahedral::Rotation>((7 * t + 3) % 24),
                 Vec3(static_cast<double>(t % 5), -static_cast<double>(t % 7), static_cast<double>(3 * t % 11)));
  return m;
}

}  // namespace

TEST(KnownShapes, ComplexesAndQuantizationsAreThoseOfTheTable) {
  for (const Shape& s : shapes()) {
    SCOPED_TRACE(s.name);
    const BlockComplex c = complex_of(s.m, s.features);
    for (const Violation& v : check(c)) ADD_FAILURE() << v.sentence;
    EXPECT_EQ(c.euler(), s.euler);
    if (s.blocks != 0) {
      EXPECT_EQ(c.blocks.size(), s.blocks);
    }
    if (s.bundles != 0) {
      EXPECT_EQ(quantize::bundle_system(c, 1).num_bundles(), s.bundles);
    }
    if (!s.lattice) continue;
    EXPECT_EQ(count_hexes(c, real_lengths(c)), s.hexes);
    for (const QuantizeMethod method : {QuantizeMethod::pump, QuantizeMethod::ilp}) {
      const Quantization q = quantize_complex(c, {.method = method, .target_hexes = static_cast<double>(s.hexes)});
      EXPECT_EQ(q.lengths, real_lengths(c));
      EXPECT_EQ(q.hexes, s.hexes);
      EXPECT_NEAR(q.objective, 0, 1e-12);
      EXPECT_EQ(q.method, method);
    }
  }
}

// Twice the map, eight times the hexes; coarse ones are valid too, and the pump's are as good as the program's.
TEST(KnownShapes, EveryTargetGetsValidIntegers) {
  for (const Shape& s : shapes()) {
    const BlockComplex c = complex_of(s.m, s.features);
    if (s.lattice) {
      EXPECT_EQ(quantize_complex(c, {.target_hexes = 8 * static_cast<double>(s.hexes)}).hexes, 8 * s.hexes) << s.name;
    }
    for (const double target : {1.0, 30.0, 5000.0}) {
      SCOPED_TRACE(std::string(s.name) + " at " + std::to_string(target));
      const Quantization pump = quantize_complex(c, {.method = QuantizeMethod::pump, .target_hexes = target});
      const Quantization ilp = quantize_complex(c, {.method = QuantizeMethod::ilp, .target_hexes = target});
      for (const Violation& v : check(c, pump.lengths)) ADD_FAILURE() << v.sentence;
      for (const Violation& v : check(c, ilp.lengths)) ADD_FAILURE() << v.sentence;
      EXPECT_TRUE(pump.proven_optimal);
      EXPECT_TRUE(ilp.proven_optimal);
      EXPECT_LE(pump.objective, 1.05 * ilp.objective + 1e-9);
      EXPECT_GT(pump.hexes, 0);
    }
  }
}

TEST(KnownShapes, PlanesThatAreNoFacesOfTheMeshAreTracedThroughIt) {
  for (const Shape& s : shapes()) {
    SCOPED_TRACE(s.name);
    if (!s.features.faces.empty()) continue;
    MappedMesh shaken = s.m;
    shake(shaken, 0.12);
    const BlockComplex clean = complex_of(s.m);
    const BlockComplex c = complex_of(shaken);
    for (const Violation& v : check(c)) ADD_FAILURE() << v.sentence;
    if (s.blocks != 0) {
      EXPECT_EQ(numbers(c), numbers(clean));
    }
    if (s.lattice) {
      EXPECT_EQ(count_hexes(c, real_lengths(c)), s.hexes);
    }
  }
}

TEST(KnownShapes, ChartsDoNotMatter) {
  for (const Shape& s : shapes()) {
    SCOPED_TRACE(s.name);
    const BlockComplex plain = complex_of(s.m, s.features);
    const BlockComplex turned = complex_of(in_other_charts(s.m), s.features);
    EXPECT_EQ(turned.euler(), s.euler);
    if (s.lattice) {
      EXPECT_EQ(count_hexes(turned, real_lengths(turned)), s.hexes);
    }
    if (s.blocks == 0 || !s.lattice) continue;
    EXPECT_EQ(numbers(turned), numbers(plain));
    const double target = 0.3 * static_cast<double>(s.hexes);
    const Quantization a = quantize_complex(plain, {.method = QuantizeMethod::pump, .target_hexes = target});
    const Quantization b = quantize_complex(turned, {.method = QuantizeMethod::pump, .target_hexes = target});
    EXPECT_NEAR(a.objective, b.objective, 1e-9);
  }
}

TEST(KnownShapes, NoiseChangesNeitherStructureNorLengths) {
  for (const Shape& s : shapes()) {
    SCOPED_TRACE(s.name);
    MappedMesh noisy = s.m;
    perturb(noisy.map, 1e-9);
    const ExactSeamless exact = make_exactly_seamless(noisy.mesh, s.features, noisy.map);
    ASSERT_EQ(exact.failure, ExactFailure::none);
    EXPECT_LT(exact.largest_move, 1e-7);
    EXPECT_TRUE(check_exactly_seamless(noisy.mesh, s.features, exact.codes, exact.map).empty());
    // Nothing forces the four curves of the disc torus into common planes: noise makes other walls of them.
    if (!s.lattice) continue;
    const BlockComplex c = motorcycle_complex(noisy.mesh, s.features, exact.codes, exact.map);
    for (const Violation& v : check(c)) ADD_FAILURE() << v.sentence;
    EXPECT_EQ(c.euler(), s.euler);
    if (s.blocks == 0) continue;
    const BlockComplex clean = complex_of(s.m, s.features);
    EXPECT_EQ(numbers(c), numbers(clean));
    const std::vector<double> a = sorted_lengths(c), b = sorted_lengths(clean);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-7);
  }
}

TEST(KnownShapes, BlocksOfAnIntegerMapSplitNoTet) {
  for (const MappedMesh& m : {ball(1, 1, 1, 1), l_prism(1, 1, 1, 1, 1), polygon_prism({1, 1, 1}, 1)})
    EXPECT_EQ(complex_of(m).picture_points.size(), m.mesh.num_vertices());
  MappedMesh shaken = ball(1, 1, 1, 1);
  shake(shaken, 0.1);
  EXPECT_GT(complex_of(shaken).picture_points.size(), shaken.mesh.num_vertices());
}

TEST(KnownShapes, BallHasTwelveInnerAndEightRadialSingularArcs) {
  const BlockComplex c = complex_of(ball(3, 4, 5, 2));
  EXPECT_EQ(numbers(c), (std::array<std::size_t, 4>{16, 32, 24, 7}));
  EXPECT_EQ(singular_arcs(c, false), 20u);
  EXPECT_EQ(singular_arcs(c, true), 0u);
  EXPECT_EQ(quantize_complex(c, {.method = QuantizeMethod::pump, .target_hexes = 1}).hexes, 7);
  EXPECT_EQ(quantize_complex(c, {.method = QuantizeMethod::ilp, .target_hexes = 1}).hexes, 7);
}

TEST(KnownShapes, ToriHaveFourClosedLinksAndMayBeOneHexLong) {
  for (const MappedMesh& m : {square_torus(6, 1, 2, 3), square_torus(6, 2, 2, 3), disc_torus({1, 1, 1, 1}, 2, 2, 1)}) {
    const BlockComplex c = complex_of(m);
    const auto set = quantize::critical_set(c);
    EXPECT_EQ(std::count(set.nodes.begin(), set.nodes.end(), 1), 0);
    EXPECT_EQ(set.links.size(), 4u);
    for (const auto& link : set.links) EXPECT_TRUE(link.closed);
    const Quantization q = quantize_complex(c, {.method = QuantizeMethod::pump, .target_hexes = 1});
    EXPECT_TRUE(check(c, q.lengths).empty());
  }
  // One hex along the torus, one in its square section; five in that of a disc.
  EXPECT_EQ(quantize_complex(complex_of(square_torus(6, 1, 1, 1)), {.target_hexes = 0.2}).hexes, 1);
  EXPECT_EQ(quantize_complex(complex_of(disc_torus({1, 1, 1}, 2, 2, 2)),
                             {.method = QuantizeMethod::pump, .target_hexes = 1e-3})
                .hexes,
            5);
}

TEST(KnownShapes, LWithItsWalls) {
  const BlockComplex c = complex_of(l_prism(3, 4, 2, 5, 6), {}, false);
  EXPECT_EQ(c.blocks.size(), 3u);
  // Six uprights, and around each end six sides, of which the walls cut two.
  EXPECT_EQ(singular_arcs(c, true), 6u + 2 * 8u);
}

// The integers that the walk over the mesh finds for the lengths of the map are those of the map.
TEST(KnownShapes, LengthsBecomeTheUnknownsOfTheMap) {
  for (const Shape& s : shapes()) {
    SCOPED_TRACE(s.name);
    if (!s.lattice) continue;
    const ExactSeamless exact = make_exactly_seamless(s.m.mesh, s.features, s.m.map);
    const ConformingSpace space =
        conforming_space(s.m.mesh, cut_graph(s.m.mesh, matchings_of(exact.map), singular_edges(exact.codes)),
                         alignments_of_map(s.m.mesh, s.features, exact.codes, exact.map));
    const std::vector<double> y = unknowns_of(s.m.mesh, space, exact.map);
    const MapQuantizer quantizer(s.m.mesh, s.features, exact.codes, exact.map);
    const std::vector<double> integers = quantizer.integer_unknowns(space, real_lengths(quantizer.complex()));
    ASSERT_EQ(integers.size(), space.num_integers);
    for (std::size_t k = 0; k < integers.size(); ++k) EXPECT_NEAR(integers[k], y[space.num_reals + k], 1e-9);
  }
}
