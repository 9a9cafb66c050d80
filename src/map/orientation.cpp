#include "hexfield/map/orientation.hpp"

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>

namespace hexfield {
namespace {

int exact_orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  using Rational = boost::multiprecision::cpp_rational;
  Rational m[3][3];
  const Vec3* rows[3] = {&b, &c, &d};
  for (int r = 0; r < 3; ++r)
    for (int k = 0; k < 3; ++k) m[r][k] = Rational((*rows[r])[k]) - Rational(a[k]);
  const Rational det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                       m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                       m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  return det.sign();
}

}  // namespace

int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a;
  const Vec3 v = c - a;
  const Vec3 w = d - a;
  const double vw0 = v[1] * w[2], wv0 = v[2] * w[1];
  const double vw1 = v[2] * w[0], wv1 = v[0] * w[2];
  const double vw2 = v[0] * w[1], wv2 = v[1] * w[0];
  const double det = u[0] * (vw0 - wv0) + u[1] * (vw1 - wv1) + u[2] * (vw2 - wv2);
  const double permanent = std::abs(u[0]) * (std::abs(vw0) + std::abs(wv0)) +
                           std::abs(u[1]) * (std::abs(vw1) + std::abs(wv1)) +
                           std::abs(u[2]) * (std::abs(vw2) + std::abs(wv2));
  if (!std::isfinite(permanent)) return 0;
  constexpr double epsilon = std::numeric_limits<double>::epsilon() / 2;
  const double bound = (7 + 56 * epsilon) * epsilon * permanent;
  // Below this size products underflow and the relative bound no longer holds.
  if (std::abs(det) > bound && std::abs(det) > 1e-290) return det > 0 ? 1 : -1;
  return exact_orientation(a, b, c, d);
}

}  // namespace hexfield
