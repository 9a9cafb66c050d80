#include "hexfield/base/ledger.hpp"

#include <gtest/gtest.h>

#include "hexfield/base/launch.hpp"
#include "hexfield/base/progress.hpp"

namespace hexfield {
namespace {

TEST(Ledger, SpreadKnowsAllRanks) {
  int rank = 0;
  int size = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  const Spread spread = spread_over_ranks(MPI_COMM_WORLD, 10.0 + rank);
  EXPECT_EQ(spread.min, 10.0);
  EXPECT_DOUBLE_EQ(spread.mean, 10.0 + (size - 1) / 2.0);
  EXPECT_EQ(spread.max, 9.0 + size);
}

TEST(Ledger, SeesTheMemoryOfAStage) {
  Ledger ledger;
  ledger.begin("large");
  {
    std::vector<char> memory(64 << 20, 1);
    EXPECT_EQ(memory[5], 1);
  }
  const double large = ledger.end(MPI_COMM_WORLD).peak_rss_mb.min;
  EXPECT_GT(large, 64);
  ASSERT_EQ(ledger.stages().size(), 1u);
  EXPECT_EQ(ledger.stages()[0].name, "large");
  EXPECT_GE(ledger.stages()[0].seconds.max, ledger.stages()[0].seconds.min);
}

TEST(Launch, EveryRankHasAThread) { EXPECT_GE(threads_given_to_rank(MPI_COMM_WORLD), 1); }

TEST(Progress, EstimatesTheTimeLeftByProportion) {
  EXPECT_EQ(progress_line("field", "smoothing", 0.4, 12), "field: smoothing 40 %, 12 s, about 18 s left");
  EXPECT_EQ(progress_line("field", "", -1, 65), "field, 1 min 05 s");
  EXPECT_EQ(progress_line("igm", "rounding", 0.001, 1), "igm: rounding 0 %, 1 s");
  EXPECT_EQ(readable_duration(7620), "2 h 07 min");
}

}  // namespace
}  // namespace hexfield
