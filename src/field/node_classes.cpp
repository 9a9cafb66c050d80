#include "hexfield/field/singularity_graph.hpp"

#include <algorithm>
#include <array>
#include <unordered_map>

#include "hexfield/field/edge_codes.hpp"

namespace hexfield {
namespace {

using octahedral::Label;

bool is_boundary_edge(const TetMesh& mesh, const EdgeKey& e) {
  return !edge_ring(mesh, find_tet_with_edge(mesh, e[0], e[1]), e[0], e[1]).closed;
}

bool on_boundary(const TetMesh& mesh, VertexId v) {
  for (TetId t : vertex_star(mesh, v))
    for (int f = 0; f < 4; ++f)
      if (mesh.vertices(t)[static_cast<std::size_t>(f)] != v && mesh.is_boundary(HalfFaceId(t, f))) return true;
  return false;
}

NodeKind inner_kind(const EdgeCounts& n, const std::vector<EdgeCode>& codes) {
  if (n.other > 0) {
    const bool two = codes.size() == 2;
    if (two && codes[0] == codes[1]) return NodeKind::arc;
    if (two && codes[0] == -codes[1]) return NodeKind::zipper;
    return NodeKind::invalid;
  }
  using Pair = std::array<int, 2>;
  const Pair pair{n.inner_minus, n.inner_plus};
  if (pair == Pair{0, 0} || pair == Pair{2, 0} || pair == Pair{0, 2}) return NodeKind::arc;
  if (pair == Pair{1, 1}) return NodeKind::zipper;
  constexpr Pair valid[] = {{4, 0}, {2, 2}, {1, 3}, {0, 4}, {2, 6}, {0, 6}, {0, 8}, {0, 12}};
  return std::find(std::begin(valid), std::end(valid), pair) != std::end(valid) ? NodeKind::node : NodeKind::invalid;
}

// Does the arc e leave the surface at v along an inward normal (arc), an outward normal (zipper), or is it
// parallel to the surface there (invalid)? The outgoing label is carried to the boundary faces at v.
NodeKind transversal_kind(const TetMesh& mesh, const FrameField& field, EdgeCode code, VertexId v, const EdgeKey& e) {
  const VertexId w = e[0] == v ? e[1] : e[0];
  const EdgeRing ring = edge_ring(mesh, find_tet_with_edge(mesh, v, w), v, w);
  const Label label = outgoing_label(mesh, field, ring, code, v, w);
  if (label == octahedral::no_label) return NodeKind::invalid;
  std::unordered_map<TetId, Label> labels;
  std::vector<TetId> queue;
  const auto around = transport_around(field, ring, label);
  for (std::size_t k = 0; k < ring.tets.size(); ++k) {
    labels.emplace(ring.tets[k], around[k]);
    queue.push_back(ring.tets[k]);
  }
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const TetId t = queue[i];
    for (int f = 0; f < 4; ++f) {
      if (mesh.vertices(t)[static_cast<std::size_t>(f)] == v) continue;
      const HalfFaceId h(t, f);
      if (mesh.is_boundary(h)) {
        const Label normal = closest_label(field.frames[t.index()], outward_normal(mesh, h));
        if (normal == labels.at(t)) return NodeKind::zipper;
        return normal == octahedral::negate(labels.at(t)) ? NodeKind::arc : NodeKind::invalid;
      }
      const TetId next = mesh.opposite_half_face(h).tet();
      if (labels.emplace(next, transport(field, h, labels.at(t))).second) queue.push_back(next);
    }
  }
  return NodeKind::invalid;
}

NodeKind boundary_kind(const EdgeCounts& n) {
  using Counts = std::array<int, 4>;
  const Counts c{n.boundary_minus, n.boundary_plus, n.inner_minus, n.inner_plus};
  if (n.other > 0) return NodeKind::invalid;
  if (c == Counts{0, 0, 0, 0} || c == Counts{2, 0, 0, 0} || c == Counts{0, 2, 0, 0}) return NodeKind::arc;
  constexpr Counts zippers[] = {{1, 1, 0, 0}, {1, 0, 0, 1}, {0, 1, 1, 0}};
  if (std::find(std::begin(zippers), std::end(zippers), c) != std::end(zippers)) return NodeKind::zipper;
  constexpr Counts valid[] = {{3, 0, 0, 0}, {2, 1, 0, 0}, {2, 2, 0, 0}, {1, 2, 0, 0}, {0, 3, 0, 0}, {0, 3, 0, 1},
                              {1, 2, 1, 0}, {0, 2, 0, 1}, {0, 2, 1, 0}, {0, 2, 1, 1}, {1, 2, 0, 1}};
  return std::find(std::begin(valid), std::end(valid), c) != std::end(valid) ? NodeKind::node : NodeKind::invalid;
}

// An arc that leaves a feature curve and goes on beside it: the curve has its code on one side of v only. Where the arc
// and the regular half of the curve leave v in parallel, they form a parabolic sector.
bool is_leaving_curve(const EdgeCounts& n, const Features& features, VertexId v, const std::vector<EdgeKey>& edges) {
  using Counts = std::array<int, 4>;
  const Counts c{n.boundary_minus, n.boundary_plus, n.inner_minus, n.inner_plus};
  if (n.other > 0 || (c != Counts{1, 0, 1, 0} && c != Counts{0, 1, 0, 1})) return false;
  const bool on_curve =
      std::any_of(edges.begin(), edges.end(), [&](const auto& e) { return features.edges.contains(e); });
  return on_curve && !features.points.contains(v);
}

// A boundary edge of code +2 with (2,2), (2,0) or (0,2) others is plausible.
bool is_flat_opening(const EdgeCounts& n, const std::vector<EdgeCode>& boundary_codes) {
  const auto twos = std::count(boundary_codes.begin(), boundary_codes.end(), 2);
  const int m = n.boundary_minus, p = n.boundary_plus;
  return n.other == 1 && twos == 1 && n.inner_minus + n.inner_plus == 0 &&
         ((m == 2 && p == 2) || (m == 2 && p == 0) || (m == 0 && p == 2));
}

}  // namespace

SingularNode classify_vertex(const TetMesh& mesh, const Features& features, const FrameField& field,
                             const EdgeCodes& codes, VertexId v, const std::vector<EdgeKey>& edges) {
  SingularNode node;
  node.vertex = v;
  std::vector<EdgeCode> inner, boundary;
  for (const EdgeKey& e : edges) {
    const EdgeCode code = codes.at(e);
    const bool outside = is_boundary_edge(mesh, e);
    (outside ? boundary : inner).push_back(code);
    if (code == compound_code || code == undetermined_code)
      ++node.counts.undetermined;
    else if (code == -1)
      ++(outside ? node.counts.boundary_minus : node.counts.inner_minus);
    else if (code == 1)
      ++(outside ? node.counts.boundary_plus : node.counts.inner_plus);
    else
      ++node.counts.other;
  }
  if (node.counts.undetermined > 0) {
    node.kind = NodeKind::compound;
  } else if (!on_boundary(mesh, v)) {
    node.kind = inner_kind(node.counts, inner);
  } else if (boundary.empty() && inner.size() == 1) {
    node.kind = transversal_kind(mesh, field, inner[0], v, edges[0]);
  } else if (is_flat_opening(node.counts, boundary)) {
    node.kind = NodeKind::node;
  } else if (is_leaving_curve(node.counts, features, v, edges)) {
    node.kind = NodeKind::zipper;
  } else {
    node.kind = boundary_kind(node.counts);
  }
  return node;
}

}  // namespace hexfield
