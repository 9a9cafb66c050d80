#include "jacobian_elements.hpp"

#include <algorithm>

namespace hexfield {
namespace {

using solve::flat;
using solve::Mat9;
using solve::Vec9;

}  // namespace

void JacobianElements::add(const solve::GradientOperator& gradient, double weight,
                           const std::array<solve::AffineScalar, 12>& corners, const Mat3& frame, const Mat3&) {
  const solve::GradientOperator d = gradient * frame;
  Mat3 offset = Mat3::Zero();
  const std::size_t first = unknowns_.size();
  for (std::size_t x = 0; x < 12; ++x) {
    const auto corner = static_cast<Eigen::Index>(x / 3);
    const auto axis = static_cast<Eigen::Index>(x % 3);
    offset.row(axis) += corners[x].constant * d.row(corner);
    for (const solve::AffineEntry& entry : corners[x].entries) {
      const auto begin = unknowns_.begin() + static_cast<std::ptrdiff_t>(first);
      auto place = std::find(begin, unknowns_.end(), entry.unknown);
      const auto k = static_cast<std::size_t>(place - unknowns_.begin());
      if (place == unknowns_.end()) {
        unknowns_.push_back(entry.unknown);
        columns_.emplace_back(Vec9::Zero());
      }
      columns_[k].segment<3>(3 * axis) += entry.coefficient * d.row(corner).transpose();
    }
  }
  first_.push_back(unknowns_.size());
  weights_.push_back(weight);
  offsets_.push_back(offset);
}

Mat3 JacobianElements::matrix(std::size_t e, std::span<const double> y) const {
  Vec9 j = flat(offsets_[e]);
  for (std::size_t k = 0; k < y.size(); ++k) j += y[k] * columns_[first_[e] + k];
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(j.data());
}

double JacobianElements::value(std::size_t e, std::span<const double> y) const {
  return weights_[e] * of(matrix(e, y));
}

double JacobianElements::derivatives(std::size_t e, std::span<const double> y, std::span<double> gradient,
                                     std::span<double> hessian) const {
  Vec9 g;
  Mat9 h;
  const double value = of(matrix(e, y), g, h);
  const std::size_t n = y.size();
  for (std::size_t a = 0; a < n; ++a) {
    const Vec9& column = columns_[first_[e] + a];
    gradient[a] = weights_[e] * g.dot(column);
    const Vec9 image = weights_[e] * (h * column);
    for (std::size_t b = 0; b < n; ++b) hessian[a * n + b] = image.dot(columns_[first_[e] + b]);
  }
  return weights_[e] * value;
}

}  // namespace hexfield
