#include "hexfield/repair/free_ends.hpp"

#include <algorithm>
#include <map>

#include "hexfield/repair/one_ring.hpp"
#include "hexfield/repair/state_ops.hpp"
#include "hexfield/repair/vertex_repair.hpp"

namespace hexfield {
namespace {

struct EdgesAt {
  std::vector<EdgeCode> curve;  // codes of feature edges
  std::vector<EdgeKey> arcs;    // other singular edges
};

bool is_end_on_curve(const TetMesh& mesh, const EdgesAt& edges) {
  if (edges.arcs.size() != 1 || edges.curve.size() != 2 || edges.curve[0] != edges.curve[1]) return false;
  return ring_of(mesh, edges.arcs[0][0], edges.arcs[0][1]).closed;
}

}  // namespace

std::vector<VertexId> ends_on_curves(const RepairState& state) {
  std::map<VertexId, EdgesAt> at;
  for (const auto& entry : state.features.edges)
    for (VertexId v : entry.first) at[v].curve.push_back(code_of(state, entry.first));
  for (const auto& entry : state.codes)
    if (!state.features.edges.contains(entry.first))
      for (VertexId v : entry.first)
        if (const auto found = at.find(v); found != at.end()) found->second.arcs.push_back(entry.first);
  std::vector<VertexId> ends;
  for (const auto& [v, edges] : at)
    if (is_end_on_curve(state.mesh, edges) && !state.features.points.contains(v)) ends.push_back(v);
  return ends;
}

bool free_arc_end(RepairState& local, VertexId v) {
  RepairState trial = local;
  if (!detach_to_boundary(trial, v, Flow::through)) return false;
  for (VertexId w : vertices_of(trial.mesh, vertex_star(trial.mesh, v)))
    if (needs_repair(trial, w)) return false;
  local = std::move(trial);
  return true;
}

}  // namespace hexfield
