#include "hexfield/solve/untangling.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <random>

#include "support/random_matrix.hpp"

using namespace hexfield;
using hexfield::testing::random_matrix;
using solve::untangle_energy;

TEST(UntangleEnergy, GradientMatchesFiniteDifferencesOnBothSidesOfZeroVolume) {
  std::mt19937 random(1);
  int negative = 0;
  for (int k = 0; k < 50; ++k) {
    const Mat3 j = random_matrix(random);
    negative += j.determinant() < 0;
    Eigen::Matrix<double, 9, 1> gradient;
    Eigen::Matrix<double, 9, 9, Eigen::RowMajor> hessian;
    const double value = untangle_energy(j, 0.3, gradient, hessian);
    EXPECT_DOUBLE_EQ(value, untangle_energy(j, 0.3));
    for (int i = 0; i < 9; ++i) {
      Mat3 d = Mat3::Zero();
      d(i / 3, i % 3) = 1e-6;
      const double slope = (untangle_energy(j + d, 0.3) - untangle_energy(j - d, 0.3)) / 2e-6;
      EXPECT_NEAR(gradient[i], slope, 1e-5 * (1 + std::abs(value)));
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> eigen(hessian);
    EXPECT_GT(eigen.eigenvalues().minCoeff(), -1e-9 * eigen.eigenvalues().maxCoeff());
  }
  EXPECT_GT(negative, 10);
  EXPECT_LT(negative, 40);
}

TEST(UntangleEnergy, IsLeastAtRotations) {
  std::mt19937 random(2);
  const double best = untangle_energy(Mat3::Identity(), 0);
  for (int k = 0; k < 50; ++k) {
    Mat3 j = Mat3::Identity() + 0.1 * random_matrix(random);
    EXPECT_GT(untangle_energy(j, 0), best);
  }
}
