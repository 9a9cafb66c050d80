#include "vertex_score.hpp"

#include <algorithm>

#include "hexfield/repair/state_ops.hpp"

namespace hexfield {
namespace {

NodeKind kind_of(const RepairState& state, VertexId v) {
  return classify_vertex(state.mesh, state.features, state.field, state.codes, v, singular_edges_at(state, v)).kind;
}

using RingOperation = bool (*)(RepairState&, VertexId, const RingScope&);

VertexOperation with(RingOperation operation, const RingScope& scope) {
  return [=](RepairState& state, VertexId v, const VertexAccept& accept) {
    RingScope asking = scope;
    asking.accept = accept;
    return operation(state, v, asking);
  };
}

bool detach_through(RepairState& state, VertexId v, const RingScope& scope) {
  return detach_to_boundary(state, v, Flow::through, scope);
}
bool detach_parallel(RepairState& state, VertexId v, const RingScope& scope) {
  return detach_to_boundary(state, v, Flow::parallel, scope);
}

}  // namespace

Near near_of(const TetMesh& mesh, VertexId v) {
  Near near;
  near.first_new = mesh.num_vertices();
  for (TetId t : vertex_star(mesh, v)) near.vertices.insert(mesh.vertices(t).begin(), mesh.vertices(t).end());
  return near;
}

bool is_feature_node(const RepairState& state, VertexId v) {
  return std::ranges::count_if(edges_at(state.mesh, v),
                               [&](const EdgeKey& e) { return state.features.edges.contains(e); }) > 2;
}

bool counts_are_good(const RepairState& state, VertexId v) {
  const NodeKind kind = kind_of(state, v);
  return kind == NodeKind::arc || kind == NodeKind::node || (kind != NodeKind::compound && is_feature_node(state, v));
}

namespace {

// An arc that leaves a feature curve beside it, and can only be unzipped along the curve to its end.
bool leaves_curve(const EdgeCounts& n) {
  return n.boundary_minus + n.boundary_plus == 1 && n.boundary_minus == n.inner_minus &&
         n.boundary_plus == n.inner_plus;
}

}  // namespace

VertexScore score_near(const RepairState& state, VertexId v, const Near& near) {
  const bool node = is_feature_node(state, v);
  VertexScore score;
  std::set<VertexId> ends;
  for (const auto& entry : state.codes)
    for (VertexId w : entry.first)
      if (w.index() >= near.first_new || near.vertices.contains(w)) ends.insert(w);
  for (VertexId w : ends) {
    if (w == v) continue;
    const auto [vertex, kind, counts] =
        classify_vertex(state.mesh, state.features, state.field, state.codes, w, singular_edges_at(state, w));
    const bool stuck = kind == NodeKind::zipper && !node && leaves_curve(counts);
    score.invalid += kind == NodeKind::invalid || kind == NodeKind::compound || stuck;
    score.zippers += kind == NodeKind::zipper && !stuck;
  }
  score.edges = singular_edges_at(state, v).size();
  return score;
}

VertexScore score_of(RepairState& state, VertexId v, const Near& near) {
  VertexScore score = score_near(state, v, near);
  score.sectors = parabolic_sectors(state, OneRing(state, v)).size();
  score.bad = score.sectors > 0 || !counts_are_good(state, v);
  return score;
}

std::vector<VertexOperation> vertex_operations(const RepairState& state, VertexId v, bool reversals) {
  const RingScope free, surface{RingTarget::surface_arc}, across{RingTarget::free_arc, true}, out{RingTarget::surface};
  std::vector<VertexOperation> order{with(detach_arc, free), with(detach_zipper, free)};
  if (!on_feature_face(state, v)) return order;
  const bool boundary = on_boundary(state.mesh, v);
  if (boundary) order.push_back(with(detach_through, out));
  order.push_back(with(detach_arc, surface));
  order.push_back(with(detach_zipper, surface));
  order.push_back(with(detach_arc, across));
  order.push_back(with(detach_zipper, across));
  if (boundary) order.push_back(with(detach_parallel, out));
  order.push_back(with(detach_arc, {RingTarget::any_edge, true, true}));
  if (reversals) {
    order.push_back(with(unzip_arc, {RingTarget::any_edge}));
    order.push_back(with(reverse_sector, {RingTarget::any_edge}));
  }
  return order;
}

std::vector<VertexOperation> sequence_operations(const RepairState& state, VertexId v) {
  std::vector<VertexOperation> operations{with(detach_arc, {RingTarget::any_edge, true, true, true}),
                                          with(detach_zipper, {RingTarget::any_edge, true})};
  if (on_boundary(state.mesh, v)) {
    operations.push_back(with(detach_through, {RingTarget::surface, false, true, true}));
    operations.push_back(with(detach_parallel, {RingTarget::surface}));
  }
  operations.push_back(with(unzip_transversally, {}));
  return operations;
}

}  // namespace hexfield
