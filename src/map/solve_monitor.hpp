#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "hexfield/base/control.hpp"
#include "hexfield/map/compute_map.hpp"
#include "hexfield/solve/minimise.hpp"

namespace hexfield {

/// Joins the long solves of a stage to their listener: after every Newton step it reports progress, offers
/// the iterate for a checkpoint and asks whether to stop; keeps the record of what they cost. All calls are
/// collective.
class SolveMonitor {
 public:
  /// `name` is that of the iterate in checkpoints.
  SolveMonitor(const Control& control, std::string name) : control_(control), name_(std::move(name)) {}

  /// Runs minimise() with this monitor on a y that rank 0 owns; `gather` gives the iterate of the moment on rank 0
  /// (when empty, nothing is offered), to which the memory of Newton's method is added. `memory`: what take_memory()
  /// found in the iterate of an interrupted run that y comes from (rank 0). Counts steps.
  /// Throws Error(stopped) when the run must end, after the iterate was offered.
  solve::NewtonResult minimise(MPI_Comm comm, std::span<const solve::EnergyTerm* const> terms, Vec y,
                               solve::NewtonOptions options, const std::string& what,
                               const std::function<std::vector<double>()>& gather,
                               const std::vector<double>& memory = {});

  /// solve::solve_linear() with this monitor, in the record as `what`. Throws Error(stopped).
  solve::NewtonResult solve_linear(MPI_Comm comm, std::span<const solve::EnergyTerm* const> terms, Vec y,
                                   solve::Preconditioner preconditioner, const std::string& what);

  /// Work of all minimisations and linear solves so far: iterations of the linear solver, with what the assembly and
  /// factorisation of each Newton step is worth. The time of one is about proportional to the size of the mesh.
  long work() const { return work_; }
  /// When the work is beyond `max_work`, exhausted() tells loops over minimisations to give up.
  void limit_work(long max_work) { max_work_ = max_work; }
  bool exhausted() const { return max_work_ > 0 && work_ > max_work_; }

  /// Adds to the record; solves of one name in a row become one entry.
  void note(const SolveRecord& solve);
  /// What a check of the map after the last solve found.
  void note_defects(const MapReport& report);

  const std::vector<SolveRecord>& solves() const { return solves_; }
  int newton_steps() const;
  int linear_iterations() const;

 private:
  bool stop_requested() const { return control_.stop_requested && control_.stop_requested(); }

  const Control& control_;
  std::string name_;
  std::vector<SolveRecord> solves_;
  long work_ = 0;
  long max_work_ = 0;
};

/// Cuts the memory of Newton's method off an iterate that SolveMonitor offered; empty when there is none.
std::vector<double> take_memory(std::vector<double>& iterate);

}  // namespace hexfield
