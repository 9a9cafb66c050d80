#include "hexfield/field/octahedral_smoothing.hpp"

#include <cmath>

#include "descent.hpp"
#include "hexfield/base/agree.hpp"
#include "hexfield/base/error.hpp"
#include "hexfield/base/parallel.hpp"

namespace hexfield {
namespace {

using Kind = NodeConstraint::Kind;

constexpr int packed_constraint = 8;
constexpr std::size_t window = 5;  // steps whose decrease is judged together: single ones vary

std::vector<double> packed(const std::vector<NodeConstraint>& constraints) {
  std::vector<double> p(packed_constraint * constraints.size());
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    double* at = p.data() + packed_constraint * i;
    at[0] = static_cast<double>(static_cast<int>(constraints[i].kind));
    for (int d = 0; d < 3; ++d) at[1 + d] = constraints[i].direction[d];
    for (int d = 0; d < 4; ++d) at[4 + d] = constraints[i].frame.coeffs()[d];
  }
  return p;
}

std::vector<NodeConstraint> unpacked(const std::vector<double>& values) {
  std::vector<NodeConstraint> constraints(values.size() / packed_constraint);
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    const double* p = values.data() + packed_constraint * i;
    constraints[i].kind = static_cast<Kind>(static_cast<int>(p[0]));
    constraints[i].direction = Vec3(p[1], p[2], p[3]);
    constraints[i].frame = Quaternion(Eigen::Map<const Eigen::Vector4d>(p + 4));
  }
  return constraints;
}

NodeFrames meeting_constraints(const std::vector<NodeConstraint>& constraints, const std::vector<double>& q) {
  NodeFrames frames(constraints.size());
  parallel_for(constraints.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      frames.frame[i] = Quaternion(q.data() + 4 * i);
      const NodeConstraint& c = constraints[i];
      if (c.kind == Kind::fixed) frames.frame[i] = c.frame;
      if (c.kind == Kind::aligned)
        frames.frame[i] =
            harmonics::project(harmonics::of_frame(frames.frame[i]), harmonics::aligned_basis(c.direction)).frame;
      frames.sh[i] = harmonics::of_frame(frames.frame[i]);
    }
  });
  return frames;
}

bool settled(const std::vector<double>& energies, double tolerance) {
  if (energies.size() <= window) return false;
  const double before = energies[energies.size() - 1 - window];
  return before - energies.back() <= tolerance * energies.back();
}

std::vector<Quaternion> on_root(const NodeGraph& graph, const NodeFrames& frames) {
  std::vector<double> q(4 * graph.local());
  for (std::size_t i = 0; i < graph.owned(); ++i)
    for (int c = 0; c < 4; ++c) q[4 * i + static_cast<std::size_t>(c)] = frames.frame[i].coeffs()[c];
  const std::vector<double> gathered = graph.gather(q, 4);
  std::vector<Quaternion> result(gathered.size() / 4);
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = Quaternion(gathered.data() + 4 * i);
  return result;
}

}  // namespace

std::vector<Quaternion> smooth_octahedral_field(MPI_Comm comm, const RootGraph& root_graph,
                                                const std::vector<NodeConstraint>& root_constraints,
                                                const std::vector<Quaternion>* start, const SmoothingOptions& options,
                                                SmoothingReport& report, const Control& control) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  agree(comm, [&] {
    require(rank != 0 || root_constraints.size() == root_graph.size(), "A field needs one constraint record per node.");
    require(rank != 0 || start == nullptr || start->size() == root_graph.size(),
            "A field to smooth needs a frame per node.");
  });
  const Hierarchy hierarchy(comm, root_graph, root_constraints);
  const NodeGraph& graph = hierarchy.graph();
  const std::vector<NodeConstraint> constraints = unpacked(graph.scatter(packed(root_constraints), packed_constraint));
  NodeFrames frames(0);
  if (start != nullptr) {
    std::span<const double> q;
    if (rank == 0 && !start->empty()) q = {(*start)[0].coeffs().data(), 4 * start->size()};
    frames = meeting_constraints(constraints, graph.scatter(q, 4));
  } else {
    frames = linear_start(hierarchy, constraints, root_constraints, options.linear_tolerance, report.linear_iterations);
  }
  Descent descent(hierarchy, constraints, root_constraints, options.max_turn, std::move(frames));
  report.energies.assign(1, descent.energy());
  for (int iteration = 0; iteration < options.max_iterations && !report.converged; ++iteration) {
    const bool moved = descent.step();
    if (moved) report.energies.push_back(descent.energy());
    report.converged = !moved || settled(report.energies, options.tolerance);
    if (control.progress) control.progress("smooth octahedral field", -1);
    if (control.stop_requested && control.stop_requested())
      throw Error(ExitCode::stopped, "Stopped while the octahedral field was being smoothed.");
  }
  return on_root(graph, descent.frames());
}

}  // namespace hexfield
