#include "schedule.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hexfield/base/agree.hpp"
#include "hexfield/base/error.hpp"
#include "hexfield/base/parallel.hpp"
#include "hexfield/base/stopwatch.hpp"
#include "hexfield/field/align_field.hpp"
#include "hexfield/field/constraints.hpp"
#include "hexfield/field/matchings.hpp"
#include "hexfield/field/presplit.hpp"
#include "hexfield/field/singularity_graph.hpp"
#include "hexfield/mesh/quality.hpp"
#include "hexfield/repair/constrained_zippers.hpp"
#include "hexfield/repair/edge_repair.hpp"
#include "hexfield/repair/free_ends.hpp"
#include "hexfield/repair/merge_arcs.hpp"
#include "hexfield/repair/meshability.hpp"
#include "hexfield/repair/neighbourhood_loop.hpp"
#include "hexfield/repair/relocation.hpp"
#include "hexfield/repair/remesh.hpp"
#include "hexfield/repair/state_ops.hpp"
#include "hexfield/repair/vertex_repair.hpp"
#include "hexfield/repair/zipper_nodes.hpp"

namespace hexfield {
namespace {

constexpr int isolation_passes = 4;
constexpr int relocation_sweeps = 50;  // spec-lmff section 4
constexpr int remesh_sweeps = 10;
constexpr std::size_t work_of_sweeps = 3;  // what they cost, in RepairWatch::work per tet
constexpr int relocation_rings = 3;
constexpr int final_sweeps = 100;

std::vector<EdgeKey> special_edges(const RepairState& state) {
  std::vector<EdgeKey> edges;
  for (const auto& entry : state.codes) edges.push_back(entry.first);
  for (const auto& entry : state.features.edges) edges.push_back(entry.first);
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

std::vector<VertexId> vertices_of(const std::vector<EdgeKey>& edges) {
  std::vector<VertexId> vertices;
  for (const EdgeKey& e : edges) vertices.insert(vertices.end(), e.begin(), e.end());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

// Vertices of special edges that need repair, those with few singular edges first (spec-lmff section 5.5). Zipper nodes
// on curves wait for a partner: alone they would leave through whatever surface is near. `memory` gives the verdicts of
// one-rings that are as they were and takes all there are now.
std::vector<Place> vertices_to_repair(const RepairState& state, VerdictMemory& memory) {
  const std::vector<VertexId> all = vertices_of(special_edges(state));
  VertexRepairOptions options;
  options.map.memory = &memory;
  std::vector<VertexNeed> needs(all.size());
  parallel_for(all.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      needs[i] = need_of_repair(state, all[i], options);
      if (needs[i].repair && is_zipper_on_curve(state, all[i])) needs[i].repair = false;
    }
  });
  VerdictMemory now;
  std::vector<std::pair<std::size_t, VertexId>> order;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (needs[i].key) now.note(*needs[i].key, needs[i].verdict);
    if (needs[i].repair) order.emplace_back(singular_edges_at(state, all[i]).size(), all[i]);
  }
  memory = std::move(now);
  std::sort(order.begin(), order.end());
  std::vector<Place> places;
  for (const auto& entry : order) places.push_back({{entry.second}, 1});
  return places;
}

std::vector<EdgeKey> singular_edges(const RepairState& state) {
  std::vector<EdgeKey> edges;
  for (const auto& entry : state.codes) edges.push_back(entry.first);
  return edges;
}

}  // namespace

Schedule::Schedule(RepairIterate& iterate, const FieldResult& input, const RepairOptions& options,
                   const RepairControl& control)
    : iterate_(iterate),
      state_(iterate.state),
      options_(options),
      control_(control),
      surface_(input.mesh, input.features),
      curves_(input.mesh, input.features),
      volume_(total_volume(input.mesh)) {}

template <class Work>
void Schedule::timed(const std::string& kind, const Work& work) {
  // Whoever goes on repeats this iteration: the iterate of the last one is the newest that can be taken up.
  state_.begin_operation(0);
  if (control_.progress) control_.progress(kind, -1);
  const Clock::time_point start = Clock::now();
  const long done = work();
  iterate_.report.seconds[kind] += seconds_since(start);
  if (done > 0) iterate_.report.operations[kind] += done;
}

void Schedule::isolate() {
  const StateAttributes attributes(state_);
  for (int pass = 0; pass < isolation_passes; ++pass) {
    int splits = split_for_singularities(state_.mesh, state_.features, state_.codes, attributes.all());
    splits += split_for_features(state_.mesh, state_.features, attributes.all());
    if (splits == 0) break;
  }
  compact(state_);
}

