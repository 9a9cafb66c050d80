#include "hexfield/solve/positivity.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <random>

#include "support/random_matrix.hpp"

using namespace hexfield;
using hexfield::testing::random_matrix;
using solve::positivity_penalty;

namespace {

constexpr double delta = 0.2;

}  // namespace

TEST(PositivityPenalty, DerivativesMatchFiniteDifferences) {
  std::mt19937 random(3);
  int active = 0;
  for (int k = 0; k < 50; ++k) {
    const Mat3 m = random_matrix(random) + 0.3 * Mat3::Identity();
    solve::Vec9 gradient, other;
    solve::Mat9 hessian, unused;
    const double value = positivity_penalty(m, delta, gradient, hessian);
    EXPECT_NEAR(value, positivity_penalty(m, delta), 1e-12);
    active += value > 0;
    const double h = 1e-5;
    for (int i = 0; i < 9; ++i) {
      Mat3 d = Mat3::Zero();
      d(i / 3, i % 3) = h;
      EXPECT_NEAR(gradient[i], (positivity_penalty(m + d, delta) - positivity_penalty(m - d, delta)) / (2 * h), 1e-4);
      positivity_penalty(m + d, delta, other, unused);
      const solve::Vec9 slope = (other - gradient) / h;
      EXPECT_NEAR((slope - hessian.col(i)).norm(), 0, 1e-2 * (1 + hessian.norm()));
    }
    const Eigen::SelfAdjointEigenSolver<solve::Mat9> eigen(hessian);
    EXPECT_GT(eigen.eigenvalues().minCoeff(), -1e-9);
  }
  EXPECT_GT(active, 20);
  EXPECT_LT(active, 50);
}

TEST(PositivityPenalty, IsConvexAndItsZerosHavePositiveDeterminants) {
  std::mt19937 random(4);
  int zeros = 0;
  for (int k = 0; k < 2000; ++k) {
    const Mat3 a = 2 * random_matrix(random) + Mat3::Identity(), b = 2 * random_matrix(random) + Mat3::Identity();
    EXPECT_LE(positivity_penalty(0.5 * (a + b), delta),
              0.5 * (positivity_penalty(a, delta) + positivity_penalty(b, delta)) + 1e-12);
    if (positivity_penalty(a, delta) > 0) continue;
    ++zeros;
    EXPECT_GT(a.determinant(), 0);
  }
  EXPECT_GT(zeros, 20);
}
