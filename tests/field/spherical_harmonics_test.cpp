#include "hexfield/field/spherical_harmonics.hpp"

#include <gtest/gtest.h>

#include <random>

#include "hexfield/base/octahedral.hpp"

using namespace hexfield;
using namespace hexfield::harmonics;

namespace {

Quaternion about(const Vec3& axis, double degrees) {
  return Quaternion(Eigen::AngleAxisd(degrees * M_PI / 180, axis.normalized()));
}

Quaternion random_rotation(std::mt19937& random) {
  std::normal_distribution<double> n;
  const double w = n(random), x = n(random), y = n(random), z = n(random);
  return Quaternion(w, x, y, z).normalized();
}

double angle_up_to_symmetry(const Quaternion& a, const Quaternion& b) {
  const Quaternion rest = octahedral::quaternion(octahedral::matching(a, b)).conjugate() * a.conjugate() * b;
  return 2 * rest.vec().norm();
}

}  // namespace

TEST(SphericalHarmonics, ReferenceIsFixedByQuarterTurns) {
  EXPECT_NEAR(reference().norm(), 1, 1e-15);
  for (int k = 0; k < 3; ++k)
    EXPECT_LT((rotated(about(Vec3::Unit(k), 90), reference()) - reference()).norm(), 1e-12) << k;
}

TEST(SphericalHarmonics, KnownInnerProductsOfRotatedFrames) {
  auto dot = [](const Vec3& axis, double degrees) {
    return reference().dot(rotated(about(axis, degrees), reference()));
  };
  EXPECT_NEAR(dot({0, 0, 1}, 45), 1.0 / 6, 1e-12);
  EXPECT_NEAR(dot({1, 1, 1}, 60), -13.0 / 27, 1e-12);
  EXPECT_NEAR(dot({1, 1, 0}, 90), -11.0 / 24, 1e-12);
  EXPECT_NEAR(dot({1, 1, 0}, 180), 1, 1e-12);
}

TEST(SphericalHarmonics, TurnAboutZMovesOnlyTheOuterComponents) {
  for (double degrees : {10.0, 33.0, 80.0, -25.0}) {
    Sh expected = reference();
    expected[0] = std::sqrt(5.0 / 12) * std::sin(4 * degrees * M_PI / 180);
    expected[8] = std::sqrt(5.0 / 12) * std::cos(4 * degrees * M_PI / 180);
    EXPECT_LT((rotated(about(Vec3::UnitZ(), degrees), reference()) - expected).norm(), 1e-13);
    EXPECT_LT((of_frame(about(Vec3::UnitZ(), degrees)) - expected).norm(), 1e-13);
  }
}

TEST(SphericalHarmonics, RotationOfVectorsAndOfFramesAgreeWithGenerators) {
  std::mt19937 random(1);
  for (int n = 0; n < 50; ++n) {
    const Quaternion a = random_rotation(random);
    const Quaternion b = random_rotation(random);
    EXPECT_LT((rotated(a, of_frame(b)) - of_frame(a * b)).norm(), 1e-12);
    EXPECT_LT((rotated(a, zonal(Vec3::UnitZ())) - zonal(a * Vec3::UnitZ())).norm(), 1e-12);
    const auto j = tangent(of_frame(b));
    EXPECT_LT((j.transpose() * j - 20.0 / 3 * Mat3::Identity()).norm(), 1e-12);
    for (int k = 0; k < 3; ++k) {
      const double h = 1e-5;
      const Sh forward = of_frame(Quaternion(Eigen::AngleAxisd(h, Vec3::Unit(k))) * b);
      const Sh backward = of_frame(Quaternion(Eigen::AngleAxisd(-h, Vec3::Unit(k))) * b);
      EXPECT_LT(((forward - backward) / (2 * h) - j.col(k)).norm(), 1e-8);
    }
  }
}

TEST(SphericalHarmonics, ProjectionRecoversFramesUpToSymmetry) {
  std::mt19937 random(2);
  for (int n = 0; n < 500; ++n) {
    const Quaternion r = random_rotation(random);
    const Projected p = project(0.37 * of_frame(r));
    EXPECT_LT(angle_up_to_symmetry(p.frame, r), 1e-6);
    EXPECT_NEAR(p.dot, 0.37, 1e-12);
  }
}

TEST(SphericalHarmonics, ProjectionIsAMaximumThatManyMoreSeedsDoNotBeat) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  int beaten = 0;
  for (int n = 0; n < 100; ++n) {
    Sh q;
    for (int i = 0; i < 9; ++i) q[i] = normal(random);
    const Projected p = project(q);
    EXPECT_LT((tangent(p.sh).transpose() * q).norm(), 1e-10);
    double best = p.dot;
    for (int k = 0; k < 40; ++k) best = std::max(best, project_from(q, random_rotation(random)).dot);
    beaten += best > p.dot + 1e-9;
  }
  EXPECT_LE(beaten, 5);
}

TEST(SphericalHarmonics, AlignedFramesAndTheirTwist) {
  std::mt19937 random(4);
  for (int n = 0; n < 100; ++n) {
    const Vec3 direction = random_rotation(random) * Vec3::UnitX();
    const AlignedBasis basis = aligned_basis(direction);
    EXPECT_LT((basis.twist.transpose() * basis.twist - Eigen::Matrix2d::Identity()).norm(), 1e-12);
    EXPECT_LT((basis.twist.transpose() * basis.offset).norm(), 1e-12);
    const Quaternion r = random_rotation(random);
    const Projected p = project(of_frame(r), basis);
    EXPECT_NEAR((p.frame * Vec3::UnitZ()).dot(direction), 1, 1e-12);
    for (double degrees : {-10.0, -1.0, 1.0, 20.0, 45.0})
      EXPECT_GE(p.dot + 1e-12, of_frame(r).dot(of_frame(p.frame * about(Vec3::UnitZ(), degrees))));
  }
}

TEST(SphericalHarmonics, ProjectionIsTheBestOfManyStarts) {
  std::mt19937 random(8);
  std::normal_distribution<double> n;
  for (int k = 0; k < 60; ++k) {
    Sh noise;
    for (double& v : noise) v = n(random);
    const Sh q = of_frame(random_rotation(random)) + 0.03 * (k % 20) * noise;  // from certain to ambiguous
    const double reached = project(q).dot;
    for (int start = 0; start < 30; ++start)
      EXPECT_LE(project_from(q, random_rotation(random)).dot, reached + 1e-8 * q.norm()) << k;
  }
}
