#pragma once

#include <mpi.h>

#include <chrono>
#include <string>
#include <vector>

namespace hexfield {

/// Smallest, mean and largest value over the ranks.
struct Spread {
  double min = 0;
  double mean = 0;
  double max = 0;
};

/// Spread of one value per rank, the same on all ranks. Collective.
Spread spread_over_ranks(MPI_Comm comm, double value);

/// What one stage cost.
struct StageCost {
  std::string name;
  Spread seconds;      ///< wall time
  Spread peak_rss_mb;  ///< largest resident memory during the stage, in MiB
};

/// Resident memory of this process now and at its highest since the last reset, in MiB.
double resident_mb();
double peak_resident_mb();
/// Starts a new peak. Where the system does not allow it, the peak of the whole run so far stays.
void reset_peak_resident();

/// Wall time and peak memory per stage, in the order of the stages.
class Ledger {
 public:
  /// Not collective.
  void begin(const std::string& name);
  /// Ends the stage begun last and returns its cost over all ranks. Collective.
  const StageCost& end(MPI_Comm comm);
  /// Ends it with this rank's own figures, for a rank that cannot communicate any more. Not collective.
  const StageCost& end_alone();
  const std::vector<StageCost>& stages() const { return stages_; }

 private:
  double elapsed() const;

  std::vector<StageCost> stages_;
  std::string open_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace hexfield
