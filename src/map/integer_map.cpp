#include "integer_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "collective.hpp"
#include "hexfield/base/petsc.hpp"
#include "hexfield/base/stopwatch.hpp"
#include "untangle.hpp"

namespace hexfield {
namespace {

constexpr std::array<double, 4> penalties = {1e-2, 1e-1, 1e0, 1e2};
constexpr int untangling_rounds = 12;
// No more of the energy can be seen in a hex mesh.
constexpr double final_decrease = 1e-6;

solve::TetEnergy dirichlet_energy(const MapProblem& problem, double edge, std::span<const double> fixed) {
  solve::TetEnergy energy(solve::TetEnergy::Kind::symmetric_dirichlet);
  problem.add_elements(energy, problem.volume_weights(), problem.uniform_frames(edge), fixed);
  return energy;
}

double distance_to(const MapProblem& problem, Vec y, const std::vector<double>& integers) {
  double distance = 0;
  if (problem.owns_unknowns()) {
    PetscInt begin = 0;
    const PetscScalar* values = nullptr;
    check_petsc(VecGetOwnershipRange(y, &begin, nullptr), "VecGetOwnershipRange");
    check_petsc(VecGetArrayRead(y, &values), "VecGetArrayRead");
    for (std::size_t i = 0; i < integers.size(); ++i)
      distance = std::max(distance, std::abs(values[problem.integer_index(i) - begin] - integers[i]));
    check_petsc(VecRestoreArrayRead(y, &values), "VecRestoreArrayRead");
  }
  MPI_Allreduce(MPI_IN_PLACE, &distance, 1, MPI_DOUBLE, MPI_MAX, problem.comm());
  return distance;
}

// Phase, edge, integers and unknowns in one row, for a checkpoint.
std::vector<double> pack(int phase, const IntegerGoal& goal, const std::vector<double>& unknowns) {
  if (unknowns.empty()) return {};
  std::vector<double> row{static_cast<double>(phase), goal.edge};
  row.insert(row.end(), goal.integers.begin(), goal.integers.end());
  row.insert(row.end(), unknowns.begin(), unknowns.end());
  return row;
}

// A map that has the integers and as few tets turned over as the frames allow.
std::vector<double> fitted(const MapProblem& problem, const IntegerGoal& goal, SolveMonitor& monitor,
                           const std::function<bool(const std::vector<double>&)>& is_inside) {
  solve::TetEnergy energy(solve::TetEnergy::Kind::frame_fit);
  problem.add_elements(energy, problem.volume_weights(), problem.scatter_matrices(goal.frames), goal.integers);
  std::vector<double> unknowns = goal.start;
  if (!unknowns.empty()) std::copy(goal.integers.begin(), goal.integers.end(), unknowns.begin() + problem.num_reals());
  const VecOwner y(problem.make_vector(unknowns, true));
  const solve::EnergyTerm* terms[] = {&energy};
  const Clock::time_point start = Clock::now();
  const solve::NewtonResult result =
      solve::solve_linear(problem.comm(), terms, y.get(), solve::Preconditioner::cholesky);
  monitor.note({"fit to blocks", 0, result.linear_iterations, seconds_since(start)});
  unknowns = problem.gather(y.get(), goal.integers);
  if (is_inside(unknowns)) return unknowns;
  unknowns = make_positive(problem, std::move(unknowns), goal.integers, goal.frames, monitor, is_inside);
  if (is_inside(unknowns)) return unknowns;
  return untangle(problem, unknowns, goal.integers, goal.frames, untangling_rounds, monitor);
}

bool inside(const MapProblem& problem, std::span<const solve::EnergyTerm* const> terms,
            const std::vector<double>& unknowns) {
  const VecOwner y(problem.make_vector(unknowns, true));
  return std::isfinite(solve::evaluate(problem.comm(), terms, y.get()));
}

}  // namespace

std::optional<IntegerGoal> unpack_goal(std::vector<double> row, const ConformingSpace& space) {
  std::vector<double> memory = take_memory(row);
  if (row.size() != 2 + space.num_integers + space.num_unknowns()) return std::nullopt;
  const auto integers = row.begin() + 2;
  const auto unknowns = integers + static_cast<std::ptrdiff_t>(space.num_integers);
  return IntegerGoal{{integers, unknowns},     {unknowns, row.end()}, row[1],
                     static_cast<int>(row[0]), std::move(memory),     {}};
}

int num_integer_phases() { return static_cast<int>(penalties.size()); }

IntegerOutcome reach_integers(const MapProblem& problem, const IntegerGoal& goal, SolveMonitor& monitor) {
  const MPI_Comm comm = problem.comm();
  IntegerOutcome outcome;
  outcome.unknowns = goal.start;
  solve::NewtonOptions options;
  options.preconditioner = solve::Preconditioner::cholesky;
  // The gradient of a start with thin tets is huge, so it measures nothing.
  options.gradient_tolerance = 0;
  const solve::TetEnergy fixed_energy = dirichlet_energy(problem, goal.edge, goal.integers);
  const solve::EnergyTerm* fixed_terms[] = {&fixed_energy};
  const auto is_inside = [&](const std::vector<double>& unknowns) { return inside(problem, fixed_terms, unknowns); };
  bool has_frames = !goal.frames.empty();
  broadcast(comm, has_frames);
  if (has_frames) outcome.unknowns = fitted(problem, goal, monitor, is_inside);
  const bool fits = has_frames && is_inside(outcome.unknowns);
  if (goal.first_phase < num_integer_phases() && !fits) {
    const VecOwner y(problem.make_vector(goal.start, false));
    const solve::TetEnergy energy = dirichlet_energy(problem, goal.edge, {});
    options.max_iterations = 12;
    options.decrease_tolerance = 1e-4;
    for (int phase = goal.first_phase; phase < num_integer_phases(); ++phase) {
      solve::LeastSquares penalty;
      if (problem.owns_unknowns())
        for (std::size_t i = 0; i < goal.integers.size(); ++i)
          penalty.add({{{problem.integer_index(i), 1.0}}, -goal.integers[i]},
                      penalties[static_cast<std::size_t>(phase)]);
      const solve::EnergyTerm* terms[] = {&energy, &penalty};
      monitor.minimise(
          comm, terms, y.get(), options, "integer-grid map",
          [&] { return pack(phase, goal, problem.gather(y.get(), {})); },
          phase == goal.first_phase ? goal.memory : std::vector<double>());
    }
    outcome.distance = distance_to(problem, y.get(), goal.integers);
    outcome.unknowns = problem.gather(y.get(), {});
    if (!outcome.unknowns.empty())
      std::copy(goal.integers.begin(), goal.integers.end(), outcome.unknowns.begin() + problem.num_reals());
  }
  if (!is_inside(outcome.unknowns))
    // The last jump inverted a few tets.
    outcome.unknowns = untangle(problem, outcome.unknowns, goal.integers, goal.edge, untangling_rounds, monitor);
  if (!is_inside(outcome.unknowns)) return outcome;
  const VecOwner y(problem.make_vector(outcome.unknowns, true));
  options.max_iterations = 100;
  options.decrease_tolerance = final_decrease;
  monitor.minimise(
      comm, fixed_terms, y.get(), options, "integer-grid map",
      [&] { return pack(num_integer_phases(), goal, problem.gather(y.get(), goal.integers)); },
      goal.first_phase == num_integer_phases() ? goal.memory : std::vector<double>());
  outcome.unknowns = problem.gather(y.get(), goal.integers);
  outcome.reached = true;
  return outcome;
}

}  // namespace hexfield
