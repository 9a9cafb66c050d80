#include "hexfield/repair/vertex_repair.hpp"

#include <algorithm>
#include <functional>
#include <set>
#include <tuple>

#include "hexfield/field/singularity_graph.hpp"
#include "hexfield/repair/state_ops.hpp"

namespace hexfield {
namespace {

using Operation = std::function<bool(RepairState&, VertexId)>;

bool in_feature_surface(const RepairState& state, VertexId v) {
  for (TetId t : vertex_star(state.mesh, v))
    for (int f = 0; f < 4; ++f)
      if (state.mesh.vertices(t)[static_cast<std::size_t>(f)] != v && is_feature_face(state, HalfFaceId(t, f)))
        return true;
  return false;
}

Operation with(bool (*operation)(RepairState&, VertexId, const RingScope&), const RingScope& scope) {
  return [=](RepairState& state, VertexId v) { return operation(state, v, scope); };
}

std::vector<Operation> operations_for(const RepairState& state, VertexId v, const VertexRepairOptions& options) {
  const RingScope free, surface{RingTarget::surface_arc}, across{RingTarget::free_arc, true};
  std::vector<Operation> order{with(detach_arc, free), with(detach_zipper, free)};
  if (!in_feature_surface(state, v)) return order;
  const bool boundary = on_boundary(state.mesh, v);
  if (boundary) order.emplace_back([](RepairState& s, VertexId w) { return detach_to_boundary(s, w, Flow::through); });
  order.push_back(with(detach_arc, surface));
  order.push_back(with(detach_zipper, surface));
  order.push_back(with(detach_arc, across));
  order.push_back(with(detach_zipper, across));
  if (boundary) order.emplace_back([](RepairState& s, VertexId w) { return detach_to_boundary(s, w, Flow::parallel); });
  order.push_back(with(detach_arc, {RingTarget::any_edge, true, true}));
  if (!options.reversals) return order;
  order.push_back(with(unzip_arc, {RingTarget::any_edge}));
  order.push_back(with(reverse_sector, {RingTarget::any_edge}));
  order.emplace_back([](RepairState& s, VertexId w) { return unzip_transversally(s, w); });
  return order;
}

// What an operation must make less: vertices that counts of codes rule out, the centre by its map, and edges at the
// centre. Zipper nodes elsewhere may appear: they are resolved by unzipping.
struct Score {
  int invalid = 0;
  int zippers = 0;
  std::size_t edges = 0;
};

struct Near {
  std::set<VertexId> vertices;
  std::size_t first_new = 0;
};

Near near_of(const TetMesh& mesh, VertexId v) {
  Near near;
  near.first_new = mesh.num_vertices();
  for (TetId t : vertex_star(mesh, v)) near.vertices.insert(mesh.vertices(t).begin(), mesh.vertices(t).end());
  return near;
}

//
// `near`: the vertices of the one-ring before anything was split; those made since count too.
Score score_of(const RepairState& state, VertexId v, const Near& near, const VertexRepairOptions& options) {
  Score score;
  std::set<VertexId> ends;
  for (const auto& entry : state.codes)
    for (VertexId w : entry.first)
      if (w.index() >= near.first_new || near.vertices.contains(w)) ends.insert(w);
  for (VertexId w : ends) {
    if (w == v) continue;
    const auto singular = singular_edges_at(state, w);
    const NodeKind kind = classify_vertex(state.mesh, state.features, state.field, state.codes, w, singular).kind;
    score.invalid += kind == NodeKind::invalid || kind == NodeKind::compound;
    score.zippers += kind == NodeKind::zipper;
  }
  score.invalid += needs_repair(state, v, options);
  score.edges = singular_edges_at(state, v).size();
  return score;
}

bool better(const Score& now, const Score& before, bool was_zipper) {
  if (was_zipper) return now.invalid + now.zippers < before.invalid + before.zippers;
  return std::tie(now.invalid, now.edges) < std::tie(before.invalid, before.edges);
}

NodeKind kind_of(const RepairState& state, VertexId v) {
  return classify_vertex(state.mesh, state.features, state.field, state.codes, v, singular_edges_at(state, v)).kind;
}

}  // namespace

bool needs_repair(const RepairState& state, VertexId v, const VertexRepairOptions& options) {
  std::vector<EdgeKey> singular = singular_edges_at(state, v);
  for (const EdgeKey& e : singular)
    if (state.codes.at(e) == compound_code) return false;
  if (!singular.empty() && singular.size() <= 4) {
    const auto kind = classify_vertex(state.mesh, state.features, state.field, state.codes, v, singular).kind;
    if (kind == NodeKind::zipper || kind == NodeKind::invalid) return true;
  }
  return !vertex_meshable(state, v, options.map);
}

bool repair_vertex(RepairState& local, VertexId v, const VertexRepairOptions& options) {
  bool changed = false;
  const Near near = near_of(local.mesh, v);
  for (int round = 0; round < options.rounds && needs_repair(local, v, options); ++round) {
    const std::size_t singular = singular_edges_at(local, v).size();
    if (singular < 3 && !in_feature_surface(local, v)) break;
    const bool zipper = kind_of(local, v) == NodeKind::zipper;
    const Score before = score_of(local, v, near, options);
    bool success = false;
    for (const Operation& operation : operations_for(local, v, options)) {
      RepairState trial = local;
      if (!operation(trial, v) || !better(score_of(trial, v, near, options), before, zipper)) continue;
      local = std::move(trial);
      success = changed = true;
      break;
    }
    if (!success) break;
  }
  return changed;
}

}  // namespace hexfield
