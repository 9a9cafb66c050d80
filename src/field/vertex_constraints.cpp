#include <algorithm>
#include <cmath>
#include <complex>

#include "hexfield/field/spherical_harmonics.hpp"
#include "hexfield/field/vertex_field.hpp"

namespace hexfield {
namespace {

using Kind = NodeConstraint::Kind;

// A frame is fixed only where the directions miss its axes by less than about this.
constexpr double fit_degrees = 9;

struct Surroundings {
  std::vector<Vec3> normals;   // weighted by the angle of the face at the vertex
  std::vector<Vec3> tangents;  // unit, away from the vertex
  bool node = false;
};

double angle_at(const TetMesh& mesh, VertexId v, const std::array<VertexId, 3>& face) {
  std::array<Vec3, 2> arms;
  std::size_t n = 0;
  for (VertexId w : face)
    if (w != v && n < 2) arms[n++] = mesh.point(w) - mesh.point(v);
  return std::atan2(arms[0].cross(arms[1]).norm(), arms[0].dot(arms[1]));
}

std::vector<Surroundings> gather(const TetMesh& mesh, const Features& features) {
  std::vector<Surroundings> around(mesh.num_vertices());
  for (std::size_t i = 0; i < mesh.num_tets(); ++i) {
    const TetId t(static_cast<std::int64_t>(i));
    if (!mesh.alive(t)) continue;
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(t, f);
      const HalfFaceId o = mesh.opposite_half_face(h);
      if (o.valid() && (o < h || features.faces.count(mesh.key(h)) == 0)) continue;  // each face once
      const Vec3 n = outward_normal(mesh, h);
      const auto face = mesh.face_vertices(h);
      for (VertexId v : face) around[v.index()].normals.push_back(angle_at(mesh, v, face) * n);
    }
  }
  for (const auto& entry : features.edges) {
    const Vec3 d = (mesh.point(entry.first[1]) - mesh.point(entry.first[0])).normalized();
    around[entry.first[0].index()].tangents.push_back(d);
    around[entry.first[1].index()].tangents.push_back(-d);
  }
  for (const auto& entry : features.points) around[entry.first.index()].node = true;
  return around;
}

NodeConstraint from_normals(const Surroundings& s, double deviation_degrees) {
  NodeConstraint c;
  const Vec3 first = s.normals[0].normalized();
  Vec3 sum = Vec3::Zero();
  for (const Vec3& n : s.normals) {
    const double dot = n.normalized().dot(first);
    if (std::abs(dot) < std::cos(deviation_degrees * M_PI / 180)) return c;
    sum += dot < 0 ? Vec3(-n) : n;
  }
  c.kind = Kind::aligned;
  c.direction = sum.normalized();
  return c;
}

NodeConstraint on_curve(const Surroundings& s) {
  NodeConstraint c;
  if (s.tangents[0].dot(s.tangents[1]) > -std::cos(M_PI / 4)) return c;  // a sharp bend has no tangent
  const Vec3 t = (s.tangents[0] - s.tangents[1]).normalized();
  c.kind = Kind::aligned;
  c.direction = t;
  // Fourfold mean of the normals around the tangent: its length tells how well one cross fits all.
  const Quaternion turn = Quaternion::FromTwoVectors(Vec3::UnitZ(), t);
  std::complex<double> mean = 0;
  double total = 0;
  for (const Vec3& n : s.normals) {
    const Vec3 d = turn.conjugate() * n;
    const double weight = n.norm();
    mean += weight * std::polar(1.0, 4 * std::atan2(d.y(), d.x()));
    total += weight;
  }
  if (total > 0 && std::abs(mean) > std::cos(4 * fit_degrees * M_PI / 180) * total) {
    c.kind = Kind::fixed;
    c.frame = (turn * Quaternion(Eigen::AngleAxisd(std::arg(mean) / 4, Vec3::UnitZ()))).normalized();
  }
  return c;
}

NodeConstraint at_node(const Surroundings& s) {
  NodeConstraint c;
  harmonics::Sh sum = harmonics::Sh::Zero();
  for (const Vec3& d : s.tangents) sum += harmonics::zonal(d);
  for (const Vec3& n : s.normals) sum += n.norm() * harmonics::zonal(n.normalized());
  const Quaternion frame = harmonics::project(sum).frame;
  double worst = 1;
  bool two_axes = false;
  auto judge = [&](const Vec3& d) {
    const Vec3 x = (frame.conjugate() * d).cwiseAbs();
    worst = std::min(worst, x.maxCoeff());
  };
  for (const Vec3& d : s.tangents) {
    judge(d);
    two_axes = two_axes || std::abs(d.dot(s.tangents[0])) < 0.5;
  }
  for (const Vec3& n : s.normals) {
    judge(n.normalized());
    two_axes = two_axes || std::abs(n.normalized().dot(s.normals[0].normalized())) < 0.5;
  }
  if (!two_axes || worst < std::cos(fit_degrees * M_PI / 180)) return c;
  c.kind = Kind::fixed;
  c.frame = frame;
  return c;
}

}  // namespace

std::vector<NodeConstraint> vertex_constraints(const TetMesh& mesh, const Features& features,
                                               double normal_deviation_degrees) {
  const std::vector<Surroundings> around = gather(mesh, features);
  std::vector<NodeConstraint> constraints(mesh.num_vertices());
  for (std::size_t v = 0; v < constraints.size(); ++v) {
    const Surroundings& s = around[v];
    const bool node = s.node || s.tangents.size() == 1 || s.tangents.size() > 2;
    if (s.tangents.empty() && s.normals.empty()) continue;
    if (node && !s.tangents.empty())
      constraints[v] = at_node(s);
    else if (s.tangents.size() == 2)
      constraints[v] = on_curve(s);
    else if (!s.normals.empty())
      constraints[v] = from_normals(s, normal_deviation_degrees);
  }
  return constraints;
}

}  // namespace hexfield
