#include "hexfield/repair/remesh.hpp"

#include <algorithm>

#include "hexfield/field/edge_codes.hpp"
#include "hexfield/mesh/quality.hpp"
#include "hexfield/repair/neighbourhood.hpp"
#include "hexfield/repair/state_ops.hpp"
#include "remesh_context.hpp"

namespace hexfield {
namespace {

void keep_alive(const TetMesh& mesh, std::vector<TetId>& tets) {
  std::erase_if(tets, [&](TetId t) { return t.index() >= mesh.num_tets() || !mesh.alive(t); });
  std::sort(tets.begin(), tets.end());
  tets.erase(std::unique(tets.begin(), tets.end()), tets.end());
}

// The region after some edits: what is left of it and what was touched.
std::vector<TetId> grown(const TetMesh& mesh, std::vector<TetId> region, const std::vector<TetId>& touched) {
  region.insert(region.end(), touched.begin(), touched.end());
  keep_alive(mesh, region);
  return region;
}

}  // namespace

VertexMarks::VertexMarks(const RepairState& state)
    : on_face(state.mesh.num_vertices(), 0), on_curve(on_face), singular(on_face) {
  for (const auto& [f, colour] : state.features.faces)
    for (VertexId v : f) on_face[v.index()] = 1;
  for (const auto& [e, colour] : state.features.edges)
    for (VertexId v : e) on_curve[v.index()] = 1;
  for (const auto& [e, code] : state.codes)
    for (VertexId v : e) singular[v.index()] = 1;
}

bool RemeshContext::editable(std::span<const TetId> tets) const {
  return !options.editable || std::all_of(tets.begin(), tets.end(), options.editable);
}

void RemeshContext::touch_new(std::size_t first_slot) {
  for (std::size_t i = first_slot; i < state.mesh.num_tets(); ++i)
    report.touched.emplace_back(static_cast<std::int64_t>(i));
}

double RemeshContext::relative_length(const EdgeKey& e) const {
  const double target = (state.target_length[e[0].index()] + state.target_length[e[1].index()]) / 2;
  return (state.mesh.point(e[0]) - state.mesh.point(e[1])).norm() / target;
}

EdgeCode computed_code(const RepairState& state, const EdgeKey& e, TetId seed) {
  return edge_code(state.mesh, state.features, state.field, edge_ring(state.mesh, seed, e[0], e[1]), e[0], e[1]);
}

double worst_distortion(const TetMesh& mesh, std::span<const TetId> tets) {
  double worst = 0;
  for (TetId t : tets) worst = std::max(worst, tet_distortion(mesh, t));
  return worst;
}

std::vector<SizedEdge> sized_edges(const RemeshContext& context, std::span<const TetId> tets) {
  std::vector<SizedEdge> edges;
  for (const auto& [e, seed] : edges_with_tets(context.state.mesh, tets))
    edges.push_back({e, seed, context.relative_length(e)});
  return edges;
}

void sort_by_length(std::vector<SizedEdge>& edges, bool longest_first) {
  std::stable_sort(edges.begin(), edges.end(), [&](const SizedEdge& a, const SizedEdge& b) {
    return longest_first ? a.length > b.length : a.length < b.length;
  });
}

RemeshReport remesh(RepairState& state, std::span<const TetId> region, const RemeshOptions& options) {
  RemeshReport report;
  RemeshContext context{state, options, report};
  std::vector<TetId> tets = grown(state.mesh, {region.begin(), region.end()}, {});
  if (options.split) split_pass(context, tets);
  tets = grown(state.mesh, std::move(tets), report.touched);
  if (options.collapse) collapse_pass(context, tets);
  tets = grown(state.mesh, std::move(tets), report.touched);
  if (options.swap) swap_pass(context, tets);
  keep_alive(state.mesh, report.touched);
  return report;
}

RemeshReport remesh_near_singularities(RepairState& state, const RemeshOptions& options) {
  std::vector<VertexId> seeds;
  for (const auto& [e, code] : state.codes)
    if (!state.features.edges.contains(e)) seeds.insert(seeds.end(), e.begin(), e.end());
  std::sort(seeds.begin(), seeds.end());
  seeds.erase(std::unique(seeds.begin(), seeds.end()), seeds.end());
  return remesh(state, tets_around(state.mesh, seeds, 1), options);
}

}  // namespace hexfield
