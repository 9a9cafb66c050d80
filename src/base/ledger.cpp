#include "hexfield/base/ledger.hpp"

#include <array>
#include <fstream>

#include "hexfield/base/error.hpp"

namespace hexfield {
namespace {

/// Value in MiB of a "Name:  123 kB" line of the process status; 0 when there is none.
double status_mb(const std::string& name) {
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word) {
    if (word == name) {
      double kilobytes = 0;
      status >> kilobytes;
      return kilobytes / 1024;
    }
    status.ignore(4096, '\n');
  }
  return 0;
}

}  // namespace

Spread spread_over_ranks(MPI_Comm comm, double value) {
  int size = 1;
  MPI_Comm_size(comm, &size);
  std::array<double, 2> extremes = {-value, value};
  MPI_Allreduce(MPI_IN_PLACE, extremes.data(), 2, MPI_DOUBLE, MPI_MAX, comm);
  double sum = value;
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, comm);
  return {-extremes[0], sum / size, extremes[1]};
}

double resident_mb() { return status_mb("VmRSS:"); }

double peak_resident_mb() { return status_mb("VmHWM:"); }

void reset_peak_resident() { std::ofstream("/proc/self/clear_refs") << "5"; }

void Ledger::begin(const std::string& name) {
  require(open_.empty(), "A stage of the ledger was begun before the last one ended.");
  open_ = name;
  reset_peak_resident();
  start_ = std::chrono::steady_clock::now();
}

double Ledger::elapsed() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

const StageCost& Ledger::end(MPI_Comm comm) {
  require(!open_.empty(), "A stage of the ledger was ended that was not begun.");
  stages_.push_back({open_, spread_over_ranks(comm, elapsed()), spread_over_ranks(comm, peak_resident_mb())});
  open_.clear();
  return stages_.back();
}

const StageCost& Ledger::end_alone() { return end(MPI_COMM_SELF); }

}  // namespace hexfield
