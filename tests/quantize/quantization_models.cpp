#include "hexfield/quantize/quantization.hpp"

#include <fmt/core.h>

#include <ctime>

#include "hexfield/quantize/exact_seamless.hpp"
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
      const Quantization pump = quantize_complex(complex, {QuantizeMethod::pump, hexes, 60});
      const double middle = user_seconds();
      expect_valid(complex, pump.lengths);
      const Quantization ilp = quantize_complex(complex, {QuantizeMethod::ilp, hexes, 60});
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
