#include "hexfield/base/watchdog.hpp"

#include <chrono>

#include "hexfield/base/stopwatch.hpp"

namespace hexfield {

namespace {

constexpr std::chrono::milliseconds between_looks(100);

}  // namespace

Watchdog::Watchdog(std::function<bool()> unheard, double patience, std::function<void()> end)
    : unheard_(std::move(unheard)), patience_(patience), end_(std::move(end)), thread_([this] { watch(); }) {}

Watchdog::~Watchdog() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ended_ = true;
  }
  done_.notify_all();
  thread_.join();
}

void Watchdog::watch() {
  Clock::time_point heard = Clock::now();
  std::unique_lock<std::mutex> lock(mutex_);
  while (!done_.wait_for(lock, between_looks, [&] { return ended_; })) {
    if (!unheard_()) heard = Clock::now();
    if (seconds_since(heard) < patience_) continue;
    end_();
    return;
  }
}

}  // namespace hexfield
