#include <algorithm>
#include <cmath>

#include "align_kernel.hpp"

namespace hexfield {
namespace {

Mat3 basis(const Vec3& first, const Vec3& second) {
  Mat3 m;
  const Vec3 b = (second - second.dot(first) * first).normalized();
  m << first, b, first.cross(b);
  return m;
}

}  // namespace

std::vector<std::pair<TetId, FrameConstraint>> frame_constraints(std::span<const AxisConstraint> constraints) {
  std::vector<std::size_t> order(constraints.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const auto &x = constraints[a], &y = constraints[b];
    return std::tie(x.tet, x.kind) < std::tie(y.tet, y.kind);
  });
  std::vector<std::pair<TetId, FrameConstraint>> found;
  for (std::size_t i : order) {
    const AxisConstraint& c = constraints[i];
    if (found.empty() || found.back().first != c.tet) found.emplace_back(c.tet, FrameConstraint());
    FrameConstraint& f = found.back().second;
    const auto n = static_cast<std::size_t>(f.count);
    if (n == 2 || (n == 1 && octahedral::axis(f.labels[0]) == octahedral::axis(c.label))) continue;
    // Two directions that are nearly parallel cannot lie on two axes.
    if (n == 1 && std::abs(f.directions[0].dot(c.direction)) > 0.9) continue;
    f.labels[n] = c.label;
    f.directions[n] = c.direction;
    ++f.count;
  }
  return found;
}

FrameProjection projection_of(const FrameConstraint& constraint) {
  FrameProjection p;
  if (constraint.count == 0) return p;
  const Vec3 axis = octahedral::direction(constraint.labels[0]);
  const Vec3& direction = constraint.directions[0];
  if (constraint.count == 2) {
    const Mat3 chart = basis(axis, octahedral::direction(constraint.labels[1]));
    p.turn = Quaternion(Mat3(basis(direction, constraint.directions[1]) * chart.transpose())).normalized();
  } else {
    p.turn = Quaternion::FromTwoVectors(axis, direction);
    p.axis = axis;
  }
  return p;
}

Quaternion project_frame(const Quaternion& q, const FrameProjection& p) {
  Quaternion r = p.turn;
  if (p.axis != Vec3::Zero()) {
    // Frames with this axis there: turn * (rotation about the axis); the closest keeps w and that component.
    const Quaternion rest = p.turn.conjugate() * q;
    const double along = rest.vec().dot(p.axis);
    const double norm = std::sqrt(rest.w() * rest.w() + along * along);
    if (norm < 1e-12) return p.turn;
    const Vec3 v = along / norm * p.axis;
    r = p.turn * Quaternion(rest.w() / norm, v.x(), v.y(), v.z());
    r.normalize();
  }
  if (r.dot(q) < 0) r.coeffs() *= -1;
  return r;
}

Quaternion project_frame(const Quaternion& q, const FrameConstraint& constraint) {
  return constraint.count == 0 ? q : project_frame(q, projection_of(constraint));
}

}  // namespace hexfield
