#pragma once

#include <array>
#include <boost/multiprecision/gmp.hpp>
#include <cstdint>
#include <vector>

namespace hexfield::quantize {

using Rational = boost::multiprecision::mpq_rational;

/// Points of parameter space, each in one chart, in units of the dyadic grid of an exactly seamless map. Corners of
/// the map are integers. A point on the segment between two others is known as a double with an error bound and is
/// worked out as a rational only when a comparison is too close to call (spec-quantization 3).
class ExactPoints {
 public:
  using Index = std::int32_t;

  Index add(const std::array<double, 3>& integers);

  /// Where the segment a-b meets the plane: coordinate `axis` is q, an integer strictly between those of the ends.
  /// The ratio belongs to the split and is shared by its images in other charts.
  std::int32_t add_split(Index a, Index b, int axis, double q);
  /// The point that the split makes of the segment a-b, the image of its first segment in any chart.
  Index add_point(std::int32_t split, Index a, Index b);
  /// Says that coordinate `axis` of a point is exactly the integer q.
  void fix(Index p, int axis, double q) { at(p, axis) = {q, 0}; }

  double value(Index p, int axis) const { return at(p, axis).value; }
  double ratio(std::int32_t split) const { return splits_[static_cast<std::size_t>(split)].ratio; }

  /// Sign of coordinate `axis` of p minus q.
  int side(Index p, int axis, double q);
  /// Sign of the difference of two points of one chart on an axis.
  int compare(Index p, Index r, int axis);
  /// The coordinate as an integer; false when it is none.
  bool integer(Index p, int axis, std::int64_t& result);
  Rational exact(Index p, int axis);

 private:
  struct Coordinate {
    double value;
    double error;  // 0: exact
  };
  struct Split {
    Index a, b;
    int axis;
    double q;
    double ratio;
    double ratio_error;
    std::int32_t exact_ratio = -1;
  };
  Coordinate& at(Index p, int axis) {
    return coordinates_[static_cast<std::size_t>(p)][static_cast<std::size_t>(axis)];
  }
  const Coordinate& at(Index p, int axis) const {
    return coordinates_[static_cast<std::size_t>(p)][static_cast<std::size_t>(axis)];
  }
  Rational exact_ratio(std::int32_t split);

  struct Origin {
    std::int32_t split = -1;
    Index a = -1, b = -1;
    std::array<std::int32_t, 3> exact{-1, -1, -1};
  };
  std::vector<std::array<Coordinate, 3>> coordinates_;
  std::vector<Origin> origins_;
  std::vector<Split> splits_;
  std::vector<Rational> rationals_;
};

}  // namespace hexfield::quantize
