#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "spacing.hpp"

namespace hexfield {

/// What it costs to move the integer unknowns w of a map away from w0, all real unknowns following freely:
/// (w - w0)^T S (w - w0), from a quadratic energy of the map's own metric (spec-lmff section 9: frames are
/// the inverses of the map's Jacobians).
struct RoundingCost {
  Eigen::MatrixXd schur;      ///< S
  Eigen::MatrixXd following;  ///< derivative of the real unknowns with respect to w
};

/// Cost around the map with unknowns y, whose tets are positive. `edge` is the wanted length of parameter
/// steps in domain units; metrics further than a factor 5 from it are clamped. Serial, on the whole mesh.
RoundingCost rounding_cost(const TetMesh& mesh, const ConformingSpace& space, std::span<const double> y, double edge);

/// Integers near w0 of low cost that keep every spacing at 1 or more: relaxed solutions are rounded one
/// variable after the other, the closest first, each time with a re-solve (CubeCover); where one fits
/// neither way, those that conflict are rounded earlier in the next dive; then single and paired unit steps while they
/// lower the cost. nullopt when none was found.
std::optional<Eigen::VectorXd> round_integers(const RoundingCost& cost, const Eigen::VectorXd& w0,
                                              const std::vector<Spacing>& spacings);

}  // namespace hexfield