void Schedule::repair_edges_and_vertices(bool first_stage) {
  timed("repair edges", [&] {
    EdgeRepairOptions options;
    options.compound_inside = !first_stage;
    return repair_edges(state_, options).total();
  });
  timed("repair vertices", [&] {
    const std::vector<Place> places = vertices_to_repair(state_, iterate_.verdicts);
    VertexRepairOptions options;
    options.map.memory = &iterate_.verdicts;
    const auto commits = for_places(state_, places, [&](Neighbourhood& copy, std::span<const VertexId> seeds) {
      return repair_vertex(copy.local, seeds[0], options);
    });
    return std::count(commits.begin(), commits.end(), 1);
  });
  timed("repair constrained zipper nodes", [&] { return repair_constrained_zipper_nodes(state_); });
}

void Schedule::repair_zippers() {
  timed("zip near the boundary", [&] { return zip_near_boundary(state_); });
  timed("unzip free zipper nodes", [&] { return unzip_free_zipper_nodes(state_); });
}

void Schedule::relocate() {
  timed("remesh near arcs", [&] {
    const RemeshReport report = remesh_near_singularities(state_);
    smooth(state_, report.touched, remesh_sweeps);
    return report.splits + report.collapses + report.swaps;
  });
  timed("relocate", [&] {
    RelocationOptions options;
    options.alignment = options_.alignment_weight;
    options.compound_shrink = iterate_.compound_shrink;
    options.zipper_shrink = iterate_.zipper_shrink;
    options.volume = volume_;
    return relocate_singularities(state_, surface_, curves_, options).vertices;
  });
  timed("smooth near arcs", [&] {
    const std::vector<TetId> near = tets_around(state_.mesh, vertices_of(singular_edges(state_)), relocation_rings);
    state_.begin_operation(work_of_sweeps * near.size());
    smooth_to_features(state_, near, relocation_sweeps);
    update_codes(state_, singular_edges(state_));
    return 0;
  });
}

bool Schedule::meshable() {
  std::size_t defects = 0;
  timed("check", [&] {
    defects = unrefuted_defects(state_).size();
    if (defects > 0) return 0;
    const std::vector<EdgeKey> edges = special_edges(state_);
    const VerdictMemory maps = iterate_.verdicts.found();
    VertexMapOptions options;
    options.memory = &maps;
    Meshability found = check_meshability(state_, edges, vertices_of(edges), options);
    iterate_.verdicts = std::move(found.verdicts);
    defects = found.bad_edges.size() + found.bad_vertices.size();
    return 0;
  });
  note_progress(static_cast<int>(defects));
  return defects == 0;
}

// Defects that stay although nothing else works shrink away the faster (spec-lmff section 5.7).
void Schedule::note_progress(int defects) {
  const bool fewer = iterate_.fewest_defects < 0 || defects < iterate_.fewest_defects;
  iterate_.stale_rounds = fewer ? 0 : iterate_.stale_rounds + 1;
  if (fewer) iterate_.fewest_defects = defects;
  if (fewer) return;
  iterate_.compound_shrink *= 2;
  iterate_.zipper_shrink *= 2;
}

void Schedule::free_ends() {
  timed("free arc ends from curves", [&] {
    std::vector<Place> places;
    for (VertexId v : ends_on_curves(state_)) places.push_back({{v}, 1});
    const auto commits = for_places(state_, places, [](Neighbourhood& copy, std::span<const VertexId> seeds) {
      return free_arc_end(copy.local, seeds[0]);
    });
    return std::count(commits.begin(), commits.end(), 1);
  });
}

void Schedule::finish() {
  free_ends();
  timed("merge crossing arcs", [&] { return merge_crossing_arcs(state_); });
  timed("separate arcs and features", [&] {
    unify_codes(state_.mesh, state_.field, state_.codes);
    isolate();
    return 0;
  });
  align_everywhere();
  timed("remesh everywhere", [&] {
    PostRemeshOptions options;
    options.rounds = options_.post_remesh_rounds;
    post_remesh(state_, surface_, curves_, options);
    isolate();
    remove_unused(state_);
    comb(state_.mesh, state_.field);
    return 0;
  });
  align_everywhere();
}

void Schedule::align_everywhere() {
  timed("align everywhere", [&] {
    const auto constraints = collect_constraints(state_.mesh, state_.features, state_.field, state_.codes);
    const DistributedMesh alone(MPI_COMM_SELF, state_.mesh);
    AlignOptions options;
    options.sweeps = final_sweeps;
    align_field(alone, state_.field, constraints, options);
    return 0;
  });
}

void Schedule::end_iteration() {
  compact(state_);
  ++iterate_.report.iterations;
  iterate_.report.work = state_.watch->work;
  // Asked first, so that the checkpoint is written when the run ends here.
  const bool stop = control_.stop_requested && control_.stop_requested();
  if (control_.checkpoint) control_.checkpoint(iterate_);
  if (stop) state_.begin_operation(0);
}

}  // namespace hexfield
