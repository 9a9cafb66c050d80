#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "hexfield/base/log.hpp"

namespace hexfield {

/// Duration for people: "42 s", "3 min 05 s", "2 h 07 min".
std::string readable_duration(double seconds);

/// One line on a task that is `fraction` done (negative: unknown) after `elapsed` seconds, with the time left
/// estimated by proportion once 2 % are done: "field: smoothing 40 %, 12 s, about 18 s left".
std::string progress_line(const std::string& stage, const std::string& what, double fraction, double elapsed);

/// Shows the progress of one stage: a line that is replaced in place on an interactive terminal (at most ten
/// times a second), otherwise plain lines, at most one per `plain_interval` seconds. Only rank 0 says anything.
class Progress {
 public:
  Progress(Log& log, std::string stage, double plain_interval = 30.0);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Not collective.
  void report(const std::string& what, double fraction);

 private:
  using Clock = std::chrono::steady_clock;
  Log& log_;
  std::string stage_;
  double plain_interval_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point what_start_ = start_;
  Clock::time_point last_ = start_;
  std::string what_;
};

}  // namespace hexfield
