#include "hexfield/base/octahedral.hpp"

#include <gtest/gtest.h>

#include <random>

using namespace hexfield;
using namespace hexfield::octahedral;

TEST(Octahedral, TwentyFourElementsTenAxialFourteenCompound) {
  int quarter = 0;
  for (Rotation r = 0; r < order; ++r) {
    EXPECT_NEAR(matrix(r).determinant(), 1.0, 1e-15);
    for (Rotation s = 0; s < r; ++s) EXPECT_NE(matrix(r), matrix(s));
    quarter += product(r, r) != identity && product(product(r, r), product(r, r)) == identity;
    bool keeps_an_axis = false;
    for (Label a = 0; a < 6; ++a) keeps_an_axis = keeps_an_axis || image(r, a) == a;
    EXPECT_EQ(keeps_an_axis, is_axial(r));
  }
  EXPECT_EQ(quarter, 6);
}

TEST(Octahedral, ProductInverseAndImagesAgreeWithMatrices) {
  for (Rotation a = 0; a < order; ++a) {
    EXPECT_EQ(product(a, inverse(a)), identity);
    for (Rotation b = 0; b < order; ++b) EXPECT_EQ(matrix(product(a, b)), matrix(a) * matrix(b));
    for (Label l = 0; l < 6; ++l) EXPECT_EQ(matrix(a) * direction(l), direction(image(a, l)));
    const Vec3 x(1.5, -2.25, 3.0);
    EXPECT_EQ(apply(a, x), matrix(a) * x);
    EXPECT_LT((quaternion(a).toRotationMatrix() - matrix(a)).norm(), 1e-15);
  }
}

TEST(Octahedral, CoordinatesGoByTheInverseOfTheMatchingOnAllPairs) {
  // Two charts of one map: F_i = F g_i, matching g_i^-1 g_j; coordinates in chart i are g_i^-1 x.
  const Vec3 x(0.3, -1.7, 2.9);
  for (Rotation gi = 0; gi < order; ++gi)
    for (Rotation gj = 0; gj < order; ++gj) {
      const Rotation m = matching(quaternion(gi), quaternion(gj));
      EXPECT_EQ(m, product(inverse(gi), gj));
      EXPECT_EQ(apply(inverse(m), apply(inverse(gi), x)), apply(inverse(gj), x));
      for (Label l = 0; l < 6; ++l)  // one direction in space has the labels image(g^-1, l) in the two charts
        EXPECT_EQ(image(inverse(m), image(inverse(gi), l)), image(inverse(gj), l));
    }
}

TEST(Octahedral, QuarterTurnsAndTheirAxes) {
  for (Label a = 0; a < 6; ++a) {
    const Rotation q = quarter_turn(a);
    EXPECT_EQ(rotation_axis(q), a);
    const Eigen::AngleAxisd expected(M_PI / 2, direction(a));
    EXPECT_LT((matrix(q) - expected.toRotationMatrix()).norm(), 1e-14);
    EXPECT_EQ(inverse(q), quarter_turn(negate(a)));
  }
}

TEST(Octahedral, FactorisationsOfCompoundElementsIntoQuarterTurns) {
  // spec-lmff 5.4: third-turns in exactly three ways; edge-diagonal half-turns in none, but quarter x half in two.
  for (Rotation r = 10; r < order; ++r) {
    int quarters = 0;
    int quarter_half = 0;
    for (Label a = 0; a < 6; ++a) {
      for (Label b = 0; b < 6; ++b) quarters += product(quarter_turn(a), quarter_turn(b)) == r;
      for (Rotation h = 1; h < 4; ++h) quarter_half += product(quarter_turn(a), h) == r;
    }
    EXPECT_EQ(quarters, r >= 16 ? 3 : 0);
    EXPECT_EQ(quarter_half, r >= 16 ? 0 : 2);
  }
}

TEST(Octahedral, ClosestMatchingResidualStaysBelowTheCoveringRadius) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  double worst = 0;
  for (int k = 0; k < 20000; ++k) {
    const Quaternion q = Quaternion(normal(random), normal(random), normal(random), normal(random)).normalized();
    const Quaternion rest = quaternion(closest(q)).conjugate() * q;
    worst = std::max(worst, 2 * std::acos(std::min(1.0, std::abs(rest.w()))) * 180 / M_PI);
  }
  EXPECT_LT(worst, 62.80);
  EXPECT_GT(worst, 55.0);
}
