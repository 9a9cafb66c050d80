#include <cmath>

#include "hexfield/field/edge_codes.hpp"

namespace hexfield {

using octahedral::Label;

namespace {

bool is_feature(const TetMesh& mesh, const Features& features, HalfFaceId h) {
  return mesh.is_boundary(h) || features.faces.count(mesh.key(h)) != 0;
}

// Frame with the axes of two perpendicular labels along two directions; the first one exactly.
Quaternion frame_of_two(Label edge_label, const Vec3& e, Label face_label, const Vec3& n) {
  const Vec3 second = (n - n.dot(e) * e).normalized();
  Mat3 world, chart;
  world << e, second, e.cross(second);
  const Vec3 a = octahedral::direction(edge_label);
  const Vec3 b = octahedral::direction(face_label);
  chart << a, b, a.cross(b);
  return Quaternion(Mat3(world * chart.transpose()));
}

// Number of quads of a sector: (dihedral - turning of the frames about the edge) / 90 degrees, with all
// frames aligned to the edge and those at the two feature faces also to the face normals.
int count_quads(const TetMesh& mesh, const FrameField& field, const Sector& s, const Vec3& e) {
  const Vec3 n0 = outward_normal(mesh, s.first);
  const Vec3 n1 = outward_normal(mesh, s.last);
  const Label a0 = closest_label(field.frames[s.tets.front().index()], n0);
  const Label a1 = closest_label(field.frames[s.tets.back().index()], n1);
  Label best = octahedral::no_label;
  double most = 0;
  for (Label start = 0; start < 6; ++start) {
    Label l = start;
    if (octahedral::axis(l) == octahedral::axis(a0)) continue;
    double dot = (field.frames[s.tets[0].index()] * octahedral::direction(l)).dot(e);
    for (std::size_t k = 0; k < s.crossings.size(); ++k) {
      l = transport(field, s.crossings[k], l);
      dot += (field.frames[s.tets[k + 1].index()] * octahedral::direction(l)).dot(e);
    }
    if (octahedral::axis(l) == octahedral::axis(a1)) continue;
    if (dot > most + 1e-9) best = start, most = dot;
  }
  if (best == octahedral::no_label || most < 1e-6 * static_cast<double>(s.tets.size())) return undetermined_code;
  double turning = 0;
  Label l = best;
  const std::size_t last = s.tets.size() - 1;
  auto frame_at = [&](std::size_t k, Label label) {
    return k == 0 ? frame_of_two(label, e, a0, n0) : aligned_frame(field.frames[s.tets[k].index()], label, e);
  };
  Quaternion frame = frame_at(0, l);
  for (std::size_t k = 0; k <= last; ++k) {
    Quaternion next;
    if (k < last) {
      frame = frame * octahedral::quaternion(field.matching(s.crossings[k]));
      l = transport(field, s.crossings[k], l);
      next = frame_at(k + 1, l);
    } else {
      next = frame_of_two(l, e, a1, n1);  // the last frame also has its own turn onto the second normal
    }
    Quaternion turn = next * frame.conjugate();
    if (turn.w() < 0) turn.coeffs() *= -1;
    turning += 2 * std::atan2(turn.vec().dot(e), turn.w());
    frame = next;
  }
  return static_cast<int>(std::lround((s.dihedral - turning) / (M_PI / 2)));
}

void finish(const TetMesh& mesh, const FrameField& field, Sector& s, VertexId a, VertexId b) {
  for (TetId t : s.tets) s.dihedral += dihedral_angle(mesh, t, a, b);
  s.quads = count_quads(mesh, field, s, (mesh.point(b) - mesh.point(a)).normalized());
}

}  // namespace

std::vector<Sector> sectors(const TetMesh& mesh, const Features& features, const FrameField& field,
                            const EdgeRing& ring, VertexId a, VertexId b) {
  std::vector<Sector> found;
  const std::size_t n = ring.tets.size();
  std::size_t start = 0;
  HalfFaceId first = ring.first_boundary;
  if (ring.closed) {
    for (start = 0; start < n && !is_feature(mesh, features, ring.crossings[start]); ++start) {
    }
    if (start == n) return found;
    first = mesh.opposite_half_face(ring.crossings[start]);
    start = (start + 1) % n;
  }
  Sector current;
  current.first = first;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = (start + k) % n;
    const HalfFaceId out = ring.crossings[i];
    current.tets.push_back(ring.tets[i]);
    if (!is_feature(mesh, features, out)) {
      current.crossings.push_back(out);
      continue;
    }
    current.last = out;
    finish(mesh, field, current, a, b);
    found.push_back(current);
    current = Sector();
    current.first = mesh.opposite_half_face(out);
  }
  return found;
}

}  // namespace hexfield
