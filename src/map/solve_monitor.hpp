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

  /// Adds to the record; solves of one name in a row become one entry.
  void note(const SolveRecord& solve);
  /// What a check of the map after the last solve found.
  void note_defects(const MapReport& report);

  const std::vector<SolveRecord>& solves() const { return solves_; }
  int newton_steps() const;
  int linear_iterations() const;

 private:
  const Control& control_;
  std::string name_;
  std::vector<SolveRecord> solves_;
};

/// Cuts the memory of Newton's method off an iterate that SolveMonitor offered; empty when there is none.
std::vector<double> take_memory(std::vector<double>& iterate);

}  // namespace hexfield
