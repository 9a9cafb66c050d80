#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>

#include "hexfield/field/spherical_harmonics.hpp"

namespace hexfield::harmonics {
namespace {

Quaternion exponential(const Vec3& w) {
  const double angle = w.norm();
  if (angle == 0) return Quaternion::Identity();
  return Quaternion(Eigen::AngleAxisd(angle, w / angle));
}

// Ascent step of <q, exp(w) s>: Newton with the eigenvalues of the negated Hessian made positive.
Vec3 ascent_step(const Sh& q, const Sh& s, const Vec3& gradient) {
  const Mat3 h = tangent(q).transpose() * tangent(s);  // <q, L_k L_l s> = -<L_k q, L_l s>
  const Mat3 symmetric = 0.5 * (h + h.transpose());
  const double trace = symmetric.trace();
  Vec3 step;
  if (const Eigen::LLT<Mat3> factor(symmetric - 1e-3 * std::abs(trace) * Mat3::Identity());
      trace > 0 && factor.info() == Eigen::Success) {
    step = symmetric.inverse() * gradient;
  } else {
    const Eigen::SelfAdjointEigenSolver<Mat3> eigen(symmetric);
    const double floor = 1e-3 * eigen.eigenvalues().cwiseAbs().maxCoeff() + 1e-300;
    const Vec3 curvature = eigen.eigenvalues().cwiseAbs().cwiseMax(floor);
    step = eigen.eigenvectors() * (eigen.eigenvectors().transpose() * gradient).cwiseQuotient(curvature);
  }
  const double longest = 0.3;  // well inside the 45 degrees that separate a maximum from its mirror
  if (step.norm() > longest) step *= longest / step.norm();
  return step;
}

const std::array<Quaternion, 5>& seeds() {
  static const std::array<Quaternion, 5> list = {
      Quaternion::Identity(), Quaternion(Eigen::AngleAxisd(M_PI / 4, Vec3::UnitX())),
      Quaternion(Eigen::AngleAxisd(M_PI / 4, Vec3::UnitY())), Quaternion(Eigen::AngleAxisd(M_PI / 4, Vec3::UnitZ())),
      Quaternion(Eigen::AngleAxisd(M_PI / 4, Vec3(1, 1, 0).normalized()))};
  return list;
}

// A frame with at least this cosine with q is the closest one: any closer frame would lie within 37 degrees (on
// the unit sphere) of it, and along the way between them the function is concave.
constexpr double surely_closest = 0.95;

}  // namespace

Projected project_from(const Sh& q, const Quaternion& start) {
  Projected p{start, of_frame(start), 0};
  p.dot = q.dot(p.sh);
  const double scale = q.norm();
  for (int iteration = 0; iteration < 60; ++iteration) {
    const Vec3 gradient = tangent(p.sh).transpose() * q;
    if (gradient.norm() <= 1e-13 * scale) break;
    Vec3 step = ascent_step(q, p.sh, gradient);
    bool moved = false;
    for (int halving = 0; halving < 30 && !moved; ++halving, step *= 0.5) {
      const Quaternion frame = (exponential(step) * p.frame).normalized();
      const Sh sh = of_frame(frame);
      const double dot = q.dot(sh);
      // Near the maximum the gain drowns in rounding: a full step is right then.
      moved = dot > p.dot || (halving == 0 && dot > p.dot - 1e-14 * scale);
      if (moved) p = {frame, sh, dot};
    }
    if (!moved || step.norm() < 1e-14) break;
  }
  return p;
}

Projected project(const Sh& q) {
  static const std::array<Sh, 5> seed_sh = [] {
    std::array<Sh, 5> sh;
    for (std::size_t k = 0; k < sh.size(); ++k) sh[k] = of_frame(seeds()[k]);
    return sh;
  }();
  const double norm = q.norm();
  std::size_t nearest = 0;
  for (std::size_t k = 1; k < seed_sh.size(); ++k)
    if (q.dot(seed_sh[k]) > q.dot(seed_sh[nearest]) + 1e-9 * norm) nearest = k;
  Projected best = project_from(q, seeds()[nearest]);
  if (norm > 0 && best.dot > surely_closest * norm) return best;
  for (std::size_t k = 0; k < seed_sh.size(); ++k) {
    if (k == nearest) continue;
    const Projected p = project_from(q, seeds()[k]);
    // A margin keeps rounding noise from deciding between equally good maxima.
    if (p.dot > best.dot + 1e-9 * norm) best = p;
  }
  return best;
}

Projected project(const Sh& q, const AlignedBasis& basis) {
  const Eigen::Vector2d c = basis.twist.transpose() * q;
  const double angle = c.norm() > 0 ? std::atan2(c[0], c[1]) / 4 : 0;
  Projected p;
  p.frame = basis.rotation * Quaternion(Eigen::AngleAxisd(angle, Vec3::UnitZ()));
  p.sh = of_frame(p.frame);
  p.dot = q.dot(p.sh);
  return p;
}

}  // namespace hexfield::harmonics
