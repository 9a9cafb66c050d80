#pragma once

#include "hexfield/solve/untangling.hpp"
#include "jacobian_elements.hpp"

namespace hexfield {

/// Weighted sum of solve::untangle_energy() over tets.
class UntangleEnergy final : public JacobianElements {
 public:
  void set_epsilon(double epsilon) { epsilon_ = epsilon; }

 private:
  double of(const Mat3& m) const override { return solve::untangle_energy(m, epsilon_); }
  double of(const Mat3& m, solve::Vec9& gradient, solve::Mat9& hessian) const override {
    return solve::untangle_energy(m, epsilon_, gradient, hessian);
  }

  double epsilon_ = 1;
};

}  // namespace hexfield
