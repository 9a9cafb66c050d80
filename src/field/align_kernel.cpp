#include "align_kernel.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "hexfield/base/parallel.hpp"

namespace hexfield {
namespace {

constexpr std::size_t grain = 2048;

Quaternion in_chart(const Quaternion& q, octahedral::Rotation m) {
  return m == octahedral::identity ? q : q * octahedral::quaternion(m);
}

// Average of a frame and its neighbours with sign correction; `closest` gets the smallest |dot| with one of them.
Quaternion averaged(const AlignData& data, const std::vector<Quaternion>& frames, std::size_t i, double& closest) {
  const Quaternion own = frames[i];
  Eigen::Vector4d sum = own.coeffs();
  closest = 1;
  for (std::size_t f = 0; f < 4; ++f) {
    const auto j = static_cast<std::size_t>(data.neighbours[i][f]);
    if (j == data.tets) continue;
    const Eigen::Vector4d g = in_chart(frames[j], data.from_neighbour[i][f]).coeffs();
    closest = std::min(closest, std::abs(g.dot(own.coeffs())));
    sum += g.dot(sum) < 0 ? Eigen::Vector4d(-g) : g;
  }
  const double norm = sum.norm();
  return norm > 1e-12 ? Quaternion(Eigen::Vector4d(sum / norm)) : own;
}

}  // namespace

Quaternion limited(const Quaternion& from, Quaternion to, double smallest_dot) {
  double dot = from.dot(to);
  if (dot < 0) to.coeffs() *= -1, dot = -dot;
  if (dot >= smallest_dot) return to;
  const double share = std::acos(smallest_dot) / std::acos(std::min(1.0, dot));
  return from.slerp(share, to).normalized();
}

long jacobi_sweep(const AlignData& data, const SweepLimits& limits, const std::vector<Quaternion>& previous,
                  const std::vector<Quaternion>& current, std::vector<Quaternion>& next) {
  std::atomic<long> reverted{0};
  parallel_for(data.owned, grain, [&](std::size_t begin, std::size_t end) {
    auto constraint =
        std::lower_bound(data.constraints.begin(), data.constraints.end(), begin,
                         [](const auto& c, std::size_t i) { return static_cast<std::size_t>(c.first) < i; });
    long broken = 0;
    for (std::size_t i = begin; i < end; ++i) {
      double closest = 1;
      Quaternion q = averaged(data, current, i, closest);
      if (constraint != data.constraints.end() && static_cast<std::size_t>(constraint->first) == i) {
        q = project_frame(q, constraint->second);
        ++constraint;
      }
      if (closest < limits.guard) {
        q = previous[i];
        ++broken;
      }
      next[i] = limited(current[i], q, limits.turn);
    }
    reverted += broken;
  });
  return reverted;
}

long revert_broken(const AlignData& data, double guard, const std::vector<Quaternion>& previous,
                   const std::vector<Quaternion>& current, std::vector<Quaternion>& next) {
  std::atomic<long> reverted{0};
  parallel_for(data.owned, grain, [&](std::size_t begin, std::size_t end) {
    long broken = 0;
    for (std::size_t i = begin; i < end; ++i) {
      double closest = 1;
      averaged(data, current, i, closest);
      next[i] = closest < guard ? previous[i] : current[i];
      broken += closest < guard && !(previous[i].coeffs() == current[i].coeffs());
    }
    reverted += broken;
  });
  return reverted;
}

}  // namespace hexfield
