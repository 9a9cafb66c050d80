#include "untangle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "collective.hpp"
#include "untangle_energy.hpp"

namespace hexfield {
namespace {

constexpr int max_idle_rounds = 3;

}  // namespace

double smallest_determinant(const TetMesh& mesh, const ConformingSpace& space, std::span<const double> y, double edge) {
  const CornerMap map = to_corner_map(space, coordinates(space, y));
  double smallest = 1e300;
  for (std::size_t t = 0; t < mesh.num_tets(); ++t) {
    const auto& f = map.uvw[t];
    const double volume6 = (f[1] - f[0]).cross(f[2] - f[0]).dot(f[3] - f[0]);
    smallest = std::min(smallest, volume6 / signed_volume6(mesh, TetId(t)));
  }
  return smallest * edge * edge * edge;
}

std::vector<double> untangle(const MapProblem& problem, const std::vector<double>& start,
                             const std::vector<double>& fixed, double edge, int max_rounds, SolveMonitor& monitor) {
  const MPI_Comm comm = problem.comm();
  UntangleEnergy energy;
  problem.add_elements(energy, problem.volume_weights(), problem.uniform_frames(edge), fixed);
  const solve::EnergyTerm* terms[] = {&energy};
  const VecOwner y(problem.make_vector(start, !fixed.empty()));
  solve::NewtonOptions options;
  options.preconditioner = solve::Preconditioner::cholesky;
  options.max_iterations = 10;
  options.decrease_tolerance = 1e-3;
  std::vector<double> unknowns = start;
  double before = -std::numeric_limits<double>::infinity();
  int idle = 0;
  for (int round = 0; round < max_rounds; ++round) {
    double smallest = rank_of(comm) == 0 ? smallest_determinant(problem.mesh(), problem.space(), unknowns, edge) : 0;
    broadcast(comm, smallest);
    if (smallest > 0) break;
    idle = smallest > 0.7 * before ? 0 : idle + 1;
    if (idle == std::max(max_idle_rounds, max_rounds / 5)) break;
    before = smallest;
    energy.set_epsilon(std::sqrt(1e-12 + 0.04 * smallest * smallest));
    monitor.minimise(comm, terms, y.get(), options, "untangling", {});
    unknowns = problem.gather(y.get(), fixed);
  }
  return unknowns;
}

}  // namespace hexfield
