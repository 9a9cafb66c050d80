#pragma once

#include <chrono>

namespace hexfield {

/// The clock of all measured durations: of the wall, never set back.
using Clock = std::chrono::steady_clock;

inline double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace hexfield
