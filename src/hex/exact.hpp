#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace hexfield::hex {

/// A point of parameter space in fixed point: multiples of 2^-shift, at most 53 bits and a sign.
using Fixed3 = std::array<std::int64_t, 3>;
__extension__ using Wide = __int128;

inline Fixed3 minus(const Fixed3& a, const Fixed3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

/// An exact integer high * 2^60 + low, 0 <= low < 2^60: wide enough for sums of 3 x 3 determinants of
/// 54-bit differences.
struct WideSum {
  Wide high = 0;
  Wide low = 0;

  void normalise() {
    const Wide carry = low >> 60;
    low -= carry * (Wide{1} << 60);
    high += carry;
  }
  WideSum& operator+=(const WideSum& other) {
    high += other.high;
    low += other.low;
    normalise();
    return *this;
  }
  int sign() const { return high != 0 ? (high > 0 ? 1 : -1) : (low > 0 ? 1 : 0); }
};

/// n . d for |n_i| <= 2^108 and |d_i| <= 2^55, exactly.
inline WideSum exact_dot(const std::array<Wide, 3>& n, const Fixed3& d) {
  WideSum sum;
  for (std::size_t i = 0; i < 3; ++i) {
    const Wide high = n[i] >> 60;
    sum.high += high * d[i];
    sum.low += (n[i] - high * (Wide{1} << 60)) * d[i];
  }
  sum.normalise();
  return sum;
}

/// a x b, exactly.
inline std::array<Wide, 3> exact_cross(const Fixed3& a, const Fixed3& b) {
  return {Wide{a[1]} * b[2] - Wide{a[2]} * b[1], Wide{a[2]} * b[0] - Wide{a[0]} * b[2],
          Wide{a[0]} * b[1] - Wide{a[1]} * b[0]};
}

/// det(b - a, c - a, d - a): six times the signed volume, exactly.
inline WideSum determinant(const Fixed3& a, const Fixed3& b, const Fixed3& c, const Fixed3& d) {
  return exact_dot(exact_cross(minus(b, a), minus(c, a)), minus(d, a));
}

/// The half-space normal . (x - base) >= 0 with an exact integer normal; signs are decided in double
/// precision when the error bound allows, otherwise in integers.
class HalfSpace {
 public:
  HalfSpace() = default;
  HalfSpace(const std::array<Wide, 3>& normal, const Fixed3& base) : exact_(normal), base_(base) {
    for (std::size_t i = 0; i < 3; ++i) normal_[i] = static_cast<double>(normal[i]);
  }

  const std::array<double, 3>& normal() const { return normal_; }
  const Fixed3& base() const { return base_; }
  HalfSpace flipped() const { return HalfSpace({-exact_[0], -exact_[1], -exact_[2]}, base_); }

  /// Sign of normal . (x - base).
  int side(const Fixed3& x) const {
    const Fixed3 d = minus(x, base_);
    double value = 0;
    double size = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double term = normal_[i] * static_cast<double>(d[i]);
      value += term;
      size += std::abs(term);
    }
    // Normals and differences carry one rounding each, products and the two sums the rest: < 8 * 2^-53.
    if (std::abs(value) > 1e-15 * size) return value > 0 ? 1 : -1;
    return exact_dot(exact_, d).sign();
  }

 private:
  std::array<double, 3> normal_{};
  std::array<Wide, 3> exact_{};
  Fixed3 base_{};
};

/// Sign of det(b - a, c - a, d - a).
inline int orient3d(const Fixed3& a, const Fixed3& b, const Fixed3& c, const Fixed3& d) {
  return HalfSpace(exact_cross(minus(b, a), minus(c, a)), a).side(d);
}

}  // namespace hexfield::hex
