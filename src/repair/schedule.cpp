#include "schedule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "hexfield/base/agree.hpp"
#include "hexfield/base/error.hpp"
#include "hexfield/field/align_field.hpp"
#include "hexfield/field/constraints.hpp"
#include "hexfield/field/matchings.hpp"
#include "hexfield/field/presplit.hpp"
#include "hexfield/field/singularity_graph.hpp"
#include "hexfield/repair/neighbourhood.hpp"
#include "hexfield/repair/relocation.hpp"
#include "hexfield/repair/remesh.hpp"
#include "hexfield/repair/state_ops.hpp"
#include "hexfield/repair/zipper_nodes.hpp"

namespace hexfield {
namespace {

constexpr int isolation_passes = 4;
constexpr int relocation_sweeps = 50;  // spec-lmff section 4
constexpr int remesh_sweeps = 10;
constexpr int relocation_rings = 3;
constexpr int final_sweeps = 100;

double volume_of(const TetMesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.num_tets(); ++i)
    if (const TetId t(static_cast<std::int64_t>(i)); mesh.alive(t)) sum += signed_volume6(mesh, t) / 6;
  return sum;
}

std::vector<EdgeKey> singular_edges(const RepairState& state) {
  std::vector<EdgeKey> edges;
  for (const auto& entry : state.codes) edges.push_back(entry.first);
  return edges;
}

std::vector<VertexId> singular_vertices(const RepairState& state) {
  std::vector<VertexId> vertices;
  for (const auto& entry : state.codes) vertices.insert(vertices.end(), entry.first.begin(), entry.first.end());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
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
      volume_(volume_of(input.mesh)) {}

template <class Work>
void Schedule::timed(const std::string& kind, const Work& work) {
  if (control_.progress) control_.progress(kind, -1);
  const auto start = std::chrono::steady_clock::now();
  const long done = work();
  iterate_.report.seconds[kind] += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
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
    smooth_to_features(state_, tets_around(state_.mesh, singular_vertices(state_), relocation_rings),
                       relocation_sweeps);
    update_codes(state_, singular_edges(state_));
    return 0;
  });
}

bool Schedule::meshable() {
  bool good = false;
  timed("check", [&] {
    good = find_defects(state_.mesh, state_.features, state_.field, state_.codes).empty();
    return 0;
  });
  return good;
}

void Schedule::finish() {
  timed("separate arcs and features", [&] {
    unify_codes(state_.mesh, state_.field, state_.codes);
    isolate();
    comb(state_.mesh, state_.field);
    return 0;
  });
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
  const bool stop = control_.stop_requested && control_.stop_requested();
  if (control_.checkpoint) control_.checkpoint(iterate_);
  if (stop) throw Error(ExitCode::stopped, "The repair of the field was stopped.");
}

}  // namespace hexfield
