#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace hexfield {

/// A thread that calls `end` once `unheard` has been true for `patience` seconds: for wishes that a computation in the
/// hands of a library (a factorisation, an integer program) cannot hear. Both are called from that thread.
class Watchdog {
 public:
  Watchdog(std::function<bool()> unheard, double patience, std::function<void()> end);
  ~Watchdog();
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

 private:
  void watch();

  std::function<bool()> unheard_;
  double patience_;
  std::function<void()> end_;
  std::mutex mutex_;
  std::condition_variable done_;
  bool ended_ = false;
  std::thread thread_;  // last: it uses the others
};

}  // namespace hexfield
