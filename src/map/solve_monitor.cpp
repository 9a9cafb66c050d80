#include "solve_monitor.hpp"

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
  const solve::NewtonResult result = solve::minimise(comm, terms, y, options);
  newton_steps_ += result.iterations;
  linear_iterations_ += result.linear_iterations;
  if (stop) throw Error(ExitCode::stopped, "The run was stopped: " + what + ".");
  return result;
}

}  // namespace hexfield
