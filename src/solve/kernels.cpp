#include "hexfield/solve/kernels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hexfield::solve {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Rotates columns p and q of a (and v) such that those of a become orthogonal; false if they already are.
bool orthogonalise(Mat3& a, Mat3& v, int p, int q) {
  const double alpha = a.col(p).squaredNorm();
  const double beta = a.col(q).squaredNorm();
  const double gamma = a.col(p).dot(a.col(q));
  if (gamma * gamma <= 1e-32 * alpha * beta) return false;
  const double zeta = (beta - alpha) / (2 * gamma);
  const double t = (zeta >= 0 ? 1.0 : -1.0) / (std::abs(zeta) + std::sqrt(1 + zeta * zeta));
  const double c = 1 / std::sqrt(1 + t * t);
  const double s = c * t;
  const Vec3 ap = a.col(p);
  a.col(p) = c * ap - s * a.col(q);
  a.col(q) = s * ap + c * a.col(q);
  const Vec3 vp = v.col(p);
  v.col(p) = c * vp - s * v.col(q);
  v.col(q) = s * vp + c * v.col(q);
  return true;
}

// hessian += a (x) b, where (x) is the Kronecker product that matches the row-major vector of J.
void add_kronecker(const Mat3& a, const Mat3& b, Mat9& hessian) {
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) hessian.block<3, 3>(3 * i, 3 * k) += a(i, k) * b;
}

// Cofactor matrix: d det / dJ.
Mat3 cofactor(const Mat3& j) {
  Mat3 c;
  c.row(0) = j.row(1).cross(j.row(2));
  c.row(1) = j.row(2).cross(j.row(0));
  c.row(2) = j.row(0).cross(j.row(1));
  return c;
}

struct Cubic {
  double c0, c1, c2, c3;
  double operator()(double t) const { return c0 + t * (c1 + t * (c2 + t * c3)); }
  double slope(double t) const { return c1 + t * (2 * c2 + t * 3 * c3); }
};

// Root of p in (low, high] with p(low) > 0 >= p(high), from below; Newton kept inside the bracket.
double bracketed_root(const Cubic& p, double low, double high) {
  double t = 0.5 * (low + high);
  for (int i = 0; i < 200 && high - low > 4e-16 * high; ++i) {
    (p(t) > 0 ? low : high) = t;
    const double slope = p.slope(t);
    const double newton = t - p(t) / slope;
    // A nudge to the far side makes the other end of the bracket move as well.
    t = slope < 0 && newton > low && newton < high && i % 3 != 2 ? newton : 0.5 * (low + high);
  }
  return low;
}

// Positive stationary points of p, ascending; returns how many.
int stationary_points(const Cubic& p, std::array<double, 2>& points) {
  const double a = 3 * p.c3;
  const double b = 2 * p.c2;
  const double discriminant = b * b - 4 * a * p.c1;
  if (discriminant < 0) return 0;
  const double q = -0.5 * (b + (b >= 0 ? 1.0 : -1.0) * std::sqrt(discriminant));
  int n = 0;
  if (a != 0 && q / a > 0) points[static_cast<std::size_t>(n++)] = q / a;
  if (q != 0 && p.c1 / q > 0) points[static_cast<std::size_t>(n++)] = p.c1 / q;
  if (n == 2 && points[1] < points[0]) std::swap(points[0], points[1]);
  return n;
}

double first_positive_root(const Cubic& p) {
  std::array<double, 2> points{};
  const int n = stationary_points(p, points);
  double low = 0;
  for (int i = 0; i < n; ++i) {
    const double high = points[static_cast<std::size_t>(i)];
    if (!std::isfinite(high)) return infinity;
    if (p(high) <= 0) return bracketed_root(p, low, high);
    low = high;
  }
  // Monotone from here on.
  const double leading = p.c3 != 0 ? p.c3 : (p.c2 != 0 ? p.c2 : p.c1);
  if (leading >= 0) return infinity;
  double high = std::max(1.0, 2 * low);
  while (p(high) > 0) {
    high *= 2;
    if (!(high < 1e100)) return infinity;
  }
  return bracketed_root(p, low, high);
}

}  // namespace

