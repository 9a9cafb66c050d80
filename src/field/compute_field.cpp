#include "hexfield/field/compute_field.hpp"

#include <algorithm>

#include "hexfield/base/agree.hpp"
#include "hexfield/field/align_field.hpp"
#include "hexfield/field/constraints.hpp"
#include "hexfield/field/edge_codes.hpp"
#include "hexfield/field/matchings.hpp"
#include "hexfield/field/presplit.hpp"
#include "hexfield/field/settle_codes.hpp"
#include "hexfield/field/singularity_graph.hpp"
#include "hexfield/field/tet_polish.hpp"
#include "hexfield/field/transfer.hpp"
#include "hexfield/field/vertex_field.hpp"

namespace hexfield {
namespace {

std::vector<harmonics::Sh> harmonics_of(const std::vector<Quaternion>& frames) {
  std::vector<harmonics::Sh> sh(frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) sh[i] = harmonics::of_frame(frames[i]);
  return sh;
}

std::vector<AxisConstraint> feature_constraints(const FieldResult& result) {
  return collect_constraints(result.mesh, result.features, result.field, {});
}

// Special edges apart from each other, so that no tet carries constraints that exclude each other.
void isolate(FieldResult& result) {
  FeatureAttribute features(result.features);
  FieldAttribute field(result.field);
  CodesAttribute codes(result.codes);
  const std::vector<MeshAttribute*> attributes{&features, &field, &codes};
  for (int pass = 0; pass < 4; ++pass) {
    int splits = split_for_singularities(result.mesh, result.features, result.codes, attributes);
    splits += split_for_features(result.mesh, result.features, attributes);
    if (splits == 0) break;
  }
  compact(result.mesh, attributes);
  comb(result.mesh, result.field);
}

// Sweeps with fixed matchings onto features and singular edges, with the signs that the codes say.
void align_to_codes(MPI_Comm comm, FieldResult& result, const FieldOptions& options) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  const DistributedMesh distributed(comm, result.mesh);
  AlignOptions align;
  align.sweeps = options.alignment_sweeps;
  std::vector<AxisConstraint> constraints;
  agree(comm, [&] {
    if (rank == 0) constraints = collect_constraints(result.mesh, result.features, result.field, result.codes);
  });
  align_field(distributed, result.field, constraints, align);
}

}  // namespace

FieldResult compute_field(MPI_Comm comm, TetMesh mesh, Features features, const FieldOptions& options,
                          const Control& control) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  auto now_at = [&](const char* step) {
    if (control.progress) control.progress(step, -1);
  };
  FieldResult result;
  RootGraph graph;
  now_at("splitting for features");
  std::vector<NodeConstraint> constraints;
  agree(comm, [&] {
    if (rank != 0) return;
    result.mesh = std::move(mesh);
    result.features = std::move(features);
    FeatureAttribute follow(result.features);
    split_for_features(result.mesh, result.features, {&follow});
    compact(result.mesh, {&follow});
    graph = vertex_graph(result.mesh);
    constraints = vertex_constraints(result.mesh, result.features, options.normal_deviation_degrees);
  });
  now_at("smoothing the vertex field");
  SmoothingOptions smoothing;
  smoothing.max_iterations = options.max_smoothing_iterations;
  smoothing.tolerance = options.smoothing_tolerance;
  SmoothingReport report;
  const auto vertex_frames = smooth_octahedral_field(comm, graph, constraints, nullptr, smoothing, report, control);
  now_at("refining singular faces");
  std::vector<TetId> near;
  std::vector<Quaternion> near_frames;
  agree(comm, [&] {
    if (rank != 0) return;
    std::vector<harmonics::Sh> sh = harmonics_of(vertex_frames);
    FeatureAttribute follow(result.features);
    refine_singular_faces(result.mesh, sh, options.singular_face_edge_factor, options.max_singular_splits, {&follow});
    VertexShAttribute follow_sh(sh);
    split_for_features(result.mesh, result.features, {&follow, &follow_sh});
    compact(result.mesh, {&follow, &follow_sh});
    result.field.frames = tet_frames(result.mesh, sh);
    compute_matchings(result.mesh, result.field);
    near = tets_near_singularities(result.mesh, result.field, options.tet_smoothing_layers);
    graph = tet_graph(result.mesh, near);
    constraints = tet_constraints(result.mesh, result.features, result.field, near);
    for (TetId t : near) near_frames.push_back(result.field.frames[t.index()]);
  });
  now_at("smoothing the tet field");
  // The vertex field loses its finest scale in the transfer, which matters where it is singular only.
  smoothing.max_iterations = options.max_tet_smoothing_iterations;
  SmoothingReport tet_report;
  near_frames = smooth_octahedral_field(comm, graph, constraints, &near_frames, smoothing, tet_report, control);
  agree(comm, [&] {
    if (rank != 0) return;
    for (std::size_t k = 0; k < near.size(); ++k) result.field.frames[near[k].index()] = near_frames[k];
    compute_matchings(result.mesh, result.field);
    comb(result.mesh, result.field);
  });
  now_at("aligning to features");
  const DistributedMesh distributed(comm, result.mesh);
  AlignOptions align;
  align.sweeps = options.alignment_sweeps;
  align_field(distributed, result.field, rank == 0 ? feature_constraints(result) : std::vector<AxisConstraint>(),
              align);
  now_at("finding singular edges");
  agree(comm, [&] {
    if (rank != 0) return;
    compute_matchings(result.mesh, result.field);
    result.codes = compute_codes(result.mesh, result.features, result.field);
    unify_codes(result.mesh, result.field, result.codes);
    settle_blunt_edges(result.mesh, result.features, result.field, result.codes);
    isolate(result);
  });
  now_at("aligning to singular edges");
  align_to_codes(comm, result, options);
  return result;
}

}  // namespace hexfield
