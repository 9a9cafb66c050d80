#include <algorithm>
#include <cmath>

#include "hex_topology.hpp"
#include "hexfield/base/parallel.hpp"
#include "hexfield/hex/check.hpp"

namespace hexfield {
namespace {

double det(const Vec3& a, const Vec3& b, const Vec3& c) { return a.cross(b).dot(c); }

}  // namespace

double scaled_jacobian(const HexMesh& mesh, std::size_t hex) {
  double smallest = 1;
  for (const auto& corner : hex::hex_corners) {
    const auto at = [&](int k) -> const Vec3& {
      return mesh.points[static_cast<std::size_t>(mesh.hexes[hex][static_cast<std::size_t>(corner[k])])];
    };
    const auto edge = [&](int k) -> Vec3 {
      const Vec3 e = at(k) - at(0);
      return e / std::max(e.norm(), 1e-300);
    };
    smallest = std::min(smallest, det(edge(1), edge(2), edge(3)));
  }
  return smallest;
}

HexQuality quality(const HexMesh& mesh) {
  HexQuality out;
  const std::size_t n = mesh.hexes.size();
  if (n == 0) return out;
  std::vector<double> each(n);
  parallel_for(n, 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t h = begin; h < end; ++h) each[h] = scaled_jacobian(mesh, h);
  });
  std::sort(each.begin(), each.end());
  double sum = 0;
  for (double e : each) sum += e;
  out.min = each.front();
  out.mean = sum / static_cast<double>(n);
  out.not_positive = static_cast<std::size_t>(std::upper_bound(each.begin(), each.end(), 0.0) - each.begin());
  for (std::size_t k = 0; k < HexQuality::percents.size(); ++k) {
    const double rank = HexQuality::percents[k] / 100 * static_cast<double>(n - 1);
    const auto low = static_cast<std::size_t>(rank);
    const double part = rank - static_cast<double>(low);
    out.percentiles[k] = each[low] + part * (each[std::min(low + 1, n - 1)] - each[low]);
  }
  return out;
}

double volume(const HexMesh& mesh) {
  constexpr std::size_t tets[5][4] = {{0, 1, 3, 4}, {1, 2, 3, 6}, {1, 4, 5, 6}, {3, 4, 6, 7}, {1, 3, 4, 6}};
  return parallel_sum(mesh.hexes.size(), 4096, [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t h = begin; h < end; ++h)
      for (const auto& tet : tets) {
        const auto at = [&](std::size_t k) -> const Vec3& {
          return mesh.points[static_cast<std::size_t>(mesh.hexes[h][tet[k]])];
        };
        sum += det(at(1) - at(0), at(2) - at(0), at(3) - at(0)) / 6;
      }
    return sum;
  });
}

}  // namespace hexfield
