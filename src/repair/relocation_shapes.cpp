#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "hexfield/base/error.hpp"
#include "hexfield/repair/relocation_energy.hpp"

namespace hexfield {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

template <int N>
using Corners = Eigen::Matrix<double, N, N + 1>;
template <int N>
using Square = Eigen::Matrix<double, N, N>;

// Rows r_c with J = sum_c x_c r_c the Jacobian from the regular simplex of edge length 1.
const Eigen::Matrix<double, 4, 3>& regular_tet() {
  static const Eigen::Matrix<double, 4, 3> rows = [] {
    Mat3 edges;
    edges << 1, 0.5, 0.5, 0, std::sqrt(3.0) / 2, std::sqrt(3.0) / 6, 0, 0, std::sqrt(2.0 / 3.0);
    const Mat3 inverse = edges.inverse();
    Eigen::Matrix<double, 4, 3> d;
    d.bottomRows<3>() = inverse;
    d.row(0) = -inverse.colwise().sum();
    return d;
  }();
  return rows;
}

const Eigen::Matrix<double, 3, 2>& regular_triangle() {
  static const Eigen::Matrix<double, 3, 2> rows = [] {
    Eigen::Matrix2d edges;
    edges << 1, 0.5, 0, std::sqrt(3.0) / 2;
    const Eigen::Matrix2d inverse = edges.inverse();
    Eigen::Matrix<double, 3, 2> d;
    d.bottomRows<2>() = inverse;
    d.row(0) = -inverse.colwise().sum();
    return d;
  }();
  return rows;
}

// E = log tr(J^T J) - power log det J.
template <int N>
double shape(const Square<N>& j, double power) {
  const double det = j.determinant();
  return det > 0 ? std::log(j.squaredNorm()) - power * std::log(det) : infinity;
}

// For dJ = dx r_c^T: dE = dx . (2 J / tr - power J^-T) r_c, and the block of the Hessian at corners c and d is
// 2 / tr (r_c . r_d) I - 4 / tr^2 a_c a_d^T + power b_d b_c^T with a_c = J r_c, b_c = J^-T r_c.
template <int N>
struct ShapeDerivatives {
  double value;
  Eigen::Matrix<double, N, N + 1> gradient;
  std::array<std::array<Square<N>, N + 1>, N + 1> hessian;

  ShapeDerivatives(const Square<N>& j, const Eigen::Matrix<double, N + 1, N>& rows, double power)
      : value(shape<N>(j, power)) {
    if (!std::isfinite(value)) return;
    const double trace = j.squaredNorm();
    const Eigen::Matrix<double, N, N + 1> a = j * rows.transpose();
    const Eigen::Matrix<double, N, N + 1> b = j.inverse().transpose() * rows.transpose();
    gradient = 2 / trace * a - power * b;
    for (int c = 0; c <= N; ++c)
      for (int d = 0; d <= N; ++d)
        hessian[static_cast<std::size_t>(c)][static_cast<std::size_t>(d)] =
            2 / trace * rows.row(c).dot(rows.row(d)) * Square<N>::Identity() -
            4 / (trace * trace) * a.col(c) * a.col(d).transpose() + power * b.col(d) * b.col(c).transpose();
  }
};

Mat3 tet_jacobian(const std::array<Vec3, 4>& x) {
  Mat3 j = Mat3::Zero();
  for (std::size_t c = 0; c < 4; ++c) j += x[c] * regular_tet().row(static_cast<Eigen::Index>(c));
  return j;
}

using Plane = Eigen::Matrix<double, 2, 3>;

// Rows are a basis of the plane, right-handed with the normal.
Plane plane_of(const Vec3& normal) {
  const Vec3 u = normal.unitOrthogonal();
  Plane plane;
  plane << u.transpose(), normal.cross(u).transpose();
  return plane;
}

Eigen::Matrix2d triangle_jacobian(const std::array<Vec3, 3>& x, const Plane& plane) {
  Eigen::Matrix2d j = Eigen::Matrix2d::Zero();
  for (std::size_t c = 0; c < 3; ++c) j += plane * x[c] * regular_triangle().row(static_cast<Eigen::Index>(c));
  return j;
}

}  // namespace

double tet_shape(const std::array<Vec3, 4>& x) { return shape<3>(tet_jacobian(x), 2.0 / 3.0); }

TetShape tet_shape_derivatives(const std::array<Vec3, 4>& x) {
  const ShapeDerivatives<3> s(tet_jacobian(x), regular_tet(), 2.0 / 3.0);
  TetShape out;
  out.value = s.value;
  if (!std::isfinite(s.value)) return out;
  for (std::size_t c = 0; c < 4; ++c) out.gradient[c] = s.gradient.col(static_cast<Eigen::Index>(c));
  out.hessian = s.hessian;
  return out;
}

CornerShape tet_corner_derivatives(const std::array<Vec3, 4>& x, int corner) {
  const Mat3 j = tet_jacobian(x);
  CornerShape out;
  out.value = shape<3>(j, 2.0 / 3.0);
  if (!std::isfinite(out.value)) return out;
  const double trace = j.squaredNorm();
  const Vec3 row = regular_tet().row(corner).transpose();
  const Vec3 a = j * row;
  const Vec3 b = j.inverse().transpose() * row;
  out.gradient = 2 / trace * a - 2.0 / 3.0 * b;
  out.hessian = 2 / trace * row.squaredNorm() * Mat3::Identity() - 4 / (trace * trace) * a * a.transpose() +
                2.0 / 3.0 * b * b.transpose();
  return out;
}

double triangle_shape(const std::array<Vec3, 3>& x, const Vec3& normal) {
  return shape<2>(triangle_jacobian(x, plane_of(normal)), 1.0);
}

TriangleShape triangle_shape_derivatives(const std::array<Vec3, 3>& x, const Vec3& normal) {
  const Plane plane = plane_of(normal);
  const ShapeDerivatives<2> s(triangle_jacobian(x, plane), regular_triangle(), 1.0);
  TriangleShape out;
  out.value = s.value;
  if (!std::isfinite(s.value)) return out;
  for (std::size_t c = 0; c < 3; ++c) {
    out.gradient[c] = plane.transpose() * s.gradient.col(static_cast<Eigen::Index>(c));
    for (std::size_t d = 0; d < 3; ++d) out.hessian[c][d] = plane.transpose() * s.hessian[c][d] * plane;
  }
  return out;
}

void project_to_semidefinite(Eigen::Ref<Eigen::MatrixXd> matrix) {
  constexpr int most = 12;  // unknowns of a tet: no memory from the heap
  using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most, most>;
  require(matrix.rows() <= most, "An element of the relocation has more than twelve unknowns.");
  if (matrix.rows() == 0) return;
  const Small given = matrix;
  if (Eigen::LLT<Small>(given).info() == Eigen::Success) return;
  const Eigen::SelfAdjointEigenSolver<Small> eigen(given);
  const Small scaled = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).asDiagonal();
  matrix.noalias() = scaled * eigen.eigenvectors().transpose();
}

}  // namespace hexfield
