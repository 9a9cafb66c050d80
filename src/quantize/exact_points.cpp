#include "exact_points.hpp"

#include <algorithm>
#include <cmath>

namespace hexfield::quantize {
namespace {

constexpr double unit = 0x1p-52;  // two roundings

}  // namespace

ExactPoints::Index ExactPoints::add(const std::array<double, 3>& x) {
  coordinates_.push_back({{{x[0], 0}, {x[1], 0}, {x[2], 0}}});
  origins_.emplace_back();
  return static_cast<Index>(coordinates_.size() - 1);
}

std::int32_t ExactPoints::add_split(Index a, Index b, int axis, double q) {
  Split split{a, b, axis, q, 0, 0};
  const Coordinate& pa = at(a, axis);
  const Coordinate& pb = at(b, axis);
  const double length = std::abs(pa.value - pb.value);
  const double doubt = pa.error + pb.error;
  if (doubt > 1e-3 * length) {
    splits_.push_back(split);
    const auto index = static_cast<std::int32_t>(splits_.size() - 1);
    Split& added = splits_.back();
    added.ratio = static_cast<double>(exact_ratio(index));
    added.ratio_error = unit;
    return index;
  }
  split.ratio = std::clamp((pa.value - q) / (pa.value - pb.value), 0.0, 1.0);
  // |d(n/m)| <= (dn + ratio dm) / (m - dm), and three roundings.
  split.ratio_error = (pa.error + split.ratio * doubt) / (length - doubt) * (1 + 1e-9) + 4 * unit;
  splits_.push_back(split);
  return static_cast<std::int32_t>(splits_.size() - 1);
}

ExactPoints::Index ExactPoints::add_point(std::int32_t split, Index a, Index b) {
  std::array<Coordinate, 3> x;
  const Split& s = splits_[static_cast<std::size_t>(split)];
  for (int k = 0; k < 3; ++k) {
    const Coordinate pa = at(a, k);
    const Coordinate pb = at(b, k);
    Coordinate& c = x[static_cast<std::size_t>(k)];
    if (pa.error == 0 && pb.error == 0 && pa.value == pb.value) {
      c = pa;
      continue;
    }
    const double difference = pb.value - pa.value;
    c.value = pa.value + s.ratio * difference;
    c.error = std::max(pa.error, pb.error) + s.ratio_error * (std::abs(difference) + pa.error + pb.error) +
              4 * unit * (std::abs(pa.value) + std::abs(pb.value));
  }
  coordinates_.push_back(x);
  origins_.push_back({split, a, b, {-1, -1, -1}});
  return static_cast<Index>(coordinates_.size() - 1);
}

Rational ExactPoints::exact_ratio(std::int32_t split) {
  const auto i = static_cast<std::size_t>(split);
  if (splits_[i].exact_ratio < 0) {
    const Rational a = exact(splits_[i].a, splits_[i].axis);
    const Rational b = exact(splits_[i].b, splits_[i].axis);
    rationals_.push_back((a - Rational(splits_[i].q)) / (a - b));
    splits_[i].exact_ratio = static_cast<std::int32_t>(rationals_.size() - 1);
  }
  return rationals_[static_cast<std::size_t>(splits_[i].exact_ratio)];
}

Rational ExactPoints::exact(Index p, int axis) {
  if (at(p, axis).error == 0) return Rational(at(p, axis).value);
  const auto i = static_cast<std::size_t>(p);
  const auto k = static_cast<std::size_t>(axis);
  if (origins_[i].exact[k] < 0) {
    const Rational a = exact(origins_[i].a, axis);
    const Rational b = exact(origins_[i].b, axis);
    rationals_.push_back(a + exact_ratio(origins_[i].split) * (b - a));
    const auto index = static_cast<std::int32_t>(rationals_.size() - 1);
    origins_[i].exact[k] = index;
    const double value = static_cast<double>(rationals_.back());
    at(p, axis) = {value, Rational(value) == rationals_.back() ? 0 : unit * std::abs(value)};
    return rationals_[static_cast<std::size_t>(index)];
  }
  return rationals_[static_cast<std::size_t>(origins_[i].exact[k])];
}

int ExactPoints::side(Index p, int axis, double q) {
  const Coordinate& c = at(p, axis);
  const double d = c.value - q;
  if (c.error == 0 || std::abs(d) > c.error) return d > 0 ? 1 : (d < 0 ? -1 : 0);
  return exact(p, axis).compare(Rational(q));
}

int ExactPoints::compare(Index p, Index r, int axis) {
  const Coordinate& a = at(p, axis);
  const Coordinate& b = at(r, axis);
  const double d = a.value - b.value;
  const double doubt = a.error + b.error;
  if (doubt == 0 || std::abs(d) > doubt * (1 + unit) + unit * std::abs(d)) return d > 0 ? 1 : (d < 0 ? -1 : 0);
  if (p == r) return 0;
  return exact(p, axis).compare(exact(r, axis));
}

bool ExactPoints::integer(Index p, int axis, std::int64_t& result) {
  if (at(p, axis).error != 0) exact(p, axis);
  const Coordinate& c = at(p, axis);
  result = std::llround(c.value);
  return c.error == 0 && static_cast<double>(result) == c.value;
}

}  // namespace hexfield::quantize
