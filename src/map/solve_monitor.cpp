#include "solve_monitor.hpp"

#include <chrono>

#include "hexfield/base/error.hpp"

namespace hexfield {

solve::NewtonResult SolveMonitor::minimise(MPI_Comm comm, std::span<const solve::EnergyTerm* const> terms, Vec y,
                                           solve::NewtonOptions options, const std::string& what,
                                           const std::function<std::vector<double>()>& gather) {
  bool stop = false;
  options.monitor = [&](int, double, double) {
    if (control_.progress) control_.progress(what, -1);
    if (control_.offer_iterate && gather) control_.offer_iterate(name_, gather);
    stop = control_.stop_requested && control_.stop_requested();
    return !stop;
  };
  const auto start = std::chrono::steady_clock::now();
  const solve::NewtonResult result = solve::minimise(comm, terms, y, options);
  note({what, result.iterations, result.linear_iterations,
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()});
  if (stop) throw Error(ExitCode::stopped, "The run was stopped: " + what + ".");
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
