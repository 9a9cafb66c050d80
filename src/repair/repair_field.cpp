#include "hexfield/repair/repair_field.hpp"

#include <array>

#include "hexfield/base/stopwatch.hpp"
#include "hexfield/field/singularity_graph.hpp"
#include "hexfield/mesh/edge_table.hpp"
#include "hexfield/repair/meshability.hpp"
#include "schedule.hpp"

namespace hexfield {
namespace {

// Mean length of the edges at every vertex.
std::vector<double> mean_edge_lengths(const TetMesh& mesh) {
  std::vector<double> sum(mesh.num_vertices(), 0), count(mesh.num_vertices(), 0);
  EdgeTable(mesh).for_each([&](std::size_t, const EdgeKey& e) {
    const double length = (mesh.point(e[0]) - mesh.point(e[1])).norm();
    for (VertexId v : e) sum[v.index()] += length, count[v.index()] += 1;
  });
  for (std::size_t v = 0; v < sum.size(); ++v) sum[v] /= count[v] > 0 ? count[v] : 1;
  return sum;
}

// Kind of operation in the report.
constexpr const char* judgement = "judge before and after";

DefectCounts count_defects(const FieldResult& f, VerdictMemory& verdicts) {
  Meshability found = check_meshability(FieldView(f.mesh, f.features, f.field, f.codes));
  verdicts = std::move(found.verdicts);
  DefectCounts counts{found.bad_edges.size(), found.bad_vertices.size(), {}};
  for (const SingularNode& node : singularity_graph(f.mesh, f.features, f.field, f.codes).nodes)
    ++counts.kinds[name(node.kind)];
  return counts;
}

struct Variation {
  const char* name;
  void (*apply)(RepairOptions&);
};

constexpr std::array<Variation, 4> variations = {{
    {"default", [](RepairOptions&) {}},
    {"alignment weight 1", [](RepairOptions& o) { o.alignment_weight = 1; }},
    {"more iterations before free zipper nodes", [](RepairOptions& o) { o.first_iterations += 8; }},
    {"alignment weight 100", [](RepairOptions& o) { o.alignment_weight = 100; }},
}};

const Variation& variation(int attempt) { return variations[static_cast<std::size_t>(attempt) % variations.size()]; }

}  // namespace

RepairOptions varied(const RepairOptions& options, int attempt) {
  RepairOptions changed = options;
  variation(attempt).apply(changed);
  return changed;
}

std::string name_of_variation(int attempt) { return variation(attempt).name; }

RepairIterate start_repair(FieldResult smooth) {
  RepairIterate start;
  const Clock::time_point begin = Clock::now();
  start.report.before = count_defects(smooth, start.verdicts);
  start.report.seconds[judgement] += seconds_since(begin);
  start.state.target_length = mean_edge_lengths(smooth.mesh);
  static_cast<FieldResult&>(start.state) = std::move(smooth);
  return start;
}

RepairResult repair_field(RepairIterate iterate, const FieldResult& input, const RepairOptions& options,
                          const RepairControl& control) {
  Schedule schedule(iterate, input, options, control);
  const int last = options.first_iterations + options.second_rounds * options.inner_iterations;
  while (iterate.report.iterations < last) {
    const int k = iterate.report.iterations - options.first_iterations;
    const bool round = k >= 0 && k % options.inner_iterations == 0;
    if (round && (schedule.meshable() || iterate.stale_rounds >= options.patience)) break;
    if (k < 0 || round) schedule.repair_edges_and_vertices();
    if (round) schedule.repair_zippers();
    schedule.relocate();
    schedule.end_iteration();
  }
  schedule.finish();
  const Clock::time_point begin = Clock::now();
  iterate.report.after = count_defects(iterate.state, iterate.verdicts);
  iterate.report.seconds[judgement] += seconds_since(begin);
  return {std::move(static_cast<FieldResult&>(iterate.state)), std::move(iterate.report)};
}

}  // namespace hexfield
