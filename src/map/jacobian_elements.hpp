#pragma once

#include <array>
#include <vector>

#include "hexfield/solve/kernels.hpp"
#include "hexfield/solve/tet_energy.hpp"

namespace hexfield {

/// Weighted sum over tets of a function of J F, where J is the Jacobian of a map whose corner coordinates are affine
/// in global unknowns and F a frame per tet (as TetEnergy). What the function is, derived classes say.
class JacobianElements : public solve::EnergyTerm {
 public:
  void add(const solve::GradientOperator& gradient, double weight, const std::array<solve::AffineScalar, 12>& corners,
           const Mat3& frame = Mat3::Identity(), const Mat3& target = Mat3::Identity());

  std::size_t num_elements() const override { return weights_.size(); }
  std::span<const PetscInt> unknowns(std::size_t e) const override {
    return {&unknowns_[first_[e]], first_[e + 1] - first_[e]};
  }
  double value(std::size_t e, std::span<const double> y) const override;
  double derivatives(std::size_t e, std::span<const double> y, std::span<double> gradient,
                     std::span<double> hessian) const override;

 private:
  /// The function of J F, with its gradient and a positive-semidefinite Hessian in the second form.
  virtual double of(const Mat3& matrix) const = 0;
  virtual double of(const Mat3& matrix, solve::Vec9& gradient, solve::Mat9& hessian) const = 0;

  Mat3 matrix(std::size_t e, std::span<const double> y) const;

  std::vector<double> weights_;
  std::vector<Mat3> offsets_;
  std::vector<PetscInt> unknowns_;
  std::vector<solve::Vec9> columns_;  // derivative of J F by each unknown
  std::vector<std::size_t> first_{0};
};

}  // namespace hexfield
