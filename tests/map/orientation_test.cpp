#include "hexfield/map/orientation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace hexfield;

TEST(Orientation, SignsOfSimpleTets) {
  const Vec3 o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  EXPECT_EQ(orientation(o, x, y, z), 1);
  EXPECT_EQ(orientation(o, y, x, z), -1);
  EXPECT_EQ(orientation(o, x, y, Vec3(3, 4, 0)), 0);
  EXPECT_EQ(orientation(o, x, y, Vec3(0, 0, std::numeric_limits<double>::quiet_NaN())), 0);
}

// The last bit of one coordinate decides; the floating-point determinant is lost in rounding.
TEST(Orientation, IsExactNextToAPlane) {
  const Vec3 a(0.1, 0.2, 0.3), b(12.3, 4.7, 9.1), c(-7.7, 3.3, 0.9);
  for (double s : {0.25, 0.3, 0.77}) {
    Vec3 d = a + s * (b - a) + (1 - s) * 0.5 * (c - a);
    int last = 2;
    int changes = 0;
    d[2] -= 64 * std::ldexp(1, -50);
    for (int k = 0; k < 128; ++k) {
      const int sign = orientation(a, b, c, d);
      EXPECT_EQ(sign, -orientation(b, a, c, d));
      EXPECT_EQ(sign, orientation(b, c, a, d));
      if (last != 2 && sign != last) ++changes;
      last = sign;
      d[2] += std::ldexp(1, -50);
    }
    EXPECT_LE(changes, 2);
    EXPECT_GE(changes, 1);
  }
}
