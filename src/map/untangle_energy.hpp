#pragma once

#include <array>
#include <vector>

#include "hexfield/solve/tet_energy.hpp"

namespace hexfield {

/// Weighted sum of solve::untangle_energy() over tets whose corner coordinates are affine in global unknowns (as
/// TetEnergy).
class UntangleEnergy final : public solve::EnergyTerm {
 public:
  void add(const solve::GradientOperator& gradient, double weight, const std::array<solve::AffineScalar, 12>& corners,
           const Mat3& frame = Mat3::Identity(), const Mat3& target = Mat3::Identity());
  void set_epsilon(double epsilon) { epsilon_ = epsilon; }

  std::size_t num_elements() const override { return weights_.size(); }
  std::span<const PetscInt> unknowns(std::size_t e) const override {
    return {&unknowns_[first_[e]], first_[e + 1] - first_[e]};
  }
  double value(std::size_t e, std::span<const double> y) const override;
  double derivatives(std::size_t e, std::span<const double> y, std::span<double> gradient,
                     std::span<double> hessian) const override;

 private:
  Mat3 jacobian(std::size_t e, std::span<const double> y) const;

  double epsilon_ = 1;
  std::vector<double> weights_;
  std::vector<Mat3> offsets_;
  std::vector<PetscInt> unknowns_;
  std::vector<Eigen::Matrix<double, 9, 1>> columns_;  // derivative of J by each unknown
  std::vector<std::size_t> first_{0};
};

}  // namespace hexfield
