#include <algorithm>

#include "hexfield/field/align_field.hpp"
#include "link_map.hpp"

namespace hexfield {

using octahedral::Label;

namespace {

// Perpendicular to the side from corner k to k + 1 and v, out of the tet.
Vec3 side_normal(const Link& link, const LinkTriangle& t, std::size_t k) {
  auto at = [&](std::size_t i) { return link.vertices[static_cast<std::size_t>(t.vertex[i % 3])].direction; };
  return at(k + 1).cross(at(k)).normalized();
}

void add(FrameConstraint& c, Label label, const Vec3& direction) {
  if (c.count == 2 || (c.count == 1 && octahedral::axis(c.labels[0]) == octahedral::axis(label))) return;
  c.labels[static_cast<std::size_t>(c.count)] = label;
  c.directions[static_cast<std::size_t>(c.count)] = direction;
  ++c.count;
}

FrameConstraint constraint_of(const Link& link, const LinkTriangle& t) {
  FrameConstraint c;
  for (std::size_t k = 0; k < 3; ++k)
    if (t.normal[k] != octahedral::no_label) add(c, t.normal[k], side_normal(link, t, k));
  for (std::size_t k = 0; k < 3; ++k) {
    const LinkVertex& v = link.vertices[static_cast<std::size_t>(t.vertex[k])];
    if (v.free_count() != 1) continue;
    const Vec3 image = octahedral::apply(t.to_tet[k], v.start);
    Eigen::Index axis = 0;
    image.cwiseAbs().maxCoeff(&axis);
    add(c, static_cast<Label>(2 * axis + (image[axis] < 0)), v.direction);
  }
  return c;
}

Vec3 some_direction(const LinkVertex& vertex) {
  for (int i = 0; i < 3; ++i)
    if (vertex.free[static_cast<std::size_t>(i)]) return Vec3::Unit(i);
  return Vec3::Zero();
}

}  // namespace

void guess_images(Link& link) {
  std::vector<Vec3> seen(link.vertices.size(), Vec3::Zero());
  for (const LinkTriangle& t : link.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = static_cast<std::size_t>(t.vertex[k]);
      seen[v] += octahedral::apply(octahedral::inverse(t.to_tet[k]), t.frame.conjugate() * link.vertices[v].direction);
    }
  for (std::size_t v = 0; v < seen.size(); ++v) {
    LinkVertex& vertex = link.vertices[v];
    if (vertex.free_count() == 1 && !vertex.start.isZero()) continue;
    for (int i = 0; i < 3; ++i)
      if (!vertex.free[static_cast<std::size_t>(i)]) seen[v][i] = 0;
    const double length = seen[v].norm();
    vertex.start = length > 1e-9 ? Vec3(seen[v] / length) : some_direction(vertex);
  }
}

void align_frames(Link& link, int sweeps) {
  std::vector<FrameConstraint> constraints;
  for (const LinkTriangle& t : link.triangles) constraints.push_back(constraint_of(link, t));
  double turned = 1;
  for (int sweep = 0; sweep < sweeps && turned > 1e-8; ++sweep) {
    turned = 0;
    for (std::size_t i = 0; i < link.triangles.size(); ++i) {
      LinkTriangle& t = link.triangles[i];
      Eigen::Vector4d sum = t.frame.coeffs();
      for (std::size_t k = 0; k < 3; ++k) {
        if (t.across[k] < 0) continue;
        // F_j M_ji, with M_ji the rotation from this chart to that one.
        const Quaternion there =
            link.triangles[static_cast<std::size_t>(t.across[k])].frame * octahedral::quaternion(t.from_chart[k]);
        sum += (there.coeffs().dot(sum) < 0 ? -1 : 1) * there.coeffs();
      }
      const double length = sum.norm();
      const Quaternion before = t.frame;
      if (length > 1e-9) t.frame.coeffs() = sum / length;
      if (constraints[i].count > 0) t.frame = project_frame(t.frame, constraints[i]);
      turned = std::max(turned, 1 - std::abs(before.dot(t.frame)));
    }
  }
}

}  // namespace hexfield
