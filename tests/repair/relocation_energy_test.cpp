#include "hexfield/repair/relocation_energy.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>

#include "hexfield/base/parallel.hpp"

using namespace hexfield;

namespace {

Vec3 random_vector(std::mt19937& random) {
  std::normal_distribution<double> d;
  return {d(random), d(random), d(random)};
}

std::array<Vec3, 4> random_tet(std::mt19937& random) {
  std::array<Vec3, 4> x{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  for (Vec3& p : x) p += 0.15 * random_vector(random);
  return x;
}

// Points around a free one in the middle of an octahedron, all energies on them.
RelocationEnergy octahedron(std::mt19937& random) {
  std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (Vec3& p : points) p += 0.1 * random_vector(random);
  std::vector<RelocationEnergy::Freedom> freedoms(7);
  freedoms[0].dimensions = 3;
  freedoms[1] = {2, Quaternion::UnitRandom().toRotationMatrix()};
  freedoms[3] = {1, Quaternion::UnitRandom().toRotationMatrix()};
  freedoms[5].dimensions = 3;
  RelocationEnergy energy(points, freedoms);
  for (int x : {1, 2})
    for (int y : {3, 4})
      for (int z : {5, 6}) {
        const bool even = (x + y + z) % 2 != 0;
        energy.add_tet(even ? std::array{0, x, y, z} : std::array{0, y, x, z}, 0.7);
      }
  energy.add_triangle({1, 3, 5}, Vec3(1, 1, 1).normalized(), 0.3);
  energy.add_alignment(0, 5, Vec3(1, 2, 3).normalized(), 2);
  energy.add_shrinkage(0, 1, 0.5);
  energy.add_curvature(6, 0, 5, 1.5);
  energy.add_attraction(3, Vec3(0.1, 1.2, 0.3), 0.8);
  return energy;
}

}  // namespace

TEST(RelocationEnergy, ShapesAreLeastForRegularSimplicesAndInfiniteWhenTurnedOver) {
  const std::array<Vec3, 4> tet{Vec3(1, 1, 1), Vec3(-1, 1, -1), Vec3(1, -1, -1), Vec3(-1, -1, 1)};
  EXPECT_NEAR(tet_shape(tet), std::log(3), 1e-12);
  EXPECT_TRUE(std::isinf(tet_shape({tet[1], tet[0], tet[2], tet[3]})));
  const std::array<Vec3, 3> triangle{Vec3(0, 0, 5), Vec3(2, 0, 4), Vec3(1, std::sqrt(3.0), 1)};
  EXPECT_NEAR(triangle_shape(triangle, Vec3::UnitZ()), std::log(2), 1e-12);
  EXPECT_TRUE(std::isinf(triangle_shape(triangle, -Vec3::UnitZ())));
}

TEST(RelocationEnergy, TetDerivativesMatchDifferences) {
  std::mt19937 random(1);
  constexpr double h = 1e-6;
  for (int n = 0; n < 20; ++n) {
    const auto x = random_tet(random);
    if (!std::isfinite(tet_shape(x))) continue;
    const TetShape s = tet_shape_derivatives(x);
    EXPECT_NEAR(s.value, tet_shape(x), 1e-12);
    for (std::size_t c = 0; c < 4; ++c) {
      const CornerShape corner = tet_corner_derivatives(x, static_cast<int>(c));
      EXPECT_NEAR((corner.gradient - s.gradient[c]).norm(), 0, 1e-12 * (1 + s.gradient[c].norm()));
      EXPECT_NEAR((corner.hessian - s.hessian[c][c]).norm(), 0, 1e-12 * (1 + s.hessian[c][c].norm()));
    }
    for (std::size_t c = 0; c < 4; ++c)
      for (int k = 0; k < 3; ++k) {
        auto plus = x, minus = x;
        plus[c][k] += h;
        minus[c][k] -= h;
        const double scale = 1 + s.hessian[c][c].norm();
        EXPECT_NEAR(s.gradient[c][k], (tet_shape(plus) - tet_shape(minus)) / (2 * h), 1e-7 * scale);
        const TetShape p = tet_shape_derivatives(plus), m = tet_shape_derivatives(minus);
        for (std::size_t d = 0; d < 4; ++d)
          EXPECT_NEAR((s.hessian[d][c].col(k) - (p.gradient[d] - m.gradient[d]) / (2 * h)).norm(), 0, 1e-6 * scale);
      }
  }
}

TEST(RelocationEnergy, TriangleDerivativesMatchDifferences) {
  std::mt19937 random(2);
  constexpr double h = 1e-6;
  const Vec3 normal = Vec3(0.2, -0.1, 1).normalized();
  for (int n = 0; n < 20; ++n) {
    const auto tet = random_tet(random);
    const std::array<Vec3, 3> x{tet[0], tet[1], tet[2]};
    if (!std::isfinite(triangle_shape(x, normal))) continue;
    const TriangleShape s = triangle_shape_derivatives(x, normal);
    for (std::size_t c = 0; c < 3; ++c)
      for (int k = 0; k < 3; ++k) {
        auto plus = x, minus = x;
        plus[c][k] += h;
        minus[c][k] -= h;
        const double scale = 1 + s.hessian[c][c].norm();
        EXPECT_NEAR(s.gradient[c][k], (triangle_shape(plus, normal) - triangle_shape(minus, normal)) / (2 * h),
                    1e-7 * scale);
        const TriangleShape p = triangle_shape_derivatives(plus, normal);
        const TriangleShape m = triangle_shape_derivatives(minus, normal);
        for (std::size_t d = 0; d < 3; ++d)
          EXPECT_NEAR((s.hessian[d][c].col(k) - (p.gradient[d] - m.gradient[d]) / (2 * h)).norm(), 0, 1e-6 * scale);
      }
  }
}

TEST(RelocationEnergy, SumMatchesDifferencesAndItsHessianIsSemidefinite) {
  std::mt19937 random(3);
  for (int n = 0; n < 10; ++n) {
    const RelocationEnergy energy = octahedron(random);
    ASSERT_EQ(energy.num_unknowns(), 9);
    Eigen::VectorXd y = 0.05 * Eigen::VectorXd::Random(9);
    Eigen::VectorXd gradient;
    Eigen::SparseMatrix<double> hessian;
    const double value = energy.derivatives(y, gradient, hessian);
    EXPECT_NEAR(value, energy.value(y), 1e-12 * value);
    for (int k = 0; k < 9; ++k) {
      Eigen::VectorXd plus = y, minus = y;
      plus[k] += 1e-6;
      minus[k] -= 1e-6;
      EXPECT_NEAR(gradient[k], (energy.value(plus) - energy.value(minus)) / 2e-6, 1e-6 * (1 + gradient.norm()));
    }
    const Eigen::MatrixXd full = Eigen::MatrixXd(hessian).selfadjointView<Eigen::Lower>();
    EXPECT_GE(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(full).eigenvalues()[0], -1e-10);
  }
}

TEST(RelocationEnergy, ProjectionKeepsSemidefiniteBlocksAndCutsOthers) {
  const Eigen::MatrixXd a = Eigen::MatrixXd::Random(6, 6);
  Eigen::MatrixXd definite = a * a.transpose() + Eigen::MatrixXd::Identity(6, 6);
  const Eigen::MatrixXd before = definite;
  project_to_semidefinite(definite);
  EXPECT_EQ(definite, before);
  Eigen::MatrixXd indefinite = a + a.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(indefinite);
  ASSERT_LT(eigen.eigenvalues()[0], 0);
  project_to_semidefinite(indefinite);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> after(indefinite);
  EXPECT_NEAR((after.eigenvalues() - eigen.eigenvalues().cwiseMax(0.0)).norm(), 0, 1e-10);
}

TEST(RelocationEnergy, DescentFindsTheMinimumAndStaysInTheDomain) {
  std::mt19937 random(4);
  const RelocationEnergy energy = octahedron(random);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(9);
  const NewtonDescent report = descend(energy, y, 100, 1e-14);
  EXPECT_LT(report.end, report.start);
  EXPECT_LT(report.iterations, 50);
  Eigen::VectorXd gradient;
  Eigen::SparseMatrix<double> hessian;
  energy.derivatives(y, gradient, hessian);
  EXPECT_LT(gradient.norm(), 1e-5);
}
