#pragma once

#include <array>
#include <vector>

#include "hexfield/base/geometry.hpp"
#include "hexfield/solve/minimise.hpp"

namespace hexfield::solve {

/// One summand of an affine scalar: coefficient * y[unknown].
struct AffineEntry {
  PetscInt unknown;
  double coefficient;
};

/// constant + sum of entries; unknowns may repeat (their coefficients add up).
struct AffineScalar {
  std::vector<AffineEntry> entries;
  double constant = 0;
};

/// Row c is the gradient of the linear function that is 1 at corner c and 0 at the others: a map with corner
/// values f_c has the Jacobian J(k, b) = sum_c f_c[k] D(c, b).
using GradientOperator = Eigen::Matrix<double, 4, 3>;
GradientOperator gradient_operator(const std::array<Vec3, 4>& rest_shape);

/// Energies of maps of single tets whose 12 corner coordinates are affine in global unknowns.
///
/// Per element, with J = sum_c f_c (x) D.row(c) and an optional target frame F folded into J F:
///  * symmetric_dirichlet: weight (|J F|^2 + |(J F)^-1|^2 - 6), infinite where det <= 0;
///  * frame_fit: weight |J F - target|^2, quadratic, no domain limit.
/// For an energy relative to frames F whose columns map to the axes, the rest state is J F = identity.
class TetEnergy final : public EnergyTerm {
 public:
  enum class Kind { symmetric_dirichlet, frame_fit };
  explicit TetEnergy(Kind kind) : kind_(kind) {}

  /// Adds an element; corners[3 c + k] is coordinate k of corner c. Repeated unknowns are merged.
  /// `gradient` may be any 4x3 operator (gradient_operator() of a rest shape of any scale). det F > 0.
  void add(const GradientOperator& gradient, double weight, const std::array<AffineScalar, 12>& corners,
           const Mat3& frame = Mat3::Identity(), const Mat3& target = Mat3::Identity());
  /// J F of element e at its unknowns.
  Mat3 jacobian(std::size_t e, std::span<const double> y) const;

  std::size_t num_elements() const override { return weights_.size(); }
  std::span<const PetscInt> unknowns(std::size_t e) const override;
  double value(std::size_t e, std::span<const double> y) const override;
  double derivatives(std::size_t e, std::span<const double> y, std::span<double> gradient,
                     std::span<double> hessian) const override;
  double max_step(std::size_t e, std::span<const double> y, std::span<const double> dy) const override;

 private:
  struct Entry {
    int local;  // index into the unknowns of the element
    double coefficient;
  };
  std::span<const Entry> entries(std::size_t e, std::size_t scalar) const;
  Mat3 linear_part(std::size_t e, std::span<const double> y) const;

  Kind kind_;
  std::vector<GradientOperator> operators_;  // D F
  std::vector<double> weights_;
  std::vector<Mat3> offsets_;  // part of J F that does not depend on y
  std::vector<Mat3> targets_;  // frame_fit only
  std::vector<PetscInt> unknowns_;
  std::vector<std::size_t> first_unknown_{0};
  std::vector<Entry> entries_;
  std::vector<std::size_t> first_entry_{0};  // 12 per element
};

/// Weighted squared residuals of sparse affine rows: sum_r weight_r (row_r(y))^2. Quadratic.
class LeastSquares final : public EnergyTerm {
 public:
  void add(const AffineScalar& row, double weight);

  std::size_t num_elements() const override { return weights_.size(); }
  std::span<const PetscInt> unknowns(std::size_t e) const override;
  double value(std::size_t e, std::span<const double> y) const override;
  double derivatives(std::size_t e, std::span<const double> y, std::span<double> gradient,
                     std::span<double> hessian) const override;

 private:
  std::vector<double> weights_;
  std::vector<double> constants_;
  std::vector<PetscInt> unknowns_;
  std::vector<double> coefficients_;
  std::vector<std::size_t> first_{0};
};

}  // namespace hexfield::solve
