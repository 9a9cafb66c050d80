#include "hexfield/base/exact_sum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace hexfield {
namespace {

int rank_of(MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  return rank;
}

TEST(ExactSum, SameBitsForAnyOrderAndDistribution) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<double> terms(20000);
  for (double& t : terms) t = std::ldexp(uniform(random), static_cast<int>(random() % 40) - 30);
  const long double expected = std::accumulate(terms.begin(), terms.end(), 0.0L);
  const double alone = exact_sum(MPI_COMM_SELF, terms);
  EXPECT_NEAR(alone, static_cast<double>(expected), 1e-13 * std::abs(static_cast<double>(expected)));
  std::shuffle(terms.begin(), terms.end(), random);
  EXPECT_EQ(exact_sum(MPI_COMM_SELF, terms), alone);
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  std::vector<double> mine;
  for (std::size_t i = 0; i < terms.size(); ++i)
    if (static_cast<int>((i * i) % static_cast<std::size_t>(ranks)) == rank_of(MPI_COMM_WORLD))
      mine.push_back(terms[i]);
  EXPECT_EQ(exact_sum(MPI_COMM_WORLD, mine), alone);
}

TEST(ExactSum, NothingAndNotANumber) {
  EXPECT_EQ(exact_sum(MPI_COMM_WORLD, {}), 0);
  const std::vector<double> bad = {1, std::nan(""), 2};
  EXPECT_TRUE(std::isnan(exact_sum(MPI_COMM_WORLD, bad)));
}

}  // namespace
}  // namespace hexfield
