#include "hexfield/solve/positivity.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace hexfield::solve {
namespace {

Mat3 symmetric_part(const Mat3& m) { return 0.5 * (m + m.transpose()); }

double shortfall(double eigenvalue, double delta) { return std::max(0.0, delta - eigenvalue); }

}  // namespace

double positivity_penalty(const Mat3& matrix, double delta) {
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(symmetric_part(matrix), Eigen::EigenvaluesOnly);
  double sum = 0;
  for (int i = 0; i < 3; ++i) sum += std::pow(shortfall(eigen.eigenvalues()[i], delta), 2);
  return sum;
}

double positivity_penalty(const Mat3& matrix, double delta, Vec9& gradient, Mat9& hessian) {
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(symmetric_part(matrix));
  const Vec3 l = eigen.eigenvalues();
  const Mat3& q = eigen.eigenvectors();
  double sum = 0;
  Vec3 slope, curvature;
  for (int i = 0; i < 3; ++i) {
    const double gap = shortfall(l[i], delta);
    sum += gap * gap;
    slope[i] = -2 * gap;
    curvature[i] = gap > 0 ? 2 : 0;
  }
  gradient = flat(q * slope.asDiagonal() * q.transpose());
  hessian.setZero();
  if (sum == 0) return 0;
  // Second derivative of a spectral function: divided differences of its slope on the mixed modes.
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      const Vec9 mode = flat(symmetric_part(q.col(i) * q.col(j).transpose()));
      const double difference = l[j] - l[i];
      const double divided = difference > 1e-12 ? (slope[j] - slope[i]) / difference : curvature[i];
      hessian += (i == j ? curvature[i] : 2 * divided) * mode * mode.transpose();
    }
  return sum;
}

}  // namespace hexfield::solve
