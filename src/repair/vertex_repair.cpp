#include "hexfield/repair/vertex_repair.hpp"

#include <tuple>

#include "hexfield/repair/state_ops.hpp"

#include "vertex_score.hpp"

namespace hexfield {
namespace {

NodeKind kind_of(const RepairState& state, VertexId v) {
  return classify_vertex(state.mesh, state.features, state.field, state.codes, v, singular_edges_at(state, v)).kind;
}

bool better(const VertexScore& now, const VertexScore& before, bool was_zipper) {
  const int bad_now = now.invalid + now.bad, bad_before = before.invalid + before.bad;
  if (was_zipper) return bad_now + now.zippers < bad_before + before.zippers;
  return std::tie(bad_now, now.sectors, now.edges) < std::tie(bad_before, before.sectors, before.edges);
}

// A map that was not found is no reason for new arcs: something must be wrong to see.
bool shows_defect(RepairState& state, VertexId v) {
  const NodeKind kind = kind_of(state, v);
  return (kind != NodeKind::arc && kind != NodeKind::node) || !parabolic_sectors(state, OneRing(state, v)).empty();
}

// One operation after the other, each of which makes the vertex better.
bool repair_step_by_step(RepairState& local, VertexId v, const VertexRepairOptions& options) {
  const Near near = near_of(local.mesh, v);
  const bool surface = vertex_operations(local, v, false).size() > 2;
  for (int round = 0; round < options.rounds; ++round) {
    if (singular_edges_at(local, v).size() < 3 && !surface) return round > 0;
    const VertexScore before = score_of(local, v, near);
    if (round > 0 && !before.bad) return true;
    const bool zipper = kind_of(local, v) == NodeKind::zipper;
    const VertexAccept accept = [&](RepairState& trial) {
      trial.begin_operation(work_of_judging * trial.mesh.num_tets());
      return better(score_of(trial, v, near), before, zipper);
    };
    bool success = false;
    for (const VertexOperation& operation : vertex_operations(local, v, options.reversals)) {
      RepairState trial = local;
      trial.begin_operation(trial.mesh.num_tets());
      if (!operation(trial, v, accept)) continue;
      local = std::move(trial);
      success = true;
      break;
    }
    if (!success) return round > 0;
  }
  return true;
}

}  // namespace

VertexNeed need_of_repair(const RepairState& state, VertexId v, const VertexRepairOptions& options) {
  std::vector<EdgeKey> singular = singular_edges_at(state, v);
  for (const EdgeKey& e : singular)
    if (state.codes.at(e) == compound_code) return {};
  if (!singular.empty() && singular.size() <= 4 && !counts_are_good(state, v)) return {true, {}, {}};
  if (is_trivially_regular(state, v)) return {};
  VertexNeed need;
  need.verdict = vertex_verdict(state, v, options.map, nullptr, &need.key);
  need.repair = need.verdict == VertexVerdict::not_meshable;
  return need;
}

bool repair_vertex(RepairState& local, VertexId v, const VertexRepairOptions& options) {
  if (!needs_repair(local, v, options)) return false;
  const bool changed = repair_step_by_step(local, v, options);
  if (!is_feature_node(local, v) || !shows_defect(local, v) || !needs_repair(local, v, options)) return changed;
  return repair_by_sequence(local, v, options) || changed;
}

}  // namespace hexfield