Svd3 svd(const Mat3& jacobian) {
  Svd3 r{jacobian, Vec3::Zero(), Mat3::Identity()};
  for (int sweep = 0; sweep < 30; ++sweep) {
    const bool a = orthogonalise(r.u, r.v, 0, 1);
    const bool b = orthogonalise(r.u, r.v, 0, 2);
    const bool c = orthogonalise(r.u, r.v, 1, 2);
    if (!a && !b && !c) break;
  }
  for (int i = 0; i < 3; ++i) {
    r.sigma[i] = r.u.col(i).norm();
    r.u.col(i) /= r.sigma[i];
  }
  return r;
}

double symmetric_dirichlet(const Mat3& jacobian) {
  const Mat3 c = cofactor(jacobian);
  const double det = jacobian.row(0).dot(c.row(0));
  if (!(det > 0)) return infinity;
  const double value = jacobian.squaredNorm() + c.squaredNorm() / (det * det) - 6;
  return std::isfinite(value) ? value : infinity;
}

Mat3 FactoredHessian::apply(const Mat3& x) const {
  const Mat3 inner = u.transpose() * x * v;
  const Mat3 scaled = same.cwiseProduct(inner) + crossed.cwiseProduct(inner.transpose());
  return u * scaled * v.transpose();
}

Mat9 FactoredHessian::matrix() const {
  Mat9 result = Mat9::Zero();
  std::array<Mat3, 3> outer;
  for (int i = 0; i < 3; ++i) outer[static_cast<std::size_t>(i)] = v.col(i) * v.col(i).transpose();
  for (int i = 0; i < 3; ++i) {
    const Mat3 along = same(i, 0) * outer[0] + same(i, 1) * outer[1] + same(i, 2) * outer[2];
    add_kronecker(u.col(i) * u.col(i).transpose(), along, result);
    for (int j = 0; j < 3; ++j)
      if (i != j)
        add_kronecker(crossed(i, j) * u.col(i) * u.col(j).transpose(), v.col(j) * v.col(i).transpose(), result);
  }
  return result;
}

double symmetric_dirichlet(const Mat3& jacobian, Mat3& gradient, FactoredHessian& hessian) {
  gradient.setZero();
  hessian = {Mat3::Identity(), Mat3::Identity(), Mat3::Zero(), Mat3::Zero()};
  const double value = symmetric_dirichlet(jacobian);
  if (value == infinity) return value;
  const Svd3 s = svd(jacobian);
  hessian.u = s.u;
  hessian.v = s.v;
  const Vec3 inverse = s.sigma.cwiseInverse();
  const Vec3 inverse3 = inverse.cwiseProduct(inverse).cwiseProduct(inverse);
  for (int i = 0; i < 3; ++i) {
    gradient += (2 * (s.sigma[i] - inverse3[i])) * s.u.col(i) * s.v.col(i).transpose();
    hessian.same(i, i) = 2 + 6 * inverse[i] * inverse3[i];
    for (int j = 0; j < i; ++j) {
      const double a = s.sigma[i];
      const double b = s.sigma[j];
      const double scale = 2 * inverse3[i] * inverse3[j];
      const double symmetric = 2 + scale * (a * a + a * b + b * b);
      const double antisymmetric = std::max(0.0, 2 - scale * (a * a - a * b + b * b));
      hessian.same(i, j) = hessian.same(j, i) = 0.5 * (symmetric + antisymmetric);
      hessian.crossed(i, j) = hessian.crossed(j, i) = 0.5 * (symmetric - antisymmetric);
    }
  }
  return value;
}

double symmetric_dirichlet(const Mat3& jacobian, Vec9& gradient, Mat9& hessian) {
  Mat3 g;
  FactoredHessian h;
  const double value = symmetric_dirichlet(jacobian, g, h);
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(gradient.data()) = g;
  hessian = h.matrix();
  return value;
}

double first_inversion(const Mat3& jacobian, const Mat3& direction) {
  const Mat3 cj = cofactor(jacobian);
  const Mat3 cd = cofactor(direction);
  const Cubic p{jacobian.row(0).dot(cj.row(0)), cj.cwiseProduct(direction).sum(), cd.cwiseProduct(jacobian).sum(),
                direction.row(0).dot(cd.row(0))};
  if (!(p.c0 > 0)) return 0;
  return first_positive_root(p);
}

}  // namespace hexfield::solve
