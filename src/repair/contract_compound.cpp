#include "hexfield/repair/edge_repair.hpp"
#include "hexfield/repair/state_ops.hpp"

#include "remesh_context.hpp"
#include "strip_zipping.hpp"

namespace hexfield {
namespace {

bool has_compound_edge(const RepairState& state, VertexId v) {
  for (const EdgeKey& e : singular_edges_at(state, v))
    if (code_of(state, e) == compound_code) return true;
  return false;
}

bool contract(RepairState& state, VertexId from, VertexId to) {
  RepairState trial = state;
  const RemeshOptions options;
  RemeshReport report;
  RemeshContext context{trial, options, report};
  if (!try_collapse(context, VertexMarks(trial), from, to)) return false;
  if (!has_compound_edge(trial, to) && is_defect(trial, to)) return false;
  state = std::move(trial);
  return true;
}

}  // namespace

bool contract_compound_edge(RepairState& state, const EdgeKey& edge) {
  if (code_of(state, edge) != compound_code) return false;
  return contract(state, edge[0], edge[1]) || contract(state, edge[1], edge[0]);
}

}  // namespace hexfield
