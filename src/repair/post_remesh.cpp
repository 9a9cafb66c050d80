#include <algorithm>
#include <cmath>

#include "hexfield/base/parallel.hpp"
#include "hexfield/field/matchings.hpp"
#include "hexfield/mesh/quality.hpp"
#include "hexfield/repair/remesh.hpp"

namespace hexfield {
namespace {

constexpr double harmless_angle = 20 * M_PI / 180;
constexpr double least_share = 0.3;
constexpr double kept_share = 0.8;
constexpr int averagings = 3;

std::vector<TetId> alive_tets(const TetMesh& mesh) {
  std::vector<TetId> tets;
  for (std::size_t i = 0; i < mesh.num_tets(); ++i)
    if (const TetId t(static_cast<std::int64_t>(i)); mesh.alive(t)) tets.push_back(t);
  return tets;
}

// Each vertex takes the mean over itself and the ends of its edges, counted once per tet.
void average(const TetMesh& mesh, const std::vector<char>& singular, std::vector<double>& lengths) {
  std::vector<double> sum = lengths, count(lengths.size(), 1);
  for (const auto& tet : mesh.tets) {
    if (!tet[0].valid()) continue;
    double total = 0;
    for (VertexId v : tet) total += lengths[v.index()];
    for (VertexId v : tet) {
      sum[v.index()] += total - lengths[v.index()];
      count[v.index()] += 3;
    }
  }
  for (std::size_t v = 0; v < lengths.size(); ++v) {
    const double mean = sum[v] / count[v];
    lengths[v] = singular[v] != 0 ? kept_share * lengths[v] + (1 - kept_share) * mean : mean;
  }
}

struct Quality {
  double worst = 0, mean = 0;
};

Quality quality(const TetMesh& mesh) {
  Quality q;
  std::size_t n = 0;
  for (TetId t : alive_tets(mesh)) {
    const double e = log_energy(tet_distortion(mesh, t));
    q.worst = std::max(q.worst, e);
    q.mean += e;
    ++n;
  }
  q.mean /= static_cast<double>(std::max<std::size_t>(n, 1));
  return q;
}

}  // namespace

std::vector<double> field_adapted_lengths(const RepairState& state) {
  const TetMesh& mesh = state.mesh;
  std::vector<std::array<double, 4>> powers(mesh.num_tets());  // 8th power of the angle per half-face
  parallel_for(mesh.num_tets(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const TetId t(static_cast<std::int64_t>(i));
      if (!mesh.alive(t)) continue;
      for (int f = 0; f < 4; ++f) {
        const double angle = matched_angle(mesh, state.field, HalfFaceId(t, f));
        powers[i][static_cast<std::size_t>(f)] = angle > harmless_angle ? std::pow(angle, 8) : 0;
      }
    }
  });
  std::vector<double> sums(mesh.num_vertices(), 0.0);
  for (std::size_t i = 0; i < mesh.num_tets(); ++i) {
    const TetId t(static_cast<std::int64_t>(i));
    if (!mesh.alive(t)) continue;
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(t, f), o = mesh.opposite_half_face(h);
      if (!o.valid() || o < h) continue;
      for (VertexId v : mesh.face_vertices(h)) sums[v.index()] += powers[i][static_cast<std::size_t>(f)];
    }
  }
  std::vector<char> singular(mesh.num_vertices(), 0);
  for (const auto& [e, code] : state.codes)
    for (VertexId v : e) singular[v.index()] = 1;
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
  for (std::size_t v = 0; v < mesh.num_vertices(); ++v) {
    if (!mesh.vertex_tet[v].valid()) continue;
    smallest = std::min(smallest, state.target_length[v]);
    largest = std::max(largest, state.target_length[v]);
  }
  std::vector<double> lengths = state.target_length;
  for (std::size_t v = 0; v < lengths.size(); ++v) {
    const double s = std::pow(sums[v], 1.0 / 8) + 1;
    lengths[v] = std::max(lengths[v] / (s * s), least_share * smallest);
  }
  for (int k = 0; k < averagings; ++k) average(mesh, singular, lengths);
  double now = 0;
  for (std::size_t v = 0; v < lengths.size(); ++v)
    if (mesh.vertex_tet[v].valid()) now = std::max(now, lengths[v]);
  for (double& length : lengths) length *= largest / now;
  return lengths;
}

PostRemeshReport post_remesh(RepairState& state, const ClosestSurface& original_surface,
                             const ClosestCurve& original_curves, const PostRemeshOptions& options) {
  PostRemeshReport report;
  const Quality before = quality(state.mesh);
  report.worst_before = before.worst;
  report.mean_before = before.mean;
  RemeshOptions remeshing;
  remeshing.split_above = options.split_above;
  remeshing.collapse_below = options.collapse_below;
  remeshing.collapse_needs_quality = true;
  for (int round = 0; round < options.rounds; ++round) {
    state.target_length = field_adapted_lengths(state);
    const RemeshReport r = remesh(state, alive_tets(state.mesh), remeshing);
    report.splits += r.splits;
    report.collapses += r.collapses;
    report.swaps += r.swaps;
    report.refused += r.refused;
    remove_unused(state);
    optimise_vertices(state, original_surface, original_curves, options.vertex_sweeps);
  }
  const Quality after = quality(state.mesh);
  report.worst_after = after.worst;
  report.mean_after = after.mean;
  return report;
}

}  // namespace hexfield
