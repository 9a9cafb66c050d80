#include "hexfield/field/spherical_harmonics.hpp"

#include <cmath>
#include <vector>

namespace hexfield::harmonics {
namespace {

const double zonal_part = std::sqrt(7.0 / 12.0);
const double twist_part = std::sqrt(5.0 / 12.0);

struct Entry {
  int row;  // m of the row
  int column;
  double value;
};

ShMatrix antisymmetric(const std::vector<Entry>& entries) {
  ShMatrix l = ShMatrix::Zero();
  for (const Entry& e : entries) {
    l(e.row + 4, e.column + 4) = e.value;
    l(e.column + 4, e.row + 4) = -e.value;
  }
  return l;
}

std::array<ShMatrix, 3> build_generators() {
  const double a = std::sqrt(2.0);
  const double b = std::sqrt(3.5);
  const double c = std::sqrt(4.5);
  const double d = std::sqrt(10.0);
  return {antisymmetric({{-4, 3, -a}, {-3, 2, -b}, {-3, 4, -a}, {-2, 1, -c}, {-2, 3, -b}, {-1, 0, -d}, {-1, 2, -c}}),
          antisymmetric({{-4, -3, a}, {-3, -2, b}, {-2, -1, c}, {0, 1, -d}, {1, 2, -c}, {2, 3, -b}, {3, 4, -a}}),
          antisymmetric({{-1, 1, 1}, {-2, 2, 2}, {-3, 3, 3}, {-4, 4, 4}})};
}

const std::array<ShMatrix, 3>& generators() {
  static const std::array<ShMatrix, 3> l = build_generators();
  return l;
}

// exp(m) by its series after halving the argument; m is at most a quarter-turn here.
ShMatrix exponential(const ShMatrix& m) {
  const ShMatrix small = m / 256;
  ShMatrix sum = ShMatrix::Identity();
  ShMatrix power = ShMatrix::Identity();
  for (int k = 1; k <= 16; ++k) {
    power = power * small / k;
    sum += power;
  }
  for (int k = 0; k < 8; ++k) sum = sum * sum;
  return sum;
}

Sh rotated_about_z(double angle, const Sh& s) {
  Sh r = s;
  for (int m = 1; m <= 4; ++m) {
    const double c = std::cos(m * angle);
    const double n = std::sin(m * angle);
    r[4 - m] = c * s[4 - m] + n * s[4 + m];
    r[4 + m] = -n * s[4 - m] + c * s[4 + m];
  }
  return r;
}

}  // namespace

const Sh& reference() {
  static const Sh a0 = [] {
    Sh a = Sh::Zero();
    a[4] = zonal_part;
    a[8] = twist_part;
    return a;
  }();
  return a0;
}

const ShMatrix& generator(int k) { return generators()[static_cast<std::size_t>(k)]; }

// The products of the generators with s, written out: they have 14, 14 and 8 entries.
Eigen::Matrix<double, 9, 3> tangent(const Sh& s) {
  static const double a = std::sqrt(2.0), b = std::sqrt(3.5), c = std::sqrt(4.5), d = std::sqrt(10.0);
  Eigen::Matrix<double, 9, 3> j;
  j.col(0) << -a * s[7], -b * s[6] - a * s[8], -c * s[5] - b * s[7], -d * s[4] - c * s[6], d * s[3], c * s[2],
      b * s[1] + c * s[3], a * s[0] + b * s[2], a * s[1];
  j.col(1) << a * s[1], b * s[2] - a * s[0], c * s[3] - b * s[1], -c * s[2], -d * s[5], d * s[4] - c * s[6],
      c * s[5] - b * s[7], b * s[6] - a * s[8], a * s[7];
  j.col(2) << 4 * s[8], 3 * s[7], 2 * s[6], s[5], 0, -s[3], -2 * s[2], -3 * s[1], -4 * s[0];
  return j;
}

Sh zonal(const Vec3& n) {
  const double x = n.x(), y = n.y(), z = n.z();
  const double xx = x * x, yy = y * y, zz = z * z;
  static const double s35 = std::sqrt(35.0), s5 = std::sqrt(5.0), h35 = std::sqrt(17.5) / 2, h5 = std::sqrt(2.5) / 2;
  Sh r;
  r << s35 / 2 * x * y * (xx - yy), h35 * y * z * (3 * xx - yy), s5 / 2 * x * y * (7 * zz - 1),
      h5 * y * z * (7 * zz - 3), (35 * zz * zz - 30 * zz + 3) / 8, h5 * x * z * (7 * zz - 3),
      s5 / 4 * (xx - yy) * (7 * zz - 1), h35 * x * z * (xx - 3 * yy), s35 / 8 * (xx * xx - 6 * xx * yy + yy * yy);
  return r;
}

Sh rotated(const Quaternion& r, const Sh& s) {
  static const ShMatrix turn_x = exponential(generator(0) * (M_PI / 2));  // D(R_x(90 degrees))
  const Vec3 e = r.toRotationMatrix().eulerAngles(2, 1, 2);
  // D(R_y(b)) = D(R_x(-90)) D(R_z(b)) D(R_x(90)).
  const Sh inner = turn_x.transpose() * rotated_about_z(e[1], turn_x * rotated_about_z(e[2], s));
  return rotated_about_z(e[0], inner);
}

Sh of_frame(const Quaternion& frame) {
  static const double scale = 2 / std::sqrt(21.0);
  const Mat3 r = frame.toRotationMatrix();
  return scale * (zonal(r.col(0)) + zonal(r.col(1)) + zonal(r.col(2)));
}

AlignedBasis aligned_basis(const Vec3& n) {
  AlignedBasis b;
  b.rotation = Quaternion::FromTwoVectors(Vec3::UnitZ(), n);
  b.offset = zonal_part * zonal(n);
  const Quaternion eighth(Eigen::AngleAxisd(M_PI / 8, Vec3::UnitZ()));
  b.twist.col(0) = (of_frame(b.rotation * eighth) - b.offset) / twist_part;
  b.twist.col(1) = (of_frame(b.rotation) - b.offset) / twist_part;
  return b;
}

}  // namespace hexfield::harmonics
