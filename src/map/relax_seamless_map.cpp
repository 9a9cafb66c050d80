#include <algorithm>
#include <cmath>
#include <limits>

#include "collective.hpp"
#include "hexfield/base/agree.hpp"
#include "hexfield/map/compute_map.hpp"
#include "hexfield/map/verify.hpp"
#include "hexfield/mesh/quality.hpp"
#include "map_problem.hpp"
#include "solve_monitor.hpp"
#include "untangle.hpp"

namespace hexfield {
namespace {

constexpr int untangling_rounds = 30;
constexpr int max_newton_steps = 60;
constexpr int max_minimisations = 12;

/// Share in the total volume, at least that of a mean tet.
std::vector<double> raised_weights(const MapProblem& problem) {
  std::vector<double> weights = problem.volume_weights();
  const double mean = 1 / static_cast<double>(problem.distributed().num_global_tets());
  for (double& w : weights) w = std::max(w, mean);
  return weights;
}

}  // namespace

SeamlessResult relax_seamless_map(MPI_Comm comm, const TetMesh& mesh, const Features& features, const EdgeCodes& codes,
                                  const SeamlessMap& map, const Control& control) {
  const bool root = rank_of(comm) == 0;
  SolveMonitor monitor(control, "seamless");
  ConformingSpace space;
  std::vector<double> unknowns;
  double edge = 1;
  agree(comm, [&] {
    if (!root) return;
    space = conforming_space(mesh, cut_graph(mesh, matchings_of(map), singular_edges(codes)),
                             alignments_of_map(mesh, features, codes, map));
    unknowns = unknowns_of(mesh, space, map);
    edge = std::cbrt(total_volume(mesh) / std::max(parametric_volume(map), 1e-300));
  });
  broadcast(comm, edge);
  const MapProblem problem(comm, mesh, space);
  unknowns = untangle(problem, unknowns, {}, edge, untangling_rounds, monitor);
  solve::TetEnergy energy(solve::TetEnergy::Kind::symmetric_dirichlet);
  problem.add_elements(energy, raised_weights(problem), problem.uniform_frames(edge), {});
  const solve::EnergyTerm* terms[] = {&energy};
  const VecOwner y(problem.make_vector(unknowns, false));
  if (std::isfinite(solve::evaluate(comm, terms, y.get()))) {
    solve::NewtonOptions newton;
    newton.preconditioner = solve::Preconditioner::cholesky;
    newton.max_iterations = max_newton_steps;
    // Tolerances are relative to the start, where the barrier of the thinnest tets may be many orders above the rest:
    // each time it falls by as many, they are taken anew.
    double before = std::numeric_limits<double>::infinity();
    for (int k = 0; k < max_minimisations; ++k) {
      const double energy_now = monitor.minimise(comm, terms, y.get(), newton, "seamless map", {}).energy;
      if (energy_now > 0.5 * before) break;
      before = energy_now;
    }
    unknowns = problem.gather(y.get(), {});
  }
  SeamlessResult result;
  agree(comm, [&] {
    if (!root) return;
    quantize_to_dyadic_grid(space, unknowns);
    result.map = to_corner_map(space, coordinates(space, unknowns));
    result.report = verify_map(mesh, features, codes, result.map);
  });
  broadcast(comm, result.report);
  result.newton_steps = monitor.newton_steps();
  result.linear_iterations = monitor.linear_iterations();
  result.solves = monitor.solves();
  return result;
}

}  // namespace hexfield
