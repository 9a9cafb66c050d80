#include "hexfield/mesh/surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hexfield {
namespace {

template <class Element>
AabbTree tree_of(const std::vector<Element>& elements, const auto& corners) {
  std::vector<AabbTree::Box> boxes(elements.size());
  for (std::size_t i = 0; i < elements.size(); ++i)
    for (const Vec3& p : corners(elements[i])) boxes[i].extend(p);
  return AabbTree(boxes);
}

// The side whose outward normal a feature face gets.
HalfFaceId side_of(const TetMesh& mesh, const Features& features, const FaceKey& face) {
  const HalfFaceId h = find_half_face(mesh, face);
  require(h.valid(), "A feature face is not a face of the mesh.");
  const HalfFaceId other = mesh.opposite_half_face(h);
  if (!other.valid()) return h;
  auto rank = [&](HalfFaceId side) {
    const int colour = features.tet_colours.empty() ? 0 : features.tet_colours[side.tet().index()];
    return std::pair(colour, side);
  };
  return std::min(rank(h), rank(other)).second;
}

template <class Map>
const auto& of_colour(const Map& map, int colour, const char* what) {
  const auto found = map.find(colour);
  if (found == map.end()) throw Error(ExitCode::bug, fmt::format("No feature {} has the colour {}.", what, colour));
  return found->second;
}

}  // namespace

Vec3 closest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double length2 = d.squaredNorm();
  if (!(length2 > 0)) return a;
  const double s = d.dot(p - a) / length2;
  return s <= 0 ? a : s >= 1 ? b : Vec3(a + s * d);
}

Vec3 closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = (b - a).cross(c - a);
  const double n2 = n.squaredNorm();
  auto left_of = [&](const Vec3& from, const Vec3& to) { return n.dot((to - from).cross(p - from)) >= 0; };
  if (n2 > 0 && left_of(a, b) && left_of(b, c) && left_of(c, a)) return p - (n.dot(p - a) / n2) * n;
  Vec3 best = closest_on_segment(p, a, b);
  for (const Vec3& q : {closest_on_segment(p, b, c), closest_on_segment(p, c, a)})
    if ((q - p).squaredNorm() < (best - p).squaredNorm()) best = q;
  return best;
}

ClosestSurface::ClosestSurface(const TetMesh& mesh, const Features& features) {
  for (const auto& [face, colour] : features.faces) {
    const auto f = mesh.face_vertices(side_of(mesh, features, face));
    patches_[colour].triangles.push_back({{mesh.point(f[0]), mesh.point(f[1]), mesh.point(f[2])}, face});
  }
  for (auto& [colour, patch] : patches_)
    patch.tree = tree_of(patch.triangles, [](const Triangle& t) { return t.corners; });
}

SurfaceProjection ClosestSurface::project(const Vec3& p, int colour) const {
  const Patch& patch = of_colour(patches_, colour, "face");
  auto closest = [&](std::int32_t i) {
    const auto& c = patch.triangles[static_cast<std::size_t>(i)].corners;
    return closest_on_triangle(p, c[0], c[1], c[2]);
  };
  const auto nearest = patch.tree.nearest(p, [&](std::int32_t i) { return (closest(i) - p).squaredNorm(); });
  require(nearest.primitive >= 0, "A point to project is not finite.");
  const Triangle& t = patch.triangles[static_cast<std::size_t>(nearest.primitive)];
  const Vec3 normal = (t.corners[1] - t.corners[0]).cross(t.corners[2] - t.corners[0]).normalized();
  return {closest(nearest.primitive), normal, t.face, std::sqrt(nearest.squared_distance)};
}

ClosestCurve::ClosestCurve(const TetMesh& mesh, const Features& features) {
  for (const auto& [edge, colour] : features.edges)
    curves_[colour].segments.push_back({{mesh.point(edge[0]), mesh.point(edge[1])}, edge});
  for (auto& [colour, curve] : curves_) curve.tree = tree_of(curve.segments, [](const Segment& s) { return s.ends; });
}

CurveProjection ClosestCurve::project(const Vec3& p, int colour) const {
  const Curve& curve = of_colour(curves_, colour, "edge");
  auto closest = [&](std::int32_t i) {
    const auto& e = curve.segments[static_cast<std::size_t>(i)].ends;
    return closest_on_segment(p, e[0], e[1]);
  };
  const auto nearest = curve.tree.nearest(p, [&](std::int32_t i) { return (closest(i) - p).squaredNorm(); });
  require(nearest.primitive >= 0, "A point to project is not finite.");
  const Segment& s = curve.segments[static_cast<std::size_t>(nearest.primitive)];
  return {closest(nearest.primitive), (s.ends[1] - s.ends[0]).normalized(), s.edge,
          std::sqrt(nearest.squared_distance)};
}

}  // namespace hexfield
