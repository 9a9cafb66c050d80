#include <gtest/gtest.h>

#include <random>

#include "../../src/quantize/programs.hpp"

using namespace hexfield;
using namespace hexfield::quantize;

namespace {

// Small programs with any equations and rows, and every integer point of a box.
struct Random {
  std::mt19937 engine{5};
  int number(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine); }
  ArcSum sum(int n, std::initializer_list<int> coefficients) {
    const std::vector<int> choices(coefficients);
    ArcSum s;
    for (int u = 0; u < n; ++u)
      if (number(0, 1) == 1)
        s.emplace_back(u, choices[static_cast<std::size_t>(number(0, static_cast<int>(choices.size()) - 1))]);
    return s;
  }
};

// The least objective with all lengths below `size`; negative when no point satisfies the program.
double least_objective(const Program& program, int size) {
  const std::size_t n = program.weights.size();
  std::vector<std::int64_t> x(n, 0);
  double best = -1;
  for (;;) {
    if (program.satisfied(x) && (best < 0 || program.objective(x) < best)) best = program.objective(x);
    std::size_t k = 0;
    while (k < n && ++x[k] == size) x[k++] = 0;
    if (k == n) return best;
  }
}

}  // namespace

TEST(SheetPump, FindsTheLeastObjectiveOfAllIntegers) {
  Random random;
  int solved = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const int n = random.number(2, 4);
    BundleSystem system;
    for (int u = 0; u < n; ++u) {
      system.size.push_back(random.number(1, 4));
      system.target.push_back(0.1 * random.number(1, 40));
    }
    for (int e = random.number(0, n - 1); e > 0; --e) {
      const ArcSum sum = random.sum(n, {-2, -1, 1, 1, -1});
      if (sum.size() >= 2) system.equations.push_back(sum);
    }
    Program program{system, system.size, std::vector<std::int64_t>(static_cast<std::size_t>(n), 0), {}, {}};
    if (random.number(0, 1) == 1) program.squares.push_back({random.sum(n, {1, -1}), 2, 0.3});
    SheetPump pump(program);
    pump.solve();
    for (int r = random.number(0, 2); r > 0; --r) {
      const ArcSum sum = random.sum(n, {1, 1, -1});
      if (!sum.empty()) program.rows.push_back({sum, random.number(1, 2)});
    }
    const double best = least_objective(program, 10);
    const auto found = pump.solve();
    if (best < 0) continue;
    ASSERT_TRUE(found.has_value()) << trial;
    EXPECT_TRUE(program.satisfied(found->x));
    EXPECT_LE(program.objective(found->x), best + 1e-9) << trial;
    solved += found->proven;
  }
  EXPECT_GT(solved, 100);
}

TEST(SheetPump, HalvesThatTheEquationsAskForAreDecided) {
  // 2 x = y + z with targets that pull y and z apart by an odd number.
  BundleSystem system;
  system.size = {1, 1, 1};
  system.target = {2.5, 2.1, 2.9};
  system.equations = {{{0, 2}, {1, -1}, {2, -1}}};
  const Program program{system, system.size, {0, 0, 0}, {}, {}};
  const auto found = SheetPump(program).solve();
  ASSERT_TRUE(found.has_value());
  EXPECT_TRUE(found->proven);
  EXPECT_NEAR(program.objective(found->x), least_objective(program, 8), 1e-12);
}
