#include "align_kernel.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "hexfield/base/parallel.hpp"

namespace hexfield {
namespace {

constexpr std::size_t grain = 2048;

using Turns = std::array<Quaternion, octahedral::order>;

Turns octahedral_turns() {
  Turns turns;
  for (std::size_t m = 0; m < turns.size(); ++m)
    turns[m] = octahedral::quaternion(static_cast<octahedral::Rotation>(m));
  return turns;
}

// Unit quaternions whose |dot| with a common one is at least cos 45 degrees, with the signs of these dots, are
// within 90 degrees of each other and of any sum of them: the running sum gives the same signs.
constexpr double signs_by_own = 0.708;

// Average of a frame and its neighbours, each with the sign of its dot with the running sum; `closest` gets the
// smallest |dot| of the frame with one of them.
inline Quaternion averaged(const AlignData& data, const Turns& turns, const std::vector<Quaternion>& frames,
                           std::size_t i, double& closest) {
  const Quaternion own = frames[i];
  std::array<Eigen::Vector4d, 4> around;
  std::array<double, 4> dots;
  for (std::size_t f = 0; f < 4; ++f) {
    const auto j = static_cast<std::size_t>(data.neighbours[i][f]);
    const octahedral::Rotation m = data.from_neighbour[i][f];
    around[f] = m == octahedral::identity ? frames[j].coeffs() : (frames[j] * turns[m]).coeffs();
    dots[f] = j == data.tets ? 1 : around[f].dot(own.coeffs());  // a missing neighbour adds zero
  }
  closest = std::min(std::min(std::abs(dots[0]), std::abs(dots[1])), std::min(std::abs(dots[2]), std::abs(dots[3])));
  closest = std::min(closest, 1.0);
  Eigen::Vector4d sum = own.coeffs();
  if (closest >= signs_by_own)
    for (std::size_t f = 0; f < 4; ++f) sum += std::copysign(1.0, dots[f]) * around[f];
  else
    for (std::size_t f = 0; f < 4; ++f) sum += std::copysign(1.0, around[f].dot(sum)) * around[f];
  const double norm = sum.norm();
  return norm > 1e-12 ? Quaternion(Eigen::Vector4d(sum * (1 / norm))) : own;
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
  const Turns turns = octahedral_turns();
  parallel_for(data.owned, grain, [&](std::size_t begin, std::size_t end) {
    auto constraint =
        std::lower_bound(data.constraints.begin(), data.constraints.end(), begin,
                         [](const auto& c, std::size_t i) { return static_cast<std::size_t>(c.first) < i; });
    long broken = 0;
    for (std::size_t i = begin; i < end; ++i) {
      double closest = 1;
      Quaternion q = averaged(data, turns, current, i, closest);
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
  const Turns turns = octahedral_turns();
  parallel_for(data.owned, grain, [&](std::size_t begin, std::size_t end) {
    long broken = 0;
    for (std::size_t i = begin; i < end; ++i) {
      double closest = 1;
      averaged(data, turns, current, i, closest);
      next[i] = closest < guard ? previous[i] : current[i];
      broken += closest < guard && !(previous[i].coeffs() == current[i].coeffs());
    }
    reverted += broken;
  });
  return reverted;
}

}  // namespace hexfield
