#include <algorithm>
#include <map>
#include <set>

#include "hexfield/repair/state_ops.hpp"
#include "hexfield/repair/zipper_nodes.hpp"
#include "hexfield/repair/zipping.hpp"

namespace hexfield {
namespace {

// Boundary edges of the tets at v that do not contain v and are no features: where a fan at v may end.
std::map<VertexId, std::vector<VertexId>> boundary_link(const RepairState& state, VertexId v) {
  std::set<EdgeKey> edges;
  for (TetId t : vertex_star(state.mesh, v))
    for (const auto& e : tet_edge_vertices) {
      const VertexId a = state.mesh.vertices(t)[static_cast<std::size_t>(e[0])];
      const VertexId b = state.mesh.vertices(t)[static_cast<std::size_t>(e[1])];
      if (a == v || b == v || is_special(state, edge_key(a, b))) continue;
      if (!ring_of(state.mesh, a, b).closed) edges.insert(edge_key(a, b));
    }
  std::map<VertexId, std::vector<VertexId>> next;
  for (const EdgeKey& e : edges)
    for (VertexId end : e) next[end].push_back(other_end(e, end));
  return next;
}

// Shortest chain of link vertices from `from` to `to`, none of whose inner vertices is special (breadth first, ids
// ascending); empty when there is none.
std::vector<VertexId> chain_between(const RepairState& state, VertexId v, VertexId from, VertexId to) {
  const auto next = boundary_link(state, v);
  std::map<VertexId, VertexId> before{{from, from}};
  std::vector<VertexId> queue{from};
  for (std::size_t i = 0; i < queue.size() && !before.contains(to); ++i) {
    const auto here = next.find(queue[i]);
    if (here == next.end()) continue;
    for (VertexId w : here->second) {
      if (before.contains(w)) continue;
      const bool free =
          !is_special(state, edge_key(v, w)) && singular_edges_at(state, w).empty() && !on_feature_edge(state, w);
      if (w != to && !free) continue;
      before[w] = queue[i];
      queue.push_back(w);
    }
  }
  if (!before.contains(to)) return {};
  std::vector<VertexId> chain{to};
  while (chain.back() != from) chain.push_back(before.at(chain.back()));
  return chain;
}

bool zip_to_boundary(RepairState& state, VertexId v, const ZipperOptions& options) {
  const auto arcs = singular_edges_at(state, v);
  if (arcs.size() != 2 || on_boundary(state.mesh, v)) return false;
  std::array<VertexId, 2> ends{};
  for (std::size_t i = 0; i < 2; ++i) {
    ends[i] = other_end(arcs[i], v);
    if (std::abs(code_of(state, arcs[i])) != 1 || !on_boundary(state.mesh, ends[i])) return false;
    if (singular_edges_at(state, ends[i]).size() != 1 || on_feature_edge(state, ends[i])) return false;
  }
  if (code_of(state, arcs[0]) != -code_of(state, arcs[1])) return false;
  const auto chain = chain_between(state, v, ends[0], ends[1]);
  ZipPatch patch;
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    patch.faces.push_back(face_key(v, chain[i], chain[i + 1]));
    const HalfFaceId h = find_half_face(state.mesh, patch.faces.back());
    if (!h.valid() || is_feature_face(state, h)) return false;
  }
  if (patch.faces.empty()) return false;
  patch.start = arcs[0];
  patch.boundary = {arcs[0], arcs[1]};
  ZipOptions zip;
  zip.sweeps = options.sweeps;
  if (!zip_patch(state, patch, octahedral::identity, zip)) return false;
  for (const EdgeKey& e : arcs) state.pairs.erase(e);
  return true;
}

}  // namespace

int zip_near_boundary(RepairState& state, const ZipperOptions& options) {
  int zipped = 0;
  std::vector<VertexId> nodes;
  for (const FlowChain& chain : flow_chains(state))
    if (chain.vertices.size() == 3 && chain.zippers.size() == 1 && !chain.closed) nodes.push_back(chain.vertices[1]);
  std::sort(nodes.begin(), nodes.end());
  for (VertexId v : nodes) zipped += zip_to_boundary(state, v, options) ? 1 : 0;
  return zipped;
}

}  // namespace hexfield
