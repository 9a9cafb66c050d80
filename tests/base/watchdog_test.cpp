#include "hexfield/base/watchdog.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>

using namespace hexfield;

namespace {

void wait_for(const std::atomic<int>& number, int value) {
  for (int tries = 0; tries < 10000 && number < value; ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

}  // namespace

TEST(Watchdog, EndsOnceWhatNobodyHears) {
  std::atomic<int> ends = 0;
  const Watchdog dog([] { return true; }, 0.0, [&] { ++ends; });
  wait_for(ends, 1);
  EXPECT_EQ(ends, 1);
}

TEST(Watchdog, LeavesAloneWhatIsHeard) {
  std::atomic<int> looks = 0, ends = 0;
  {
    // Unheard for one look at a time only.
    const Watchdog dog([&] { return ++looks % 2 == 0; }, 3600, [&] { ++ends; });
    wait_for(looks, 5);
  }
  EXPECT_GE(looks, 5);
  EXPECT_EQ(ends, 0);
}
