#include <algorithm>

#include "hexfield/repair/edge_repair.hpp"
#include "hexfield/repair/field_snapshot.hpp"
#include "hexfield/repair/state_ops.hpp"
#include "hexfield/repair/zipping.hpp"

namespace hexfield {
namespace {

bool is_boundary_edge(const RepairState& state, const EdgeKey& e) { return !ring_of(state.mesh, e[0], e[1]).closed; }

// Shortest way through the link of v from a to b over vertices inside the domain that have no special edge; every
// step is a side of the link that is regular and whose face at v is no feature.
class LinkPath {
 public:
  LinkPath(const RepairState& state, VertexId v) : state_(state), v_(v) {
    for (TetId t : vertex_star(state.mesh, v)) {
      const auto corners = state.mesh.face_vertices(HalfFaceId(t, state.mesh.local_index(t, v)));
      for (std::size_t k = 0; k < 3; ++k) {
        neighbours_[corners[k]].insert(corners[(k + 1) % 3]);
        neighbours_[corners[(k + 1) % 3]].insert(corners[k]);
      }
    }
  }

  std::vector<VertexId> find(VertexId a, VertexId b) {
    std::map<VertexId, VertexId> from = {{a, a}};
    std::vector<VertexId> queue = {a};
    for (std::size_t i = 0; i < queue.size() && !from.contains(b); ++i)
      for (VertexId w : neighbours_[queue[i]]) {
        if (from.contains(w) || !is_step(queue[i], w) || (w == b && queue[i] == a) || (w != b && !is_free(w))) continue;
        from[w] = queue[i];
        queue.push_back(w);
      }
    if (!from.contains(b)) return {};
    std::vector<VertexId> path = {b};
    while (path.back() != a) path.push_back(from[path.back()]);
    std::reverse(path.begin(), path.end());
    return path;
  }

 private:
  bool is_step(VertexId p, VertexId q) const {
    if (is_special(state_, edge_key(p, q))) return false;
    const HalfFaceId h = find_half_face(state_.mesh, face_key(v_, p, q));
    return h.valid() && !is_feature_face(state_, h) && ring_of(state_.mesh, p, q).closed;
  }

  bool is_free(VertexId w) const {
    if (on_boundary(state_.mesh, w)) return false;
    const auto edges = edges_at(state_.mesh, w);
    return std::none_of(edges.begin(), edges.end(), [&](const EdgeKey& e) { return is_special(state_, e); });
  }

  const RepairState& state_;
  VertexId v_;
  std::map<VertexId, std::set<VertexId>> neighbours_;
};

// The two edges of an arc at v that may go inside, one on the boundary first.
std::vector<EdgeKey> arc_to_push(const RepairState& state, VertexId v) {
  for (const EdgeKey& e : edges_at(state.mesh, v))
    if (state.features.edges.contains(e)) return {};
  std::vector<EdgeKey> arc = singular_edges_at(state, v);
  if (arc.size() != 2 || code_of(state, arc[0]) != code_of(state, arc[1]) || std::abs(code_of(state, arc[0])) != 1)
    return {};
  if (!is_boundary_edge(state, arc[0])) std::swap(arc[0], arc[1]);
  if (!is_boundary_edge(state, arc[0])) return {};
  return arc;
}

}  // namespace

bool push_inside(RepairState& state, VertexId v) {
  std::vector<EdgeKey> arc = arc_to_push(state, v);
  if (arc.empty()) return false;
  split_one_ring(state, v);
  arc = arc_to_push(state, v);
  if (arc.empty()) return false;
  const EdgeCode code = code_of(state, arc[0]);
  const std::vector<VertexId> path = LinkPath(state, v).find(other_end(arc[0], v), other_end(arc[1], v));
  if (path.size() < 3) return false;
  ZipPatch patch;
  patch.start = arc[0];
  patch.boundary = arc;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    patch.faces.push_back(face_key(v, path[i], path[i + 1]));
    patch.boundary.push_back(edge_key(path[i], path[i + 1]));
  }
  const FieldSnapshot before(state, tets_touching(state.mesh, patch.faces));
  if (!zip_patch(state, patch, octahedral::identity)) return false;
  bool good = !state.codes.contains(arc[0]) && !state.codes.contains(arc[1]);
  for (std::size_t i = 2; good && i < patch.boundary.size(); ++i) {
    const EdgeCode now = code_of(state, patch.boundary[i]);
    good = std::abs(now) == 1 || now == undetermined_code;
  }
  if (!good) {
    before.restore(state);
    return false;
  }
  // It is the same arc: edges that zigzag across its axis keep its sign (defect D2).
  for (std::size_t i = 2; i < patch.boundary.size(); ++i) state.codes[patch.boundary[i]] = code;
  return true;
}

}  // namespace hexfield
