#include "hexfield/solve/untangling.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace hexfield::solve {
namespace {

Vec9 cofactor(const Mat3& j) {
  Mat3 c;
  for (int i = 0; i < 3; ++i) c.row(i) = j.row((i + 1) % 3).cross(j.row((i + 2) % 3));
  return flat(c);
}

struct Regularised {
  double a, a1, a2;  // chi^(-2/3) and its derivatives by D
  double b, b1, b2;  // (D^2 + 1) / chi
};

Regularised regularise(double d, double epsilon) {
  const double root = std::hypot(d, epsilon);
  // For d < 0 the sum cancels.
  const double chi = d > 0 ? 0.5 * (d + root) : 0.5 * epsilon * epsilon / (root - d);
  const double chi1 = chi / root;
  const double chi2 = 0.5 * epsilon * epsilon / (root * root * root);
  Regularised r{};
  r.a = std::pow(chi, -2.0 / 3);
  r.a1 = -2.0 / 3 * r.a / chi * chi1;
  r.a2 = 10.0 / 9 * r.a / (chi * chi) * chi1 * chi1 - 2.0 / 3 * r.a / chi * chi2;
  const double n = d * d + 1;
  r.b = n / chi;
  r.b1 = 2 * d / chi - n * chi1 / (chi * chi);
  r.b2 = 2 / chi - 4 * d * chi1 / (chi * chi) - n * chi2 / (chi * chi) + 2 * n * chi1 * chi1 / (chi * chi * chi);
  return r;
}

}  // namespace

double untangle_energy(const Mat3& jacobian, double epsilon) {
  const Regularised r = regularise(jacobian.determinant(), epsilon);
  return jacobian.squaredNorm() * r.a + r.b;
}

double untangle_energy(const Mat3& jacobian, double epsilon, Vec9& gradient, Mat9& hessian) {
  const Regularised r = regularise(jacobian.determinant(), epsilon);
  const double n = jacobian.squaredNorm();
  const Vec9 j = flat(jacobian);
  const Vec9 c = cofactor(jacobian);
  gradient = 2 * r.a * j + (n * r.a1 + r.b1) * c;
  const Vec9 along = n > 0 ? Vec9(j / std::sqrt(n)) : Vec9(Vec9::Zero());
  Eigen::Matrix2d block;
  block << 2 * r.a, 2 * r.a1 * std::sqrt(n), 2 * r.a1 * std::sqrt(n), n * r.a2 + r.b2;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(block);
  hessian = 2 * r.a * (Mat9::Identity() - along * along.transpose());
  for (int k = 0; k < 2; ++k) {
    const Vec9 mode = eigen.eigenvectors()(0, k) * along + eigen.eigenvectors()(1, k) * c;
    hessian += std::max(0.0, eigen.eigenvalues()[k]) * mode * mode.transpose();
  }
  return n * r.a + r.b;
}

}  // namespace hexfield::solve
