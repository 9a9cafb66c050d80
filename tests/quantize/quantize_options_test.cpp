// Objective of paths, and lower bounds.
#include <gtest/gtest.h>

#include <numbers>

#include "../../src/quantize/path_objective.hpp"
#include "hexfield/quantize/exact_seamless.hpp"
#include "hexfield/quantize/motorcycle_complex.hpp"
#include "hexfield/quantize/quantization.hpp"
#include "support/block_maps.hpp"

using namespace hexfield;
using namespace hexfield::testing;

namespace {

BlockComplex complex_of(const MappedMesh& m, const Features& features = {}) {
  const ExactSeamless exact = make_exactly_seamless(m.mesh, features, m.map);
  EXPECT_EQ(exact.failure, ExactFailure::none);
  return motorcycle_complex(m.mesh, features, exact.codes, exact.map);
}

double scaled(const MappedMesh& m, double factor) {
  double volume = 0;
  for (const auto& f : m.map.uvw) volume += (f[1] - f[0]).cross(f[2] - f[0]).dot(f[3] - f[0]) / 6;
  return factor * factor * factor * volume;
}

}  // namespace

TEST(PathObjective, PathsJoinSeedsAndTheirSharesSumToOne) {
  for (const MappedMesh& m :
       {l_prism(3, 4, 2, 5, 6), ball(3, 4, 5, 2), slotted_box(3, 2, 4, 5, 2, 3), disc_torus({2, 3, 2, 4}, 3, 4, 2)}) {
    const BlockComplex c = complex_of(m);
    const auto paths = quantize::objective_paths(c, quantize::critical_set(c));
    ASSERT_FALSE(paths.empty());
    double sum = 0;
    for (const auto& p : paths) {
      EXPECT_GT(p.weight, 0);
      sum += p.weight;
      std::size_t arcs = 0;
      for (const auto& along : p.along) arcs += along.size();
      EXPECT_GT(arcs, 0u);
    }
    EXPECT_NEAR(sum, 1, 1e-12);
  }
  // A box: twelve edges between eight corners.
  const BlockComplex box = complex_of(scaled_box(2, 2, 2, Vec3(1, 2, 3)));
  const auto paths = quantize::objective_paths(box, quantize::critical_set(box));
  EXPECT_EQ(paths.size(), 12u);
  for (const auto& p : paths) EXPECT_EQ(p.along[0].size() + p.along[1].size() + p.along[2].size(), 1u);
}

TEST(PathObjective, PumpAndProgramAgreeAndIntegerLengthsStay) {
  for (const MappedMesh& m : {l_prism(3, 4, 2, 5, 6), ball(3, 4, 5, 2), slotted_box(3, 2, 4, 5, 2, 3),
                              cube_without_corner(2, 3), polygon_prism({3, 4, 5, 2, 6}, 2)}) {
    const BlockComplex c = complex_of(m);
    for (const double factor : {0.1, 0.45, 1.0, 1.37}) {
      QuantizeOptions options{.target_hexes = scaled(m, factor), .objective = QuantizeObjective::paths};
      const Quantization pump = quantize_complex(c, options);
      EXPECT_TRUE(check(c, pump.lengths).empty());
      EXPECT_EQ(pump.method, QuantizeMethod::pump);
      options.method = QuantizeMethod::ilp;
      const Quantization ilp = quantize_complex(c, options);
      EXPECT_TRUE(check(c, ilp.lengths).empty());
      ASSERT_TRUE(ilp.proven_optimal);
      EXPECT_LE(pump.objective, 1.05 * ilp.objective + 1e-9) << factor;
      if (factor == 1.0) {
        for (std::size_t a = 0; a < c.arcs.size(); ++a)
          EXPECT_NEAR(static_cast<double>(pump.lengths[a]), c.length(a), 1e-9);
      }
    }
  }
}

TEST(LowerBounds, EveryLinkAndSeparationHasItsLayers) {
  for (const MappedMesh& m : {l_prism(3, 1, 2, 5, 6), ball(3, 4, 5, 1), slotted_box(3, 1, 4, 5, 2, 1),
                              polygon_prism({1, 2, 3}, 1), square_torus(6, 5, 2, 3)}) {
    const BlockComplex c = complex_of(m);
    for (const int layers : {1, 2, 3})
      for (const QuantizeMethod method : {QuantizeMethod::pump, QuantizeMethod::ilp, QuantizeMethod::positive}) {
        const Quantization q = quantize_complex(c, {.method = method, .target_hexes = 5, .min_layers = layers});
        for (const Violation& v : check(c, q.lengths, layers)) ADD_FAILURE() << layers << ": " << v.sentence;
        EXPECT_EQ(q.method, method);
      }
  }
  // The axis of this prism is one layer off its sides when nothing is asked for.
  const BlockComplex prism = complex_of(polygon_prism({1, 2, 3}, 1));
  const Quantization one = quantize_complex(prism, {.target_hexes = 3});
  EXPECT_FALSE(check(prism, one.lengths, 2).empty());
}

TEST(LowerBounds, ArcsKeepTheirLeastLength) {
  const BlockComplex c = complex_of(ball(3, 4, 5, 2));
  std::vector<std::int64_t> least(c.arcs.size(), 0);
  least[7] = 4;
  least[19] = 3;
  for (const QuantizeMethod method : {QuantizeMethod::pump, QuantizeMethod::ilp}) {
    const Quantization q = quantize_complex(c, {.method = method, .target_hexes = 7, .least = least});
    EXPECT_TRUE(check(c, q.lengths).empty());
    for (std::size_t a = 0; a < least.size(); ++a) EXPECT_GE(q.lengths[a], least[a]);
    EXPECT_EQ(q.method, method);
  }
}

// A bar of four hexes bent round half a circle: the map is straight, the curves along it stand for 180 degrees, of
// which three turns of 45 are seen.
TEST(LowerBounds, ArcsKnowHowFarTheyTurnInSpace) {
  MappedMesh m = grid_of_blocks({{{1, 1}, {1, 1}, {1, 1, 1, 1}}}, [](int i, int j, int) { return i == 0 || j == 0; });
  for (Vec3& p : m.mesh.points) {
    const double angle = p.z() * std::numbers::pi / 4, radius = 3 + p.y();
    p = Vec3(p.x(), radius * std::cos(angle), radius * std::sin(angle));
  }
  const BlockComplex c = complex_of(m);
  int curved = 0;
  for (const BlockComplex::Arc& arc : c.arcs) {
    const bool is_curved = arc.turning > 0.01;
    curved += is_curved;
    EXPECT_NEAR(arc.turning, is_curved ? std::numbers::pi : 0, 1e-9);
  }
  EXPECT_EQ(curved, 8) << "six edges of the L, and two where the planes of its concave edge meet the boundary";
}
