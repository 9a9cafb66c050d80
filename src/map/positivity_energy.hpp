#pragma once

#include "hexfield/solve/positivity.hpp"
#include "jacobian_elements.hpp"

namespace hexfield {

/// Weighted sum of solve::positivity_penalty() over tets, times a penalty factor.
class PositivityEnergy final : public JacobianElements {
 public:
  explicit PositivityEnergy(double delta) : delta_(delta) {}
  void set_factor(double factor) { factor_ = factor; }

 private:
  double of(const Mat3& m) const override { return factor_ * solve::positivity_penalty(m, delta_); }
  double of(const Mat3& m, solve::Vec9& gradient, solve::Mat9& hessian) const override {
    const double value = factor_ * solve::positivity_penalty(m, delta_, gradient, hessian);
    gradient *= factor_;
    hessian *= factor_;
    return value;
  }

  double delta_;
  double factor_ = 1;
};

}  // namespace hexfield
