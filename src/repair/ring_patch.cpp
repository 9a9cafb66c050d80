#include "hexfield/repair/ring_patch.hpp"

#include <algorithm>
#include <set>

#include "hexfield/repair/state_ops.hpp"

namespace hexfield {
namespace {

EdgeKey link_edge(const TetMesh& mesh, HalfFaceId h, VertexId v) {
  const auto f = mesh.face_vertices(h);
  const auto i = static_cast<std::size_t>(std::find(f.begin(), f.end(), v) - f.begin());
  return edge_key(f[(i + 1) % 3], f[(i + 2) % 3]);
}

// The strip of link triangles of a path, with vertices told apart each time the strip comes back to them.
class Strip {
 public:
  Strip(const RepairState& state, VertexId v, const RingPath& path) : state_(state), v_(v), path_(path) {
    for (std::size_t k = 0; k < path.tets.size(); ++k) {
      Corners now;
      for (VertexId w : state.mesh.vertices(path.tets[k])) {
        if (w == v) continue;
        const bool goes_on = k > 0 && corners_.back().contains(w) && shared(k - 1, w);
        now[w] = goes_on ? corners_.back().at(w) : add_node(w);
      }
      corners_.push_back(now);
    }
  }

  // Shortest chain through vertices that are nothing special; empty when there is none.
  std::vector<VertexId> shortest_chain(Flow flow) const {
    const int from = corners_.front().at(path_.from), to = corners_.back().at(path_.to);
    std::vector<int> parent(nodes_.size(), -2);
    std::vector<int> queue{from};
    parent[static_cast<std::size_t>(from)] = -1;
    for (std::size_t i = 0; i < queue.size() && parent[static_cast<std::size_t>(to)] == -2; ++i)
      for (int next : neighbours(queue[i])) {
        if (parent[static_cast<std::size_t>(next)] != -2 || (next != to && !is_plain(next))) continue;
        if (flow == Flow::parallel && queue[i] == from && next == to) continue;
        if (!is_open(node(queue[i]), node(next))) continue;
        parent[static_cast<std::size_t>(next)] = queue[i];
        queue.push_back(next);
      }
    std::vector<VertexId> chain;
    if (parent[static_cast<std::size_t>(to)] == -2) return chain;
    for (int n = to; n >= 0; n = parent[static_cast<std::size_t>(n)]) chain.push_back(node(n));
    std::reverse(chain.begin(), chain.end());
    if (std::set<VertexId>(chain.begin(), chain.end()).size() != chain.size()) chain.clear();
    return chain;
  }

 private:
  using Corners = std::map<VertexId, int>;

  VertexId node(int n) const { return nodes_[static_cast<std::size_t>(n)]; }
  int add_node(VertexId w) {
    nodes_.push_back(w);
    return static_cast<int>(nodes_.size()) - 1;
  }
  bool shared(std::size_t k, VertexId w) const {
    const EdgeKey e = link_edge(state_.mesh, path_.faces[k], v_);
    return e[0] == w || e[1] == w;
  }
  std::vector<int> neighbours(int n) const {
    std::set<int> found;
    for (const Corners& c : corners_) {
      const bool here = std::any_of(c.begin(), c.end(), [&](const auto& x) { return x.second == n; });
      for (const auto& [w, other] : c)
        if (here && other != n) found.insert(other);
    }
    return {found.begin(), found.end()};
  }
  bool is_plain(int n) const {
    const EdgeKey spoke = edge_key(v_, node(n));
    return !is_special(state_, spoke) && !in_feature_face(state_, spoke);
  }
  bool is_open(VertexId a, VertexId b) const {
    const HalfFaceId h = find_half_face(state_.mesh, face_key(v_, a, b));
    return !is_feature_face(state_, h) && !is_special(state_, edge_key(a, b)) &&
           !in_feature_face(state_, edge_key(a, b));
  }

  const RepairState& state_;
  VertexId v_;
  const RingPath& path_;
  std::vector<Corners> corners_;
  std::vector<VertexId> nodes_;
};

// Splits the link edges that the path crosses, and the one at its exit: the chain of their middles.
std::vector<VertexId> split_chain(RepairState& state, VertexId v, const RingPath& path) {
  std::vector<EdgeKey> crossed;
  for (std::size_t k = 0; k < path.faces.size(); ++k) {
    const HalfFaceId h = path.faces[k];
    const EdgeKey e = link_edge(state.mesh, h, v);
    if (e[0] == path.from || e[1] == path.from || e[0] == path.to || e[1] == path.to) return {};
    if (is_special(state, e) || (in_feature_face(state, e) && !is_feature_face(state, h))) return {};
    crossed.push_back(e);
  }
  if (path.exit.valid()) {
    const EdgeKey e = link_edge(state.mesh, path.exit, v);
    // The spoke itself may bound the exit: then the chain is one edge on the boundary, which is no detour.
    if (is_special(state, e) || e[0] == path.from || e[1] == path.from) return {};
    crossed.push_back(e);
  } else if (crossed.empty()) {
    return {};
  }
  std::vector<VertexId> chain{path.from};
  for (const EdgeKey& e : crossed) chain.push_back(split_edge(state, e[0], e[1]));
  if (!path.exit.valid()) chain.push_back(path.to);
  return chain;
}

}  // namespace

std::optional<RingPatch> ring_patch(RepairState& state, VertexId v, const RingPath& path, Flow flow) {
  RingPatch found;
  if (!path.exit.valid()) found.chain = Strip(state, v, path).shortest_chain(flow);
  if (found.chain.empty() && path.to.valid() && flow == Flow::parallel && path.faces.empty()) {
    // Both spokes belong to one tet: its link edge gets the inner vertex.
    const EdgeKey e = edge_key(path.from, path.to);
    if (!is_special(state, e) && !in_feature_face(state, e))
      found.chain = {path.from, split_edge(state, e[0], e[1]), path.to};
  }
  if (found.chain.empty()) found.chain = split_chain(state, v, path);
  if (found.chain.size() < 2) return std::nullopt;
  found.patch.start = edge_key(v, path.from);
  found.patch.boundary.push_back(found.patch.start);
  if (path.to.valid()) found.patch.boundary.push_back(edge_key(v, path.to));
  for (std::size_t i = 0; i + 1 < found.chain.size(); ++i) {
    found.patch.faces.push_back(face_key(v, found.chain[i], found.chain[i + 1]));
    found.patch.boundary.push_back(edge_key(found.chain[i], found.chain[i + 1]));
  }
  return found;
}

}  // namespace hexfield
