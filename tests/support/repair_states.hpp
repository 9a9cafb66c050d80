#pragma once

#include "hexfield/field/edge_codes.hpp"
#include "hexfield/repair/state_ops.hpp"
#include "support/meshes.hpp"

/// Fields made by hand on Kuhn boxes (support/meshes.hpp), for tests of the repair.
namespace hexfield::testing {

/// Constant field on a box with features from its angles; codes of the box edges and target lengths set.
inline RepairState box_state(int nx, int ny, int nz) {
  RepairState state;
  state.mesh = kuhn_box(nx, ny, nz);
  complete_features(state.mesh, state.features);
  state.field.frames.assign(state.mesh.num_tets(), Quaternion::Identity());
  state.field.matchings.assign(state.mesh.num_tets(), {});
  state.target_length.assign(state.mesh.num_vertices(), 1.0);
  state.codes = compute_codes(state.mesh, state.features, state.field);
  return state;
}
inline RepairState box_state(int n) { return box_state(n, n, n); }

inline VertexId vertex_at(const TetMesh& mesh, const Vec3& p) {
  for (std::size_t v = 0; v < mesh.num_vertices(); ++v)
    if ((mesh.points[v] - p).norm() < 1e-9) return VertexId(static_cast<std::int64_t>(v));
  return VertexId();
}

/// Multiplies the matching of the face through three points by a quarter-turn about the axis `about`, in the
/// direction of `normal`. All frames must be equal.
inline void turn_face(RepairState& state, const std::array<Vec3, 3>& p, octahedral::Label about, const Vec3& normal) {
  const FaceKey key = face_key(vertex_at(state.mesh, p[0]), vertex_at(state.mesh, p[1]), vertex_at(state.mesh, p[2]));
  HalfFaceId h = find_half_face(state.mesh, key);
  if (outward_normal(state.mesh, h).dot(normal) < 0) h = state.mesh.opposite_half_face(h);
  set_matching(state, h, octahedral::product(state.field.matching(h), octahedral::quarter_turn(about)));
}

/// spec-lmff section 12, fact 11: a constant field in a box, matchings of an eight-face parallelogram of x-edges
/// and space diagonals multiplied by a quarter-turn about x. Its boundary becomes two arcs +1 and -1 that meet
/// at two zipper nodes. The parallelogram starts at `corner` and spans (4, 2, 2).
inline RepairState zipper_state(const std::array<int, 3>& box = {6, 4, 4}, const Vec3& corner = Vec3(1, 1, 1)) {
  RepairState state = box_state(box[0], box[1], box[2]);
  const Vec3 x(1, 0, 0), d(1, 1, 1), normal(0, 1, -1);
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b) {
      const Vec3 p = corner + a * x + b * d;
      turn_face(state, {p, p + x, p + d}, 0, normal);
      turn_face(state, {p + x, p + d, p + x + d}, 0, normal);
    }
  state.codes = compute_codes(state.mesh, state.features, state.field);
  return state;
}

}  // namespace hexfield::testing
