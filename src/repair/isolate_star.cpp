#include <algorithm>

#include "hexfield/repair/one_ring.hpp"
#include "hexfield/repair/state_ops.hpp"

namespace hexfield {
namespace {

bool on_special_edge(const RepairState& state, VertexId v) {
  if (state.features.points.contains(v)) return true;
  for (const EdgeKey& e : edges_at(state.mesh, v))
    if (is_special(state, e)) return true;
  return false;
}

// Regular edges from v to something special, unless they run in a feature face to a vertex of that face only.
int split_spokes(RepairState& state, VertexId v) {
  int splits = 0;
  for (const EdgeKey& e : edges_at(state.mesh, v)) {
    if (is_special(state, e)) continue;
    const VertexId end = e[0] == v ? e[1] : e[0];
    if (!on_special_edge(state, end) && (in_feature_face(state, e) || !on_feature_face(state, end))) continue;
    split_edge(state, e[0], e[1]);
    ++splits;
  }
  return splits;
}

// A half-face at v that is no feature face but whose edge on the link is special or lies in a feature face.
HalfFaceId face_with_special_link(const RepairState& state, VertexId v) {
  for (TetId t : vertex_star(state.mesh, v))
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(t, f);
      const FaceKey key = state.mesh.key(h);
      const auto apex = std::find(key.begin(), key.end(), v);
      if (apex == key.end() || is_feature_face(state, h)) continue;
      const auto i = static_cast<std::size_t>(apex - key.begin());
      const EdgeKey link = edge_key(key[(i + 1) % 3], key[(i + 2) % 3]);
      if (is_special(state, link) || in_feature_face(state, link)) return h;
    }
  return HalfFaceId();
}

}  // namespace

int isolate_star(RepairState& state, VertexId v) {
  int splits = split_spokes(state, v);
  for (HalfFaceId h = face_with_special_link(state, v); h.valid(); h = face_with_special_link(state, v)) {
    split_face(state, h);
    ++splits;
  }
  for (TetId t : vertex_star(state.mesh, v))
    if (is_feature_face(state, HalfFaceId(t, state.mesh.local_index(t, v)))) {
      split_tet(state, t);
      ++splits;
    }
  return splits;
}

}  // namespace hexfield
