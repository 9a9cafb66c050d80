#include "solve_monitor.hpp"

#include <algorithm>

#include "collective.hpp"
#include "hexfield/base/error.hpp"
#include "hexfield/base/petsc.hpp"
#include "hexfield/base/stopwatch.hpp"

namespace hexfield {
namespace {

/// Assembly, factorisation and line search, in iterations of the linear solver.
constexpr long work_of_step = 20;
constexpr std::size_t head = 4;  // numbers before the y of the factorisation

// Three numbers, whether there is a factorisation, and its y; the number of all that last, for take_memory().
void append(std::vector<double>& iterate, const solve::NewtonMemory& memory) {
  if (iterate.empty()) return;
  const std::size_t before = iterate.size();
  iterate.insert(iterate.end(), {static_cast<double>(memory.iterations), memory.start_norm, memory.start_energy,
                                 memory.has_factor ? 1.0 : 0.0});
  if (memory.has_factor) {
    PetscInt size = 0;
    const PetscScalar* data = nullptr;
    check_petsc(VecGetLocalSize(memory.factored_at.get(), &size), "VecGetLocalSize");
    check_petsc(VecGetArrayRead(memory.factored_at.get(), &data), "VecGetArrayRead");
    iterate.insert(iterate.end(), data, data + size);
    check_petsc(VecRestoreArrayRead(memory.factored_at.get(), &data), "VecRestoreArrayRead");
  }
  iterate.push_back(static_cast<double>(iterate.size() - before));
}

void unpack(MPI_Comm comm, const std::vector<double>& row, Vec y, solve::NewtonMemory& memory) {
  PetscInt size = 0;
  check_petsc(VecGetLocalSize(y, &size), "VecGetLocalSize");
  std::vector<double> numbers(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(std::min(head, row.size())));
  // Only what fits y is gone on with.
  if (numbers.size() < head || (numbers[3] != 0 && row.size() != head + static_cast<std::size_t>(size)))
    numbers.clear();
  broadcast(comm, numbers);
  if (numbers.empty()) return;
  memory.iterations = static_cast<int>(numbers[0]);
  memory.start_norm = numbers[1];
  memory.start_energy = numbers[2];
  memory.has_factor = numbers[3] != 0;
  if (!memory.has_factor) return;
  check_petsc(VecDuplicate(y, memory.factored_at.out()), "VecDuplicate");
  PetscScalar* data = nullptr;
  check_petsc(VecGetArray(memory.factored_at.get(), &data), "VecGetArray");
  if (size > 0) std::copy(row.begin() + head, row.end(), data);
  check_petsc(VecRestoreArray(memory.factored_at.get(), &data), "VecRestoreArray");
}

}  // namespace

std::vector<double> take_memory(std::vector<double>& iterate) {
  if (iterate.empty()) return {};
  const double size = iterate.back();
  if (!(size >= head && size < static_cast<double>(iterate.size()))) return {};
  const auto begin = iterate.end() - 1 - static_cast<std::ptrdiff_t>(size);
  std::vector<double> memory(begin, iterate.end() - 1);
  iterate.erase(begin, iterate.end());
  return memory;
}

solve::NewtonResult SolveMonitor::minimise(MPI_Comm comm, std::span<const solve::EnergyTerm* const> terms, Vec y,
                                           solve::NewtonOptions options, const std::string& what,
                                           const std::function<std::vector<double>()>& gather,
                                           const std::vector<double>& memory) {
  bool stop = false, in_step = false;
  solve::NewtonMemory newton;
  unpack(comm, memory, y, newton);
  options.memory = &newton;
  const int behind = newton.iterations;
  const auto offer = [&] {
    if (!control_.offer_iterate || !gather) return;
    control_.offer_iterate(name_, [&] {
      std::vector<double> iterate = gather();
      append(iterate, newton);
      return iterate;
    });
  };
  options.monitor = [&](int, double, double) {
    if (control_.progress) control_.progress(what, -1);
    offer();
    stop = stop_requested();
    return !stop;
  };
  options.interrupted = [&] { return stop = in_step = stop_requested(); };
  const Clock::time_point start = Clock::now();
  const solve::NewtonResult result = solve::minimise(comm, terms, y, options);
  note({what, result.iterations - behind, result.linear_iterations, seconds_since(start)});
  work_ += result.linear_iterations + work_of_step * (result.iterations - behind + 1);
  if (!stop) return result;
  if (in_step) offer();  // the last one came before the run was to end, and may not have been taken
  throw Error(ExitCode::stopped, "The run was stopped: " + what + ".");
}

solve::NewtonResult SolveMonitor::solve_linear(MPI_Comm comm, std::span<const solve::EnergyTerm* const> terms, Vec y,
                                               solve::Preconditioner preconditioner, const std::string& what) {
  if (control_.progress) control_.progress(what, -1);
  const Clock::time_point start = Clock::now();
  const solve::NewtonResult result =
      solve::solve_linear(comm, terms, y, preconditioner, 1, [&] { return stop_requested(); });
  note({what, 0, result.linear_iterations, seconds_since(start)});
  work_ += result.linear_iterations + work_of_step * result.iterations;
  if (result.end == solve::NewtonEnd::stopped) throw Error(ExitCode::stopped, "The run was stopped: " + what + ".");
  return result;
}

void SolveMonitor::note(const SolveRecord& solve) {
  if (solves_.empty() || solves_.back().what != solve.what || solves_.back().inverted >= 0) {
    solves_.push_back(solve);
    return;
  }
  solves_.back().newton_steps += solve.newton_steps;
  solves_.back().linear_iterations += solve.linear_iterations;
  solves_.back().seconds += solve.seconds;
}

void SolveMonitor::note_defects(const MapReport& report) {
  if (solves_.empty()) return;
  solves_.back().inverted = static_cast<int>(report.inverted.size());
  solves_.back().wrong_edges = static_cast<int>(report.wrong_edges.size());
}

int SolveMonitor::newton_steps() const {
  int sum = 0;
  for (const SolveRecord& s : solves_) sum += s.newton_steps;
  return sum;
}

int SolveMonitor::linear_iterations() const {
  int sum = 0;
  for (const SolveRecord& s : solves_) sum += s.linear_iterations;
  return sum;
}

}  // namespace hexfield
