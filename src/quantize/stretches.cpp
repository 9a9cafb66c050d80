#include "stretches.hpp"

#include <algorithm>
#include <cmath>

#include "integer_layout.hpp"

namespace hexfield::quantize {
namespace {

/// Hexes that count where a block is to vanish: a map has no flat tets.
constexpr double least_extent = 0.25;

double volume6(const ChartMesh& mesh, std::int32_t t) {
  std::array<Vec3, 4> x;
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 3; ++k) x[static_cast<std::size_t>(i)][k] = mesh.points.value(mesh.point(t, i), k);
  return std::abs((x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]));
}

// Per block, along the axes of its chart, of the logarithm.
std::vector<Vec3> block_stretches(const BlockComplex& complex, const IntegerLayout& layout) {
  std::vector<Vec3> found;
  for (std::size_t b = 0; b < complex.blocks.size(); ++b) {
    const IntegerBox& cuboid = layout.cuboid(static_cast<std::int32_t>(b));
    Vec3& s = found.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto real = static_cast<double>(complex.blocks[b].high[k] - complex.blocks[b].low[k]);
      const double wanted = std::max(least_extent, static_cast<double>(cuboid.high[k] - cuboid.low[k]));
      s[static_cast<Eigen::Index>(k)] = std::log(wanted / std::ldexp(real, -complex.grid_exponent));
    }
  }
  return found;
}

}  // namespace

std::vector<Vec3> stretches(const ChartMesh& mesh, const WallCells& cells, std::size_t num_input_tets,
                            const std::vector<std::int64_t>& lengths) {
  const IntegerLayout layout(cells.complex, lengths);
  const std::vector<Vec3> of_block = block_stretches(cells.complex, layout);
  std::vector<Vec3> result(num_input_tets);
  std::vector<std::int32_t> parts;
  for (std::size_t t = 0; t < num_input_tets; ++t) {
    Vec3 sum = Vec3::Zero();
    double volume = 0;
    parts.assign(1, static_cast<std::int32_t>(t));
    while (!parts.empty()) {
      const std::int32_t part = parts.back();
      parts.pop_back();
      if (!mesh.alive(part)) {
        parts.push_back(mesh.tet(part).child);
        parts.push_back(mesh.tet(part).child + 1);
        continue;
      }
      const double v = volume6(mesh, part);
      const Vec3& s = of_block[static_cast<std::size_t>(cells.block_of_tet(part))];
      for (int k = 0; k < 3; ++k)
        sum[k] += v * s[octahedral::axis(
                          octahedral::image(cells.to_block(part).rotation, static_cast<octahedral::Label>(2 * k)))];
      volume += v;
    }
    result[t] = (sum / volume).array().exp();
  }
  return result;
}

}  // namespace hexfield::quantize
