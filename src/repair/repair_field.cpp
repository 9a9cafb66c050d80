#include "hexfield/repair/repair_field.hpp"

#include "hexfield/base/error.hpp"
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

DefectCounts count_defects(const RepairState& f, VerdictMemory& verdicts) {
  Meshability found = check_meshability(f);
  verdicts = std::move(found.verdicts);
  DefectCounts counts{found.bad_edges.size(), found.bad_vertices.size(), {}};
  for (const SingularNode& node : singularity_graph(f.mesh, f.features, f.field, f.codes).nodes)
    ++counts.kinds[name(node.kind)];
  return counts;
}

std::shared_ptr<RepairWatch> watch_of(const RepairControl& control) {
  auto watch = std::make_shared<RepairWatch>();
  watch->stop_requested = control.stop_requested;
  return watch;
}

}  // namespace

// A few milliseconds at most.
constexpr long work_between_asks = 256;

void RepairWatch::begin(std::size_t tets) {
  const long before = work.fetch_add(static_cast<long>(tets));
  const bool ask = tets == 0 || before / work_between_asks != (before + static_cast<long>(tets)) / work_between_asks;
  if (ask && stop_requested && stop_requested()) throw Error(ExitCode::stopped, "The repair of the field was stopped.");
}

RepairIterate start_repair(FieldResult smooth, const RepairControl& control) {
  RepairIterate start;
  const Clock::time_point begin = Clock::now();
  start.state.target_length = mean_edge_lengths(smooth.mesh);
  static_cast<FieldResult&>(start.state) = std::move(smooth);
  start.state.watch = watch_of(control);
  start.report.before = count_defects(start.state, start.verdicts);
  start.report.seconds[judgement] += seconds_since(begin);
  return start;
}

RepairResult repair_field(RepairIterate iterate, const FieldResult& input, const RepairOptions& options,
                          const RepairControl& control) {
  iterate.state.watch = watch_of(control);
  iterate.state.watch->work = iterate.report.work;
  iterate.state.watch->budget = options.work_per_tet * static_cast<long>(input.mesh.num_tets());
  Schedule schedule(iterate, input, options, control);
  const int last = options.first_iterations + options.second_rounds * options.inner_iterations;
  while (iterate.report.iterations < last && !iterate.state.exhausted()) {
    const int k = iterate.report.iterations - options.first_iterations;
    const bool round = k >= 0 && k % options.inner_iterations == 0;
    if (round && (schedule.meshable() || iterate.stale_rounds >= options.patience)) break;
    if (k < 0 || round) schedule.repair_edges_and_vertices(k < 0);
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
