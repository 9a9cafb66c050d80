#pragma once

#include <array>
#include <vector>

#include "hexfield/base/geometry.hpp"

namespace hexfield::hex {

/// How corners are weighed against each other.
struct EnergyShape {
  double power = 1;         ///< of the inverse scaled Jacobian
  double shape_weight = 0;  ///< of the mean ratio
  double epsilon = 0;       ///< regularisation of determinants, for edges in units of the hex
};

/// One corner of a hex: its vertex and its three neighbours in right-handed order.
struct Corner {
  std::array<Vec3, 4> points;
  double scale = 1;   ///< length that edges of the hex are divided by
  int role = 0;       ///< which of the points moves
  bool keep = false;  ///< the hex is positive and has to stay so
};

/// Determinant of the three unit edge vectors.
double scaled_jacobian(const Corner& corner);

/// (|e1| |e2| |e3| / chi)^power + shape_weight (|e1|^2 + |e2|^2 + |e3|^2) / (3 chi^(2/3)) with the regularised
/// determinant chi = (det + sqrt(epsilon^2 + det^2)) / 2; infinite where chi is not positive. Adds the
/// derivative by the moving point to `gradient`.
double corner_energy(const Corner& corner, const EnergyShape& shape, Vec3* gradient);

/// Sum over corners with their moving point at x.
double patch_energy(std::vector<Corner>& patch, const Vec3& x, const EnergyShape& shape, Vec3* gradient);

}  // namespace hexfield::hex
