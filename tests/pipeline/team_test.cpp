#include "../src/pipeline/team.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <thread>

#include "../src/pipeline/safe_points.hpp"
#include "hexfield/base/error.hpp"
#include "hexfield/base/signals.hpp"
#include "support/scratch.hpp"

namespace hexfield {
namespace {

TEST(Team, AFailureOfOneRankIsThatOfAll) {
  Log log(MPI_COMM_WORLD, LogLevel::off);
  Team team(MPI_COMM_WORLD, log);
  for (int failing = 0; failing < team.size(); ++failing) {
    try {
      team.together([&] {
        if (team.rank() == failing)
          throw Error(ExitCode::bad_hex_mesh, "rank " + std::to_string(failing), {4}, {Vec3(1, 2, 3)});
      });
      FAIL() << "no error on rank " << team.rank();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_hex_mesh);
      EXPECT_EQ(error.sentence(), "rank " + std::to_string(failing));
      EXPECT_EQ(error.places().at(0), Vec3(1, 2, 3));
    }
  }
  int done = 0;
  team.together([&] { done = 1; });
  EXPECT_EQ(done, 1);
}

TEST(Team, WorkOnRootHappensOnceAndItsFailureIsThatOfAll) {
  Log log(MPI_COMM_WORLD, LogLevel::off);
  Team team(MPI_COMM_WORLD, log);
  int calls = 0;
  team.on_root([&] { ++calls; });
  EXPECT_EQ(calls, team.is_root() ? 1 : 0);
  EXPECT_THROW(team.on_root([] { throw std::runtime_error("odd"); }), Error);
}

/// The last rank alone gets the signal; every rank must see the request.
TEST(SafePoints, ASignalToOneRankStopsAll) {
  Log log(MPI_COMM_WORLD, LogLevel::off);
  Team team(MPI_COMM_WORLD, log);
  catch_stop_signals();
  clear_stop_signal();
  SafePoints points(team, 0, 30);
  EXPECT_FALSE(points.stop_requested());
  if (team.rank() == team.size() - 1) std::raise(SIGUSR1);
  EXPECT_TRUE(points.stop_requested());
  EXPECT_EQ(points.reason(), "SIGUSR1");
  EXPECT_THROW(points.pass("here"), Error);
  clear_stop_signal();
}

TEST(SafePoints, AWaitingRankPassesItsSignalOn) {
  Log log(MPI_COMM_WORLD, LogLevel::off);
  Team team(MPI_COMM_WORLD, log);
  clear_stop_signal();
  SafePoints points(team, 0, 30);
  if (team.rank() == team.size() - 1) std::raise(SIGTERM);
  bool seen = false;
  team.on_root([&] {
    for (int tries = 0; tries < 5000 && !seen; ++tries) {
      seen = points.stop_requested_on_root();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
  EXPECT_EQ(seen, team.is_root());
  EXPECT_TRUE(points.stop_requested());
  EXPECT_EQ(points.reason(), "SIGTERM");
  clear_stop_signal();
}

TEST(SafePoints, IteratesComeBackOnResumeOnly) {
  Log log(MPI_COMM_WORLD, LogLevel::off);
  Team team(MPI_COMM_WORLD, log);
  clear_stop_signal();
  const testing::ScratchDirectory scratch;  // each rank has its own; only that of rank 0 counts
  Progress progress(log, "test");
  const auto gather = [&] { return team.is_root() ? std::vector<double>{1, 2, 3} : std::vector<double>{}; };
  {
    SafePoints points(team, 0, 0);
    points.keep_iterates_in(scratch.path(), false);
    const Control control = points.control("basis", progress);
    control.offer_iterate("energy", gather);
    EXPECT_FALSE(control.restore_iterate("energy").has_value());
  }
  SafePoints points(team, 0, 1000);
  points.keep_iterates_in(scratch.path(), true);
  const auto back = points.control("basis", progress).restore_iterate("energy");
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(*back, gather());
  EXPECT_FALSE(points.control("basis", progress).restore_iterate("another").has_value());
  EXPECT_FALSE(points.control("other options", progress).restore_iterate("energy").has_value());
}

}  // namespace
}  // namespace hexfield
