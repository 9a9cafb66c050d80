#include "hexfield/solve/tet_energy.hpp"

#include <algorithm>
#include <map>

#include "hexfield/base/error.hpp"
#include "hexfield/solve/kernels.hpp"

namespace hexfield::solve {
namespace {

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using Vec12 = Eigen::Matrix<double, 12, 1>;
using Mat12 = Eigen::Matrix<double, 12, 12, Eigen::RowMajor>;

// Chain rule from J (row-major 9) to corner coordinates (3 c + k): J(k, b) = sum_c x[3 c + k] d(c, b).
Vec12 corner_gradient(const GradientOperator& d, const Vec9& g) {
  const Eigen::Matrix<double, 4, 3> x = d * Eigen::Map<const RowMajor3>(g.data()).transpose();
  Vec12 result;
  for (int c = 0; c < 4; ++c) result.segment<3>(3 * c) = x.row(c).transpose();
  return result;
}

Mat12 corner_hessian(const GradientOperator& d, const Mat9& h) {
  Mat12 result;
  for (int k = 0; k < 3; ++k)
    for (int l = k; l < 3; ++l) {
      const Eigen::Matrix4d block = d * (h.block<3, 3>(3 * k, 3 * l) * d.transpose());
      for (int a = 0; a < 4; ++a)
        for (int b = 0; b < 4; ++b) {
          result(3 * a + k, 3 * b + l) = block(a, b);
          result(3 * b + l, 3 * a + k) = block(a, b);
        }
    }
  return result;
}

}  // namespace

GradientOperator gradient_operator(const std::array<Vec3, 4>& rest_shape) {
  Mat3 edges;
  for (int c = 0; c < 3; ++c) edges.col(c) = rest_shape[static_cast<std::size_t>(c) + 1] - rest_shape[0];
  const Mat3 inverse = edges.inverse();
  GradientOperator d;
  d.bottomRows<3>() = inverse;
  d.row(0) = -inverse.colwise().sum();
  return d;
}

void TetEnergy::add(const GradientOperator& gradient, double weight, const std::array<AffineScalar, 12>& corners,
                    const Mat3& frame, const Mat3& target) {
  std::map<PetscInt, int> local;
  for (const AffineScalar& scalar : corners)
    for (const AffineEntry& entry : scalar.entries) local.emplace(entry.unknown, 0);
  int n = 0;
  for (auto& [unknown, index] : local) {
    index = n++;
    unknowns_.push_back(unknown);
  }
  first_unknown_.push_back(unknowns_.size());
  const GradientOperator d = gradient * frame;
  Mat3 offset = Mat3::Zero();
  for (std::size_t s = 0; s < 12; ++s) {
    std::map<int, double> merged;
    for (const AffineEntry& entry : corners[s].entries) merged[local.at(entry.unknown)] += entry.coefficient;
    for (const auto& [index, coefficient] : merged)
      if (coefficient != 0) entries_.push_back({index, coefficient});
    first_entry_.push_back(entries_.size());
    offset.row(static_cast<Eigen::Index>(s % 3)) += corners[s].constant * d.row(static_cast<Eigen::Index>(s / 3));
  }
  operators_.push_back(d);
  weights_.push_back(weight);
  offsets_.push_back(offset);
  if (kind_ == Kind::frame_fit) targets_.push_back(target);
}

std::span<const PetscInt> TetEnergy::unknowns(std::size_t e) const {
  return {unknowns_.data() + first_unknown_[e], first_unknown_[e + 1] - first_unknown_[e]};
}

std::span<const TetEnergy::Entry> TetEnergy::entries(std::size_t e, std::size_t scalar) const {
  const std::size_t i = 12 * e + scalar;
  return {entries_.data() + first_entry_[i], first_entry_[i + 1] - first_entry_[i]};
}

Mat3 TetEnergy::linear_part(std::size_t e, std::span<const double> y) const {
  Mat3 j = Mat3::Zero();
  for (std::size_t s = 0; s < 12; ++s) {
    double x = 0;
    for (const Entry& entry : entries(e, s)) x += entry.coefficient * y[static_cast<std::size_t>(entry.local)];
    j.row(static_cast<Eigen::Index>(s % 3)) += x * operators_[e].row(static_cast<Eigen::Index>(s / 3));
  }
  return j;
}

Mat3 TetEnergy::jacobian(std::size_t e, std::span<const double> y) const { return offsets_[e] + linear_part(e, y); }

double TetEnergy::value(std::size_t e, std::span<const double> y) const {
  const Mat3 j = jacobian(e, y);
  return weights_[e] * (kind_ == Kind::frame_fit ? (j - targets_[e]).squaredNorm() : symmetric_dirichlet(j));
}

double TetEnergy::derivatives(std::size_t e, std::span<const double> y, std::span<double> gradient,
                              std::span<double> hessian) const {
  const Mat3 j = jacobian(e, y);
  Vec9 g;
  Mat9 h;
  double value = 0;
  if (kind_ == Kind::frame_fit) {
    const RowMajor3 residual = j - targets_[e];
    value = residual.squaredNorm();
    g = 2 * Eigen::Map<const Vec9>(residual.data());
    h = 2 * Mat9::Identity();
  } else {
    value = symmetric_dirichlet(j, g, h);
  }
  const Vec12 g12 = weights_[e] * corner_gradient(operators_[e], g);
  const Mat12 h12 = weights_[e] * corner_hessian(operators_[e], h);
  const std::size_t n = first_unknown_[e + 1] - first_unknown_[e];
  std::fill(gradient.begin(), gradient.end(), 0.0);
  std::fill(hessian.begin(), hessian.end(), 0.0);
  for (std::size_t a = 0; a < 12; ++a)
    for (const Entry& i : entries(e, a)) {
      gradient[static_cast<std::size_t>(i.local)] += i.coefficient * g12[static_cast<Eigen::Index>(a)];
      double* row = hessian.data() + static_cast<std::size_t>(i.local) * n;
      for (std::size_t b = 0; b < 12; ++b) {
        const double c = i.coefficient * h12(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
        for (const Entry& k : entries(e, b)) row[k.local] += c * k.coefficient;
      }
    }
  return weights_[e] * value;
}

double TetEnergy::max_step(std::size_t e, std::span<const double> y, std::span<const double> dy) const {
  if (kind_ == Kind::frame_fit) return std::numeric_limits<double>::infinity();
  return first_inversion(jacobian(e, y), linear_part(e, dy));
}

void LeastSquares::add(const AffineScalar& row, double weight) {
  std::map<PetscInt, double> merged;
  for (const AffineEntry& entry : row.entries) merged[entry.unknown] += entry.coefficient;
  for (const auto& [unknown, coefficient] : merged) {
    unknowns_.push_back(unknown);
    coefficients_.push_back(coefficient);
  }
  first_.push_back(unknowns_.size());
  constants_.push_back(row.constant);
  weights_.push_back(weight);
}

std::span<const PetscInt> LeastSquares::unknowns(std::size_t e) const {
  return {unknowns_.data() + first_[e], first_[e + 1] - first_[e]};
}

double LeastSquares::value(std::size_t e, std::span<const double> y) const {
  double r = constants_[e];
  for (std::size_t i = 0; i < y.size(); ++i) r += coefficients_[first_[e] + i] * y[i];
  return weights_[e] * r * r;
}

double LeastSquares::derivatives(std::size_t e, std::span<const double> y, std::span<double> gradient,
                                 std::span<double> hessian) const {
  const double* c = coefficients_.data() + first_[e];
  double r = constants_[e];
  for (std::size_t i = 0; i < y.size(); ++i) r += c[i] * y[i];
  for (std::size_t i = 0; i < y.size(); ++i) {
    gradient[i] = 2 * weights_[e] * r * c[i];
    for (std::size_t k = 0; k < y.size(); ++k) hessian[i * y.size() + k] = 2 * weights_[e] * c[i] * c[k];
  }
  return weights_[e] * r * r;
}

}  // namespace hexfield::solve
