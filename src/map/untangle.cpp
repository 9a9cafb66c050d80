#include "untangle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "collective.hpp"
#include "positivity_energy.hpp"
#include "untangle_energy.hpp"

namespace hexfield {
namespace {

constexpr int max_idle_rounds = 3;
/// Regularisation relative to the least determinant, and its bounds: beyond the upper one slivers of a bad start
/// would make all tets weightless.
constexpr double relative_epsilon = 0.2;
constexpr double min_epsilon = 1e-6;
constexpr double max_epsilon = 0.3;
/// Eigenvalues of the symmetric part of J F that make_positive() asks for, where 1 is the wanted size.
constexpr double wanted_stretch = 0.1;
constexpr double penalties[] = {10, 100, 1000};

// det J F of the tets of a map.
struct Determinants {
  double smallest = 1e300;
  int inverted = 0;
};

Determinants determinants(const TetMesh& mesh, const ConformingSpace& space, std::span<const double> y,
                          const std::vector<Mat3>& frames) {
  const CornerMap map = to_corner_map(space, coordinates(space, y));
  Determinants found;
  for (std::size_t t = 0; t < mesh.num_tets(); ++t) {
    const auto& f = map.uvw[t];
    const double volume6 = (f[1] - f[0]).cross(f[2] - f[0]).dot(f[3] - f[0]);
    found.smallest =
        std::min(found.smallest, volume6 / signed_volume6(mesh, TetId(t)) * std::abs(frames[t].determinant()));
    found.inverted += !(volume6 > 0);
  }
  return found;
}

double epsilon_for(double smallest) {
  return std::min(max_epsilon, std::hypot(min_epsilon, relative_epsilon * smallest));
}

}  // namespace

std::vector<double> untangle(const MapProblem& problem, const std::vector<double>& start,
                             const std::vector<double>& fixed, const std::vector<Mat3>& frames, int max_rounds,
                             SolveMonitor& monitor) {
  const MPI_Comm comm = problem.comm();
  UntangleEnergy energy;
  problem.add_elements(energy, problem.length_weights(), problem.scatter_matrices(frames), fixed);
  const solve::EnergyTerm* terms[] = {&energy};
  const VecOwner y(problem.make_vector(start, !fixed.empty()));
  solve::NewtonOptions options;
  options.preconditioner = solve::Preconditioner::cholesky;
  options.max_iterations = 10;
  options.decrease_tolerance = 1e-3;
  std::vector<double> unknowns = start;
  int fewest = std::numeric_limits<int>::max();
  for (int round = 0, idle = 0; round < max_rounds; ++round) {
    Determinants found;
    if (rank_of(comm) == 0) found = determinants(problem.mesh(), problem.space(), unknowns, frames);
    broadcast(comm, found.smallest);
    broadcast(comm, found.inverted);
    if (found.inverted == 0) break;
    idle = found.inverted < fewest ? 0 : idle + 1;
    if (idle == max_idle_rounds || monitor.exhausted()) break;
    fewest = std::min(fewest, found.inverted);
    energy.set_epsilon(epsilon_for(found.smallest));
    monitor.minimise(comm, terms, y.get(), options, "untangling", {});
    unknowns = problem.gather(y.get(), fixed);
  }
  return unknowns;
}

std::vector<double> untangle(const MapProblem& problem, const std::vector<double>& start,
                             const std::vector<double>& fixed, double edge, int max_rounds, SolveMonitor& monitor) {
  std::vector<Mat3> frames;
  if (rank_of(problem.comm()) == 0) frames.assign(problem.mesh().num_tets(), edge * Mat3::Identity());
  return untangle(problem, start, fixed, frames, max_rounds, monitor);
}

std::vector<double> make_positive(const MapProblem& problem, std::vector<double> start,
                                  const std::vector<double>& fixed, const std::vector<Mat3>& frames,
                                  SolveMonitor& monitor, const std::function<bool(const std::vector<double>&)>& done) {
  const std::vector<Mat3> own_frames = problem.scatter_matrices(frames);
  solve::TetEnergy fit(solve::TetEnergy::Kind::frame_fit);
  problem.add_elements(fit, problem.volume_weights(), own_frames, fixed);
  PositivityEnergy positivity(wanted_stretch);
  problem.add_elements(positivity, problem.length_weights(), own_frames, fixed);
  const solve::EnergyTerm* terms[] = {&fit, &positivity};
  const VecOwner y(problem.make_vector(start, !fixed.empty()));
  solve::NewtonOptions options;
  options.preconditioner = solve::Preconditioner::cholesky;
  options.max_iterations = 10;
  options.decrease_tolerance = 1e-2;
  for (const double penalty : penalties) {
    positivity.set_factor(penalty);
    monitor.minimise(problem.comm(), terms, y.get(), options, "positive fit", {});
    start = problem.gather(y.get(), fixed);
    if (done(start) || monitor.exhausted()) break;
  }
  return start;
}

}  // namespace hexfield
