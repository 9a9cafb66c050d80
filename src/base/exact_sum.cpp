#include "hexfield/base/exact_sum.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "hexfield/base/parallel.hpp"

namespace hexfield {
namespace {

constexpr std::size_t grain = 8192;
constexpr int bits = 35;  // of each of the two words; 28 bits are left for carries

struct Words {
  std::int64_t high = 0;
  std::int64_t low = 0;
};

}  // namespace

double exact_sum(MPI_Comm comm, std::span<const double> terms) {
  const std::size_t pieces = (terms.size() + grain - 1) / grain;
  std::vector<double> largest_of(pieces, 0.0);
  parallel_for(terms.size(), grain, [&](std::size_t begin, std::size_t end) {
    double largest = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const double size = std::abs(terms[i]);
      largest = std::max(largest, std::isfinite(size) ? size : std::numeric_limits<double>::infinity());
    }
    largest_of[begin / grain] = largest;
  });
  double largest = 0;
  for (double l : largest_of) largest = std::max(largest, l);
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, comm);
  if (!std::isfinite(largest)) return std::numeric_limits<double>::quiet_NaN();
  if (largest < 1e-270) return 0;
  const int exponent = std::ilogb(largest) + 1;
  const double scale = std::ldexp(1.0, bits - exponent);
  const double next_word = std::ldexp(1.0, bits);
  std::vector<Words> parts(pieces);
  parallel_for(terms.size(), grain, [&](std::size_t begin, std::size_t end) {
    Words part;
    for (std::size_t i = begin; i < end; ++i) {
      const double scaled = terms[i] * scale;
      const auto high = static_cast<std::int64_t>(scaled);
      part.high += high;
      part.low += static_cast<std::int64_t>((scaled - static_cast<double>(high)) * next_word);
    }
    parts[begin / grain] = part;
  });
  std::int64_t sum[2] = {0, 0};
  for (const Words& p : parts) sum[0] += p.high, sum[1] += p.low;
  MPI_Allreduce(MPI_IN_PLACE, sum, 2, MPI_INT64_T, MPI_SUM, comm);
  return (static_cast<double>(sum[0]) + static_cast<double>(sum[1]) / next_word) / scale;
}

}  // namespace hexfield
