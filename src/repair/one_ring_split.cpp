#include <algorithm>

#include "hexfield/repair/edge_repair.hpp"
#include "hexfield/repair/state_ops.hpp"

namespace hexfield {
namespace {

// What the rules ask of a vertex, looked at once.
struct Mark {
  int special_edges = 0;
  bool on_feature = false;
};

class Marks {
 public:
  explicit Marks(const RepairState& state) : state_(state) {}
  const Mark& operator[](VertexId v) {
    const auto found = marks_.find(v);
    if (found != marks_.end()) return found->second;
    Mark mark;
    mark.on_feature = on_feature_face(state_, v);
    for (const EdgeKey& e : edges_at(state_.mesh, v)) {
      mark.special_edges += is_special(state_, e);
      mark.on_feature = mark.on_feature || state_.features.edges.contains(e);
    }
    return marks_.emplace(v, mark).first->second;
  }

 private:
  const RepairState& state_;
  std::map<VertexId, Mark> marks_;
};

// A face in the star of v with three special edges.
HalfFaceId face_to_split(const RepairState& state, VertexId v) {
  for (TetId t : vertex_star(state.mesh, v))
    for (int f = 0; f < 4; ++f) {
      const FaceKey k = state.mesh.key(HalfFaceId(t, f));
      if (is_special(state, edge_key(k[0], k[1])) && is_special(state, edge_key(k[0], k[2])) &&
          is_special(state, edge_key(k[1], k[2])))
        return HalfFaceId(t, f);
    }
  return HalfFaceId();
}

bool must_split(const RepairState& state, Marks& marks, VertexId v, const EdgeKey& e) {
  const bool feature = state.features.edges.contains(e);
  const bool singular = state.codes.contains(e);
  auto special = [&](VertexId w) { return w == v || marks[w].special_edges > 0; };
  if (!feature && !singular) return special(e[0]) && special(e[1]);
  if (singular && !feature && marks[e[0]].on_feature && marks[e[1]].on_feature) {
    // On the boundary or in a feature face both halves would be as before.
    const EdgeRing ring = ring_of(state.mesh, e[0], e[1]);
    return ring.closed && std::none_of(ring.crossings.begin(), ring.crossings.end(),
                                       [&](HalfFaceId h) { return is_feature_face(state, h); });
  }
  return marks[e[0]].special_edges > 2 && marks[e[1]].special_edges > 2;
}

}  // namespace

int split_one_ring(RepairState& state, VertexId v) {
  int splits = 0;
  for (HalfFaceId h = face_to_split(state, v); h.valid(); h = face_to_split(state, v), ++splits) split_face(state, h);
  Marks marks(state);
  std::vector<EdgeKey> edges;
  for (const EdgeKey& e : edges_of(state.mesh, vertex_star(state.mesh, v)))
    if (must_split(state, marks, v, e)) edges.push_back(e);
  // Those at v first: what they cut off leaves the one-ring.
  std::stable_partition(edges.begin(), edges.end(), [&](const EdgeKey& e) { return e[0] == v || e[1] == v; });
  for (const EdgeKey& e : edges) {
    if (e[0] != v && e[1] != v) {
      const EdgeRing ring = ring_of(state.mesh, e[0], e[1]);
      const bool inside =
          std::any_of(ring.tets.begin(), ring.tets.end(), [&](TetId t) { return state.mesh.has_vertex(t, v); });
      if (!inside) continue;
    }
    split_edge(state, e[0], e[1]);
    ++splits;
  }
  return splits;
}

}  // namespace hexfield
