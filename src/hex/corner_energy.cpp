#include "corner_energy.hpp"

#include <cmath>
#include <limits>

namespace hexfield::hex {

double scaled_jacobian(const Corner& corner) {
  const auto edge = [&](std::size_t k) -> Vec3 {
    const Vec3 e = corner.points[k] - corner.points[0];
    return e / std::max(e.norm(), 1e-300);
  };
  return edge(1).cross(edge(2)).dot(edge(3));
}

double corner_energy(const Corner& corner, const EnergyShape& shape, Vec3* gradient) {
  const double unit = 1 / corner.scale;
  const Vec3 e[3] = {(corner.points[1] - corner.points[0]) * unit, (corner.points[2] - corner.points[0]) * unit,
                     (corner.points[3] - corner.points[0]) * unit};
  const Vec3 cofactor[3] = {e[1].cross(e[2]), e[2].cross(e[0]), e[0].cross(e[1])};
  const double det = e[0].dot(cofactor[0]);
  const double root = std::sqrt(shape.epsilon * shape.epsilon + det * det);
  // For negative determinants the sum cancels; this form does not.
  const double chi = det >= 0 ? (det + root) / 2 : shape.epsilon * shape.epsilon / (2 * (root - det));
  const double squares[3] = {e[0].squaredNorm(), e[1].squaredNorm(), e[2].squaredNorm()};
  if (!(chi > 0) || squares[0] == 0 || squares[1] == 0 || squares[2] == 0)
    return std::numeric_limits<double>::infinity();
  const double inverse = std::sqrt(squares[0] * squares[1] * squares[2]) / chi;
  const double angle = std::pow(inverse, shape.power);
  const double third = std::cbrt(chi);
  const double ratio = shape.shape_weight * (squares[0] + squares[1] + squares[2]) / (3 * third * third);
  if (gradient != nullptr) {
    const double dlog = root > 0 ? chi / root : 0;  // chi' = chi / root, so chi' / chi = 1 / root
    const double by_det = dlog > 0 ? -(shape.power * angle + ratio * 2 / 3) / root : 0;
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 g = (shape.power * angle / squares[k] + 2 * shape.shape_weight / (3 * third * third)) * e[k] +
                     by_det * cofactor[k];
      if (corner.role == 0)
        sum -= g;
      else if (corner.role == static_cast<int>(k) + 1)
        sum = g;
    }
    *gradient += sum * unit;
  }
  return angle + ratio;
}

double patch_energy(std::vector<Corner>& patch, const Vec3& x, const EnergyShape& shape, Vec3* gradient) {
  double sum = 0;
  if (gradient != nullptr) gradient->setZero();
  for (Corner& corner : patch) {
    corner.points[static_cast<std::size_t>(corner.role)] = x;
    sum += corner_energy(corner, shape, gradient);
  }
  return sum;
}

}  // namespace hexfield::hex
