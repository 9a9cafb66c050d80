#pragma once

#include <atomic>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "hexfield/base/control.hpp"
#include "hexfield/base/progress.hpp"
#include "hexfield/base/stopwatch.hpp"
#include "hexfield/io/checkpoint.hpp"
#include "team.hpp"

namespace hexfield {

/// Decides at the safe points of a run whether it ends now, and keeps the iterates of long solves.
class SafePoints {
 public:
  /// `time_limit` and `checkpoint_interval` in seconds; no limit when 0.
  SafePoints(Team& team, double time_limit, double checkpoint_interval);

  /// Where iterates are kept from now on; restored from there when `resume`.
  void keep_iterates_in(std::filesystem::path directory, bool resume);

  /// True on all ranks once any of them got a stop signal or the time is up. Collective.
  bool stop_requested();
  /// The same for rank 0 alone while the others wait in Team::on_root(). May be asked from any thread; signals of
  /// other ranks are heard by the main thread only.
  bool stop_requested_on_root();
  /// Whether this rank has a cause to stop that nothing has asked for yet. Called from any thread.
  bool unheard() const { return cause_ == 0 && local_cause() != 0; }
  /// Throws Error(stopped) with its reason when stop_requested(). Collective.
  void pass(const std::string& where);
  /// The same when a Control of this object has told the stage that just returned to stop: it has no result.
  /// Collective.
  void pass_if_told(const std::string& where);
  /// "SIGTERM" or "the time limit of 60 s"; only after a stop was requested.
  std::string reason() const;

  /// For a collective stage whose result depends on `basis`.
  Control control(const std::string& basis, Progress& progress);
  /// For a stage that runs on rank 0 only, inside Team::on_root().
  Control control_on_root(Progress& progress);
  /// Keeps an iterate of such a stage when it is time to, and gives back the newest one of an interrupted run.
  void offer_on_root(const std::string& name, const std::string& basis, const std::function<NamedArrays()>& gather);
  std::optional<NamedArrays> restore_on_root(const std::string& name, const std::string& basis);

 private:
  int local_cause() const;
  IterateRing& ring_on_root(const std::string& name, const std::string& basis);
  void offer(IterateRing& ring, const std::function<std::vector<double>()>& gather);

  Team& team_;
  double time_limit_;
  double checkpoint_interval_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_checkpoint_ = start_;
  std::map<std::string, IterateRing> rings_on_root_;  ///< by name and basis
  std::filesystem::path directory_;
  bool resume_ = false;
  std::atomic<bool> told_ = false;
  std::atomic<int> cause_ = 0;  ///< 0: none, a signal number, or time_is_up
};

}  // namespace hexfield
