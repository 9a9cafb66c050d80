#include "hexfield/solve/kernels.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <random>

namespace hexfield::solve {
namespace {

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

class Random {
 public:
  double operator()() { return uniform_(engine_); }
  Mat3 matrix() {
    Mat3 m;
    for (int i = 0; i < 9; ++i) m(i / 3, i % 3) = (*this)();
    return m;
  }
  // det > 0, moderate condition.
  Mat3 positive() {
    for (;;) {
      const Mat3 m = matrix();
      if (m.determinant() > 0.05) return m;
    }
  }

 private:
  std::mt19937 engine_{7};
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

Vec9 as_vector(const Mat3& m) {
  const RowMajor3 r = m;
  return Eigen::Map<const Vec9>(r.data());
}

Vec9 gradient_of(const Mat3& m) {
  Vec9 g;
  Mat9 h;
  symmetric_dirichlet(m, g, h);
  return g;
}

Mat9 difference_hessian(const Mat3& j) {
  Mat9 h;
  const double step = 1e-5;
  for (int i = 0; i < 9; ++i) {
    Mat3 d = Mat3::Zero();
    d(i / 3, i % 3) = step;
    h.row(i) = (gradient_of(j + d) - gradient_of(j - d)).transpose() / (2 * step);
  }
  return 0.5 * (h + h.transpose());
}

TEST(Kernels, SvdReproducesTheMatrixAlsoWhenItIsNearlySingular) {
  Random random;
  for (int k = 0; k < 200; ++k) {
    Mat3 j = random.positive();
    if (k % 3 == 0) j.col(1) = j.col(0) * (1 + 1e-9 * j(0, 0)) + 1e-7 * j.col(2);
    if (k % 5 == 0) j = Mat3::Identity() * 3;
    const Svd3 s = svd(j);
    EXPECT_LT((s.u * s.sigma.asDiagonal() * s.v.transpose() - j).norm(), 1e-14 * j.norm());
    EXPECT_LT((s.u.transpose() * s.u - Mat3::Identity()).norm(), 1e-7);
    EXPECT_LT((s.v.transpose() * s.v - Mat3::Identity()).norm(), 1e-13);
  }
}

TEST(Kernels, SymmetricDirichletIsZeroAtRotationsAndInfiniteOutside) {
  const Mat3 r = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  EXPECT_NEAR(symmetric_dirichlet(r), 0.0, 1e-14);
  EXPECT_LT(gradient_of(r).norm(), 1e-14);
  EXPECT_NEAR(symmetric_dirichlet(2.0 * r), 3 * (4 + 0.25) - 6, 1e-13);
  EXPECT_EQ(symmetric_dirichlet(Mat3::Zero()), std::numeric_limits<double>::infinity());
  EXPECT_EQ(symmetric_dirichlet(-r), std::numeric_limits<double>::infinity());
}

TEST(Kernels, SymmetricDirichletGradientMatchesDifferences) {
  Random random;
  for (int k = 0; k < 50; ++k) {
    const Mat3 j = random.positive();
    const Mat3 d = random.matrix();
    const double step = 1e-6;
    const double difference = (symmetric_dirichlet(j + step * d) - symmetric_dirichlet(j - step * d)) / (2 * step);
    EXPECT_NEAR(gradient_of(j).dot(as_vector(d)), difference, 1e-5 * (1 + std::abs(difference)));
  }
}

TEST(Kernels, SymmetricDirichletHessianIsThePositivePartOfTheTrueOne) {
  Random random;
  for (int k = 0; k < 50; ++k) {
    const Mat3 j = random.positive();
    Vec9 g;
    Mat9 h;
    symmetric_dirichlet(j, g, h);
    EXPECT_LT((h - h.transpose()).norm(), 1e-12 * h.norm());
    const Eigen::SelfAdjointEigenSolver<Mat9> true_one(difference_hessian(j));
    const Mat9 clamped = true_one.eigenvectors() * true_one.eigenvalues().cwiseMax(0.0).asDiagonal() *
                         true_one.eigenvectors().transpose();
    EXPECT_LT((h - clamped).norm(), 1e-5 * clamped.norm());
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Mat9>(h).eigenvalues().minCoeff(), -1e-10 * h.norm());
  }
}

// First sign change of det along the ray on a fine grid, refined by bisection.
double bisected_inversion(const Mat3& j, const Mat3& d, double limit) {
  const int n = 20000;
  for (int i = 1; i <= n; ++i) {
    double low = limit * (i - 1) / n;
    double high = limit * i / n;
    if ((j + high * d).determinant() > 0) continue;
    for (int b = 0; b < 60; ++b) ((j + 0.5 * (low + high) * d).determinant() > 0 ? low : high) = 0.5 * (low + high);
    return low;
  }
  return std::numeric_limits<double>::infinity();
}

TEST(Kernels, FirstInversionMatchesBisection) {
  Random random;
  int finite = 0;
  for (int k = 0; k < 60; ++k) {
    const Mat3 j = random.positive();
    const Mat3 d = random.matrix();
    const double t = first_inversion(j, d);
    const double expected = bisected_inversion(j, d, 20);
    if (!std::isfinite(expected)) {
      EXPECT_GT(t, 20.0 - 1e-9);
      continue;
    }
    ++finite;
    EXPECT_NEAR(t, expected, 1e-10 * expected);
  }
  EXPECT_GT(finite, 20);
}

TEST(Kernels, FirstInversionHandlesDegenerateCubics) {
  const Mat3 identity = Mat3::Identity();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(first_inversion(identity, Mat3::Zero()), infinity);
  EXPECT_EQ(first_inversion(identity, identity), infinity);
  EXPECT_NEAR(first_inversion(identity, -identity), 1.0, 1e-5);  // triple root: ill-conditioned
  EXPECT_NEAR(first_inversion(identity, Vec3(-4, 0, 0).asDiagonal()), 0.25, 1e-15);
  EXPECT_NEAR(first_inversion(identity, Vec3(-1, -4, 0).asDiagonal()), 0.25, 1e-15);
  EXPECT_EQ(first_inversion(-identity, identity), 0.0);
  // A rotation by 180 degrees in one plane passes through det = 0 there.
  EXPECT_NEAR(first_inversion(identity, Vec3(-2, -2, 0).asDiagonal()), 0.5, 1e-7);
}

}  // namespace
}  // namespace hexfield::solve
