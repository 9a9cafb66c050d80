#include "hexfield/field/singularity_graph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "hexfield/field/edge_codes.hpp"

namespace hexfield {
namespace {

// Singular edges by vertex, and which of them lie on the boundary.
struct Net {
  std::map<VertexId, std::vector<EdgeKey>> at;
  std::map<EdgeKey, bool> boundary;
};

Net net_of(const TetMesh& mesh, const EdgeCodes& codes) {
  Net net;
  for (const auto& entry : codes) {
    const EdgeKey& e = entry.first;
    for (VertexId v : e) net.at[v].push_back(e);
    net.boundary[e] = !edge_ring(mesh, find_tet_with_edge(mesh, e[0], e[1]), e[0], e[1]).closed;
  }
  return net;
}

bool passes(const Net& net, const EdgeCodes& codes, VertexId v) {
  const auto& edges = net.at.at(v);
  return edges.size() == 2 && codes.at(edges[0]) == codes.at(edges[1]) &&
         net.boundary.at(edges[0]) == net.boundary.at(edges[1]);
}

SingularArc walk(const Net& net, const EdgeCodes& codes, EdgeKey edge, VertexId from, std::set<EdgeKey>& used) {
  SingularArc arc;
  arc.code = codes.at(edge);
  arc.boundary = net.boundary.at(edge);
  arc.vertices = {from};
  for (;;) {
    const VertexId to = edge[0] == from ? edge[1] : edge[0];
    arc.vertices.push_back(to);
    if (!passes(net, codes, to)) break;
    const auto& two = net.at.at(to);
    const EdgeKey next = two[0] == edge ? two[1] : two[0];
    if (!used.insert(next).second) break;
    edge = next;
    from = to;
  }
  arc.closed = arc.vertices.size() > 2 && arc.vertices.front() == arc.vertices.back();
  return arc;
}

}  // namespace

const char* name(NodeKind kind) {
  switch (kind) {
    case NodeKind::arc:
      return "arc";
    case NodeKind::node:
      return "node";
    case NodeKind::zipper:
      return "zipper";
    case NodeKind::compound:
      return "compound";
    case NodeKind::invalid:
      return "invalid";
  }
  return "invalid";
}

SingularityGraph singularity_graph(const TetMesh& mesh, const Features& features, const FrameField& field,
                                   const EdgeCodes& codes) {
  const Net net = net_of(mesh, codes);
  SingularityGraph graph;
  for (const auto& entry : codes) ++graph.edges[entry.second];
  std::set<EdgeKey> used;
  for (const auto& [v, edges] : net.at)
    if (!passes(net, codes, v))
      for (const EdgeKey& e : edges)
        if (used.insert(e).second) graph.arcs.push_back(walk(net, codes, e, v, used));
  for (const auto& entry : codes)
    if (used.insert(entry.first).second) graph.arcs.push_back(walk(net, codes, entry.first, entry.first[0], used));
  for (const auto& [v, edges] : net.at) {
    const SingularNode node = classify_vertex(mesh, features, field, codes, v, edges);
    if (!passes(net, codes, v) || node.kind == NodeKind::zipper || node.kind == NodeKind::compound)
      graph.nodes.push_back(node);
  }
  return graph;
}

std::vector<Violation> check(const TetMesh& mesh, const FrameField& field, const EdgeCodes& codes,
                             const SingularityGraph& graph) {
  std::vector<Violation> found;
  auto report = [&](const EdgeKey& e, const char* what) {
    found.push_back({fmt::format("Edge ({}, {}) {}.", e[0].value, e[1].value, what),
                     {e[0].value, e[1].value},
                     {(mesh.point(e[0]) + mesh.point(e[1])) / 2}});
  };
  for (const auto& [edge, tet] : all_edges(mesh)) {
    const EdgeRing ring = edge_ring(mesh, tet, edge[0], edge[1]);
    if (!ring.closed) continue;
    const auto m = monodromy(field, ring);
    const auto code = codes.find(edge);
    const int turns = code == codes.end() ? 0 : ((code->second % 4) + 4) % 4;
    const bool half = m >= 1 && m < 4;
    if (code == codes.end() && m != octahedral::identity) report(edge, "has a monodromy but no code");
    if (code == codes.end() || code->second == compound_code || code->second == undetermined_code) continue;
    if (octahedral::is_compound(m) || (m == octahedral::identity) != (turns == 0) || half != (turns == 2))
      report(edge, "has a code that does not fit its monodromy");
  }
  for (const SingularArc& arc : graph.arcs)
    for (std::size_t i = 0; i + 1 < arc.vertices.size(); ++i) {
      const auto code = codes.find(edge_key(arc.vertices[i], arc.vertices[i + 1]));
      if (code == codes.end() || code->second != arc.code)
        report(edge_key(arc.vertices[i], arc.vertices[i + 1]), "belongs to an arc of another code");
    }
  return found;
}

}  // namespace hexfield
