#pragma once

#include <Eigen/Core>

#include "hexfield/base/geometry.hpp"

/// Kernels on one 3x3 Jacobian J. As a vector J is row-major: entry 3 i + j is J(i, j). No heap, thread safe.
namespace hexfield::solve {

using Vec9 = Eigen::Matrix<double, 9, 1>;
using Mat9 = Eigen::Matrix<double, 9, 9, Eigen::RowMajor>;

/// The vector of a matrix.
inline Vec9 flat(const Mat3& m) {
  Vec9 v;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) v[3 * i + j] = m(i, j);
  return v;
}

/// J = U diag(sigma) V^T with orthogonal U, V and sigma > 0, in no order; only for invertible J.
/// One-sided Jacobi rotations: small singular values keep their relative accuracy.
struct Svd3 {
  Mat3 u;
  Vec3 sigma;
  Mat3 v;
};
Svd3 svd(const Mat3& jacobian);

/// Symmetric Dirichlet energy |J|^2 + |J^-1|^2 - 6 (Liu & Bommes 2023, eq. 5, less its minimum);
/// +infinity where det J <= 0.
double symmetric_dirichlet(const Mat3& jacobian);

/// Also the gradient and the positive-semidefinite part of the Hessian, from its analytic eigensystem
/// (diagonal and symmetric modes are always positive; antisymmetric ones are clamped at 0).
/// For det J <= 0 the value is infinite and the outputs are zero.
double symmetric_dirichlet(const Mat3& jacobian, Vec9& gradient, Mat9& hessian);

/// The same Hessian in factored form, H X = U (S o X' + C o X'^T) V^T with X' = U^T X V (o: entrywise): a third
/// of the memory of the 9x9 matrix, for matrix-free products.
struct FactoredHessian {
  Mat3 u, v;
  Mat3 same;     ///< S
  Mat3 crossed;  ///< C, zero diagonal
  Mat3 apply(const Mat3& x) const;
  Mat9 matrix() const;
};
/// Value, gradient (as a matrix) and factored positive part of the Hessian; zeros where the value is infinite.
double symmetric_dirichlet(const Mat3& jacobian, Mat3& gradient, FactoredHessian& hessian);

/// First t > 0 with det(J + t D) <= 0, infinity when there is none, 0 when det J <= 0. The result is the
/// positive side of the root: det > 0 on all of [0, result). Spec-lmff section 8, line search.
double first_inversion(const Mat3& jacobian, const Mat3& direction);

}  // namespace hexfield::solve
