#include "hexfield/base/octahedral.hpp"

#include <cmath>

#include "hexfield/base/error.hpp"

namespace hexfield::octahedral {
namespace {

struct Tables {
  std::array<Quaternion, order> quaternions;
  std::array<Mat3, order> matrices;
  std::array<std::array<Rotation, order>, order> products;
  std::array<Rotation, order> inverses;
  std::array<std::array<Label, 6>, order> images;
};

Mat3 rounded(const Mat3& m) {
  // Adding 0 turns -0 into 0, so that applying a rotation never changes the bytes of a zero.
  return m.unaryExpr([](double x) { return std::round(x) + 0.0; });
}

std::array<Quaternion, order> enumerate_quaternions() {
  const double h = std::sqrt(0.5);
  std::array<Quaternion, order> q;
  std::size_t n = 0;
  auto add = [&](double w, double x, double y, double z) { q[n++] = Quaternion(w, x, y, z); };
  add(1, 0, 0, 0);
  add(0, 1, 0, 0), add(0, 0, 1, 0), add(0, 0, 0, 1);
  for (int a = 0; a < 3; ++a)
    for (double s : {h, -h}) add(h, a == 0 ? s : 0, a == 1 ? s : 0, a == 2 ? s : 0);
  for (double s : {h, -h}) add(0, h, s, 0), add(0, h, 0, s), add(0, 0, h, s);
  for (double x : {0.5, -0.5})
    for (double y : {0.5, -0.5})
      for (double z : {0.5, -0.5}) add(0.5, x, y, z);
  return q;
}

Rotation find(const std::array<Mat3, order>& matrices, const Mat3& m) {
  for (int r = 0; r < order; ++r)
    if (matrices[static_cast<std::size_t>(r)] == m) return static_cast<Rotation>(r);
  throw Error(ExitCode::bug, "A product of octahedral rotations left the group.");
}

Label label_of(const Vec3& v) {
  for (Label a = 0; a < 6; ++a)
    if (direction(a) == v) return a;
  throw Error(ExitCode::bug, "An octahedral rotation moved an axis off the axes.");
}

Tables build() {
  Tables t;
  t.quaternions = enumerate_quaternions();
  for (std::size_t r = 0; r < order; ++r) t.matrices[r] = rounded(t.quaternions[r].toRotationMatrix());
  for (std::size_t a = 0; a < order; ++a) {
    t.inverses[a] = find(t.matrices, t.matrices[a].transpose());
    for (std::size_t b = 0; b < order; ++b) t.products[a][b] = find(t.matrices, rounded(t.matrices[a] * t.matrices[b]));
    for (Label l = 0; l < 6; ++l) t.images[a][l] = label_of(rounded(t.matrices[a]) * direction(l) + Vec3::Zero());
  }
  return t;
}

const Tables& tables() {
  static const Tables instance = build();
  return instance;
}

}  // namespace

Rotation product(Rotation a, Rotation b) { return tables().products[a][b]; }
Rotation inverse(Rotation a) { return tables().inverses[a]; }
Label image(Rotation r, Label a) { return tables().images[r][a]; }
const Mat3& matrix(Rotation r) { return tables().matrices[r]; }
const Quaternion& quaternion(Rotation r) { return tables().quaternions[r]; }

Vec3 direction(Label a) {
  Vec3 v = Vec3::Zero();
  v[axis(a)] = sign(a);
  return v;
}

Vec3 apply(Rotation r, const Vec3& x) {
  Vec3 y;
  for (Label positive = 0; positive < 6; positive += 2) {
    const Label to = image(r, positive);
    y[axis(to)] = (to & 1) != 0 ? -x[axis(positive)] : x[axis(positive)];
  }
  return y;
}

Rotation quarter_turn(Label a) { return static_cast<Rotation>(4 + a); }

Label rotation_axis(Rotation r) {
  require(r != identity && is_axial(r), "rotation_axis() needs a half-turn or quarter-turn about a coordinate axis.");
  return r < 4 ? static_cast<Label>(2 * (r - 1)) : static_cast<Label>(r - 4);
}

Rotation closest(const Quaternion& q) {
  Rotation best = identity;
  double best_dot = -1;
  for (Rotation r = 0; r < order; ++r) {
    const double dot = std::abs(q.dot(tables().quaternions[r]));
    // A margin keeps rounding noise from deciding between equally close elements.
    if (dot > best_dot + 1e-12) best = r, best_dot = dot;
  }
  return best;
}

Rotation matching(const Quaternion& frame_i, const Quaternion& frame_j) {
  return closest(frame_i.conjugate() * frame_j);
}

}  // namespace hexfield::octahedral
