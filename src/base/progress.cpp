#include "hexfield/base/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace hexfield {
namespace {

double seconds_between(std::chrono::steady_clock::time_point a, std::chrono::steady_clock::time_point b) {
  return std::chrono::duration<double>(b - a).count();
}

}  // namespace

std::string readable_duration(double seconds) {
  const auto whole = static_cast<long long>(std::llround(std::max(0.0, seconds)));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

std::string progress_line(const std::string& stage, const std::string& what, double fraction, double elapsed) {
  std::string line = what.empty() ? stage : fmt::format("{}: {}", stage, what);
  if (fraction >= 0) line += fmt::format(" {:.0f} %", 100 * std::min(fraction, 1.0));
  line += fmt::format(", {}", readable_duration(elapsed));
  if (fraction >= 0.02 && fraction < 1) {
    line += fmt::format(", about {} left", readable_duration(elapsed * (1 - fraction) / fraction));
  }
  return line;
}

Progress::Progress(Log& log, std::string stage, double plain_interval)
    : log_(log), stage_(std::move(stage)), plain_interval_(plain_interval) {
  if (log_.interactive()) log_.transient_line(stage_);
}

Progress::~Progress() { log_.transient_line(""); }

void Progress::report(const std::string& what, double fraction) {
  const auto now = Clock::now();
  if (what != what_) {
    what_ = what;
    what_start_ = now;
  }
  const bool terminal = log_.interactive();
  if (seconds_between(last_, now) < (terminal ? 0.1 : plain_interval_)) return;
  last_ = now;
  const std::string line = progress_line(stage_, what, fraction, seconds_between(what_start_, now));
  if (terminal) {
    log_.transient_line(line);
  } else {
    log_.info(line);
  }
}

}  // namespace hexfield
