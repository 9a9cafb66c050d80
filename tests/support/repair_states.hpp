#pragma once

#include <algorithm>
#include <random>

#include "hexfield/field/edge_codes.hpp"
#include "hexfield/field/matchings.hpp"
#include "hexfield/field/singularity_graph.hpp"
#include "hexfield/repair/state_ops.hpp"
#include "hexfield/repair/zipping.hpp"
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

/// The triangles through these points as a patch, bounded by its edges of one triangle, that starts at the edge
/// between two points.
inline ZipPatch patch_of(const TetMesh& mesh, const std::vector<std::array<Vec3, 3>>& triangles,
                         const std::array<Vec3, 2>& start) {
  ZipPatch patch;
  std::map<EdgeKey, int> uses;
  for (const auto& p : triangles) {
    const FaceKey f = face_key(vertex_at(mesh, p[0]), vertex_at(mesh, p[1]), vertex_at(mesh, p[2]));
    patch.faces.push_back(f);
    for (const EdgeKey& e : {edge_key(f[0], f[1]), edge_key(f[0], f[2]), edge_key(f[1], f[2])}) ++uses[e];
  }
  for (const auto& [e, n] : uses)
    if (n == 1) patch.boundary.push_back(e);
  patch.start = edge_key(vertex_at(mesh, start[0]), vertex_at(mesh, start[1]));
  return patch;
}

/// Triangles of a parallelogram of n_x x-edges and n_d space diagonals at a corner (n_d = 2, n_x = 2: fact 11).
inline std::vector<std::array<Vec3, 3>> slanted_triangles(const Vec3& corner, int n_x, int n_d) {
  const Vec3 x(1, 0, 0), d(1, 1, 1);
  std::vector<std::array<Vec3, 3>> triangles;
  for (int a = 0; a < n_x; ++a)
    for (int b = 0; b < n_d; ++b) {
      const Vec3 p = corner + a * x + b * d;
      triangles.push_back({p, p + x, p + d});
      triangles.push_back({p + x, p + d, p + x + d});
    }
  return triangles;
}

/// A sheet of vertical triangles that hangs from (up < 0) or stands on (up > 0) the line through `p` along x (axis 0)
/// or y (axis 1) to the end of the box; its matchings make the line an arc of this code, the edge of the box's face
/// below gets the opposite. All frames must be equal. Codes are not updated.
inline void add_straight_arc(RepairState& state, const Vec3& p, int axis, int up, EdgeCode code) {
  const Vec3 along = Vec3::Unit(axis), z = Vec3::UnitZ();
  const Vec3 normal = along.cross(up * z);
  const auto about = static_cast<octahedral::Label>(2 * axis + (code > 0 ? 0 : 1));
  Vec3 q = p;
  for (q[axis] = 0; vertex_at(state.mesh, q + along).valid(); q[axis] += 1, q.z() = p.z())
    for (q.z() = up < 0 ? p.z() - 1 : p.z(); vertex_at(state.mesh, q).valid() && vertex_at(state.mesh, q + z).valid();
         q.z() += up) {
      turn_face(state, {q, q + along, q + along + z}, about, normal);
      turn_face(state, {q, q + z, q + along + z}, about, normal);
    }
}

/// A random gauge change of every tet; returns the rotations.
inline std::vector<octahedral::Rotation> shuffle_gauges(RepairState& state, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<octahedral::Rotation> gauges(state.mesh.num_tets());
  for (std::size_t t = 0; t < gauges.size(); ++t) {
    gauges[t] = static_cast<octahedral::Rotation>(random() % octahedral::order);
    change_gauge(state.mesh, state.field, TetId(static_cast<std::int64_t>(t)), gauges[t]);
  }
  return gauges;
}

/// Numbers of vertices of a kind, corners of the box left out.
inline int count_kind(const RepairState& state, NodeKind kind) {
  int n = 0;
  for (const SingularNode& node : singularity_graph(state.mesh, state.features, state.field, state.codes).nodes)
    n += node.kind == kind && !state.features.points.contains(node.vertex);
  return n;
}

/// Numbers of edges with a code, feature edges left out.
inline int count_code(const RepairState& state, EdgeCode code) {
  int n = 0;
  for (const auto& [edge, c] : state.codes) n += c == code && !state.features.edges.contains(edge);
  return n;
}

}  // namespace hexfield::testing
