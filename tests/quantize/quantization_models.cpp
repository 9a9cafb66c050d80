#include "hexfield/quantize/quantization.hpp"

#include <fmt/core.h>

#include <ctime>

#include "hexfield/quantize/exact_seamless.hpp"
#include "hexfield/quantize/map_quantizer.hpp"
#include "hexfield/quantize/motorcycle_complex.hpp"
#include "seamless_models.hpp"

using namespace hexfield;
using namespace hexfield::testing;

namespace {

double user_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

BlockComplex complex_of(const std::filesystem::path& file) {
  const HexexInput input = read_packed(file);
  const ExactSeamless exact = make_exactly_seamless(input.mesh, input.features, input.map);
  return motorcycle_complex(input.mesh, input.features, exact.codes, exact.map);
}

void expect_valid(const BlockComplex& complex, const std::vector<std::int64_t>& lengths) {
  for (const Violation& v : check(complex, lengths)) ADD_FAILURE() << v.sentence;
}

}  // namespace

TEST(QuantizationModels, EveryMapGetsValidIntegers) {
  const auto models = seamless_models();
  if (models.empty()) GTEST_SKIP() << "no shared data beside the checkout";
  for (const auto& file : models) {
    const BlockComplex complex = complex_of(file);
    for (const double hexes : {1.0, 1000.0, 20000.0}) {
      SCOPED_TRACE(fmt::format("{} at {}", file.filename().string(), hexes));
      const double start = user_seconds();
      const Quantization pump = quantize_complex(complex, {.method = QuantizeMethod::pump, .target_hexes = hexes});
      const double middle = user_seconds();
      expect_valid(complex, pump.lengths);
      const Quantization ilp = quantize_complex(complex, {.method = QuantizeMethod::ilp, .target_hexes = hexes});
      const double end = user_seconds();
      expect_valid(complex, ilp.lengths);
      EXPECT_EQ(pump.method, QuantizeMethod::pump);
      if (ilp.method == QuantizeMethod::ilp && ilp.proven_optimal) {
        EXPECT_LE(pump.objective, 1.05 * ilp.objective + 1e-9);
      }
      RecordProperty(
          fmt::format("{} at {}", file.stem().stem().string(), hexes),
          fmt::format("{} hexes, {:.4f}, {} rounds, {} cuts, {:.3f} s by pump; {} hexes, {:.4f}, {} rounds, {} cuts, "
                      "{:.3f} s by "
                      "{}{}",
                      pump.hexes, pump.objective, pump.rounds, pump.separations, middle - start, ilp.hexes,
                      ilp.objective, ilp.rounds, ilp.separations, end - middle,
                      ilp.method == QuantizeMethod::ilp ? "ilp" : "positive", ilp.proven_optimal ? ", optimal" : ""));
    }
  }
}

// The walk over the mesh meets every value in more than one way and refuses when they differ; rounding moves a
// coordinate by little.
TEST(QuantizationModels, IntegerUnknownsFollowTheMap) {
  const auto models = seamless_models();
  if (models.empty()) GTEST_SKIP() << "no shared data beside the checkout";
  for (const auto& file : models) {
    SCOPED_TRACE(file.filename().string());
    const HexexInput input = read_packed(file);
    const ExactSeamless exact = make_exactly_seamless(input.mesh, input.features, input.map);
    const ConformingSpace space =
        conforming_space(input.mesh, cut_graph(input.mesh, matchings_of(exact.map), singular_edges(exact.codes)),
                         alignments_of_map(input.mesh, input.features, exact.codes, exact.map));
    const std::vector<double> y = unknowns_of(input.mesh, space, exact.map);
    try {
      const MapQuantizer quantizer(input.mesh, input.features, exact.codes, exact.map);
      const Quantization q =
          quantize_complex(quantizer.complex(), {.method = QuantizeMethod::pump, .target_hexes = 20000});
      const std::vector<double> integers = quantizer.integer_unknowns(space, q.lengths);
      double worst = 0;
      for (std::size_t k = 0; k < integers.size(); ++k)
        worst = std::max(worst, std::abs(integers[k] - q.scale * y[space.num_reals + k]));
      RecordProperty(file.stem().stem().string(), fmt::format("{:.2f}", worst));
      EXPECT_LT(worst, 4);
    } catch (const Error& error) {
      ADD_FAILURE() << error.sentence();
    }
  }
}
