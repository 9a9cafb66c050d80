#include "safe_points.hpp"

#include <fmt/format.h>

#include <csignal>

#include "hexfield/base/agree.hpp"
#include "hexfield/base/error.hpp"
#include "hexfield/base/signals.hpp"

namespace hexfield {
namespace {

constexpr int time_is_up = 1000;

/// The rings of one stage by the name of the iterate.
using Rings = std::map<std::string, IterateRing>;

IterateRing& ring_of(Rings& rings, const std::filesystem::path& directory, const std::string& name,
                     const std::string& basis) {
  return rings.try_emplace(name, directory, name, basis).first->second;
}

}  // namespace

SafePoints::SafePoints(Team& team, double time_limit, double checkpoint_interval)
    : team_(team), time_limit_(time_limit), checkpoint_interval_(checkpoint_interval) {}

void SafePoints::keep_iterates_in(std::filesystem::path directory, bool resume) {
  directory_ = std::move(directory);
  resume_ = resume;
}

int SafePoints::local_cause() const {
  if (const int number = stop_signal(); number != 0) return number;
  return time_limit_ > 0 && seconds_since(start_) > time_limit_ ? time_is_up : 0;
}

bool SafePoints::stop_requested() {
  int cause = cause_ != 0 ? cause_.load() : local_cause();
  MPI_Allreduce(MPI_IN_PLACE, &cause, 1, MPI_INT, MPI_MAX, team_.comm());
  cause_ = cause;
  return cause_ != 0;
}

bool SafePoints::stop_requested_on_root() {
  if (cause_ != 0) return true;
  int cause = local_cause();
  int main_thread = 0;
  MPI_Is_thread_main(&main_thread);
  if (int number = 0; cause == 0 && main_thread != 0 && team_.stop_passed_on(number)) cause = number;
  // Never back to "none": another thread may have found a cause meanwhile.
  if (cause != 0) cause_ = cause;
  return cause_ != 0;
}

std::string SafePoints::reason() const {
  switch (cause_) {
    case SIGTERM:
      return "SIGTERM";
    case SIGINT:
      return "SIGINT";
    case SIGUSR1:
      return "SIGUSR1";
    case time_is_up:
      return fmt::format("the time limit of {} s", time_limit_);
    default:
      return fmt::format("signal {}", cause_);
  }
}

void SafePoints::pass(const std::string& where) {
  if (stop_requested()) throw Error(ExitCode::stopped, fmt::format("Stopped {} by {}.", where, reason()));
}

void SafePoints::pass_if_told(const std::string& where) {
  int told = told_ ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &told, 1, MPI_INT, MPI_MAX, team_.comm());
  if (told != 0) pass(where);
}

void SafePoints::offer(IterateRing& ring, const std::function<std::vector<double>()>& gather) {
  int write = cause_ != 0 || seconds_since(last_checkpoint_) >= checkpoint_interval_ ? 1 : 0;
  MPI_Bcast(&write, 1, MPI_INT, 0, team_.comm());
  if (write == 0) return;
  const std::vector<double> values = gather();
  agree(team_.comm(), [&] {
    if (team_.is_root()) ring.save(values);
  });
  last_checkpoint_ = Clock::now();
}

Control SafePoints::control(const std::string& basis, Progress& progress) {
  auto rings = std::make_shared<Rings>();
  Control control;
  control.progress = [&progress](const std::string& what, double fraction) { progress.report(what, fraction); };
  control.stop_requested = [this] { return told_ = stop_requested(); };
  control.offer_iterate = [this, rings, basis](const std::string& name,
                                               const std::function<std::vector<double>()>& gather) {
    offer(ring_of(*rings, directory_, name, basis), gather);
  };
  control.restore_iterate = [this, rings, basis](const std::string& name) -> std::optional<std::vector<double>> {
    std::optional<std::vector<double>> found;
    if (resume_ && team_.is_root()) found = ring_of(*rings, directory_, name, basis).newest();
    int has = found ? 1 : 0;
    MPI_Bcast(&has, 1, MPI_INT, 0, team_.comm());
    if (has == 0) return std::nullopt;
    return team_.is_root() ? std::move(found) : std::optional<std::vector<double>>(std::in_place);
  };
  return control;
}

Control SafePoints::control_on_root(Progress& progress) {
  Control control;
  control.progress = [&progress](const std::string& what, double fraction) { progress.report(what, fraction); };
  control.stop_requested = [this] {
    if (!stop_requested_on_root()) return false;
    told_ = true;
    return true;
  };
  return control;
}

IterateRing& SafePoints::ring_on_root(const std::string& name, const std::string& basis) {
  return rings_on_root_.try_emplace(name + basis, directory_, name, basis).first->second;
}

void SafePoints::offer_on_root(const std::string& name, const std::string& basis,
                               const std::function<NamedArrays()>& gather) {
  if (cause_ == 0 && seconds_since(last_checkpoint_) < checkpoint_interval_) return;
  ring_on_root(name, basis).save(gather());
  last_checkpoint_ = Clock::now();
}

std::optional<NamedArrays> SafePoints::restore_on_root(const std::string& name, const std::string& basis) {
  return resume_ ? ring_on_root(name, basis).newest_arrays() : std::nullopt;
}

}  // namespace hexfield
