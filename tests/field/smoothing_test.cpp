#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "hexfield/base/parallel.hpp"
#include "hexfield/field/octahedral_smoothing.hpp"
#include "hexfield/field/spherical_harmonics.hpp"
#include "hexfield/field/vertex_field.hpp"
#include "support/meshes.hpp"

using namespace hexfield;

namespace {

int rank_of(MPI_Comm comm) {
  int r = 0;
  MPI_Comm_rank(comm, &r);
  return r;
}

// Half a ball: no features, so the field must be singular inside.
TetMesh rounded_box(int cells) {
  TetMesh mesh = hexfield::testing::kuhn_box(cells, cells, cells);
  for (Vec3& p : mesh.points) {
    const Vec3 x = 2 * p / cells - Vec3::Ones();
    p = x.norm() > 0 ? Vec3(x * (0.5 + 0.5 * x.cwiseAbs().maxCoeff() / x.norm())) : x;
  }
  return mesh;
}

struct Problem {
  RootGraph graph;
  std::vector<NodeConstraint> constraints;
};

Problem problem_of(const TetMesh& mesh) { return {vertex_graph(mesh), vertex_constraints(mesh, {}, 70)}; }

std::vector<Quaternion> smooth(MPI_Comm comm, const Problem& p, const std::vector<Quaternion>* start, double tolerance,
                               SmoothingReport& report) {
  SmoothingOptions options;
  options.tolerance = tolerance;
  return rank_of(comm) == 0 ? smooth_octahedral_field(comm, p.graph, p.constraints, start, options, report, {})
                            : smooth_octahedral_field(comm, {}, {}, start, options, report, {});
}

// Grid of unit weights, the frames of its two ends turned about z by 0 and `radians`.
Problem twisted_bar(int n, int length, double radians) {
  Problem p;
  auto id = [&](int x, int y, int z) { return (x * n + y) * n + z; };
  for (int x = 0; x <= length; ++x)
    for (int y = 0; y < n; ++y)
      for (int z = 0; z < n; ++z) {
        std::vector<std::int32_t> row;
        if (x > 0) row.push_back(id(x - 1, y, z));
        if (y > 0) row.push_back(id(x, y - 1, z));
        if (z > 0) row.push_back(id(x, y, z - 1));
        if (z + 1 < n) row.push_back(id(x, y, z + 1));
        if (y + 1 < n) row.push_back(id(x, y + 1, z));
        if (x < length) row.push_back(id(x + 1, y, z));
        for (std::int32_t j : row) p.graph.neighbours.push_back(j), p.graph.weights.push_back(1);
        p.graph.offsets.push_back(static_cast<std::int64_t>(p.graph.neighbours.size()));
        NodeConstraint c;
        if (x == 0 || x == length) c.kind = NodeConstraint::Kind::fixed;
        if (x == length) c.frame = Quaternion(Eigen::AngleAxisd(radians, Vec3::UnitZ()));
        p.constraints.push_back(c);
      }
  return p;
}

}  // namespace

TEST(OctahedralSmoothing, TwistSpreadsEvenlyOverABar) {
  const int length = 30;
  const double angle = 0.5;
  SmoothingReport report;
  const Problem p = twisted_bar(5, length, angle);
  const auto frames = smooth(MPI_COMM_WORLD, p, nullptr, 1e-14, report);
  EXPECT_TRUE(report.converged);
  if (rank_of(MPI_COMM_WORLD) != 0) return;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const double x = static_cast<double>(i / 25) / length;
    const harmonics::Sh expected = harmonics::of_frame(Quaternion(Eigen::AngleAxisd(x * angle, Vec3::UnitZ())));
    ASSERT_LT((harmonics::of_frame(frames[i]) - expected).norm(), 1e-5) << i;
  }
}

TEST(OctahedralSmoothing, StepsOnlyDecreaseTheEnergyAndEndWhereNoneIsLeft) {
  const Problem p = problem_of(rounded_box(8));
  SmoothingReport first;
  const auto frames = smooth(MPI_COMM_WORLD, p, nullptr, 1e-9, first);
  ASSERT_TRUE(first.converged);
  for (std::size_t k = 1; k < first.energies.size(); ++k) EXPECT_LT(first.energies[k], first.energies[k - 1]);
  EXPECT_LT(first.energies.back(), 0.995 * first.energies.front());
  SmoothingReport again;
  smooth(MPI_COMM_WORLD, p, &frames, 1e-9, again);
  EXPECT_NEAR(again.energies.front(), first.energies.back(), 1e-9 * first.energies.back());
  EXPECT_GT(again.energies.back(), (1 - 1e-5) * first.energies.back());
}

TEST(OctahedralSmoothing, AlignedNodesKeepTheirAxis) {
  const Problem p = problem_of(rounded_box(6));
  SmoothingReport report;
  const auto frames = smooth(MPI_COMM_WORLD, p, nullptr, 1e-4, report);
  int aligned = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (p.constraints[i].kind != NodeConstraint::Kind::aligned) continue;
    ++aligned;
    EXPECT_NEAR((frames[i].conjugate() * p.constraints[i].direction).cwiseAbs().maxCoeff(), 1, 1e-9);
  }
  if (rank_of(MPI_COMM_WORLD) == 0) {
    EXPECT_GT(aligned, 100);
  }
}

TEST(OctahedralSmoothing, SameBytesForAnyNumberOfRanksAndThreads) {
  const Problem p = problem_of(rounded_box(9));
  SmoothingReport alone, together;
  const auto expected = smooth(MPI_COMM_SELF, p, nullptr, 1e-5, alone);
  const int before = threads();
  set_threads(before == 1 ? 3 : 1);
  const auto frames = smooth(MPI_COMM_WORLD, p, nullptr, 1e-5, together);
  set_threads(before);
  EXPECT_EQ(alone.energies, together.energies);
  EXPECT_EQ(alone.linear_iterations, together.linear_iterations);
  if (rank_of(MPI_COMM_WORLD) != 0) return;
  ASSERT_EQ(frames.size(), expected.size());
  for (std::size_t i = 0; i < frames.size(); ++i) ASSERT_EQ(frames[i].coeffs(), expected[i].coeffs()) << i;
}

TEST(OctahedralSmoothing, IterationsOfTheLinearStartHardlyGrowWithTheMesh) {
  SmoothingReport coarse, fine;
  smooth(MPI_COMM_WORLD, problem_of(rounded_box(5)), nullptr, 0.5, coarse);
  smooth(MPI_COMM_WORLD, problem_of(rounded_box(16)), nullptr, 0.5, fine);
  EXPECT_GT(coarse.linear_iterations, 1);
  EXPECT_LE(fine.linear_iterations, 2 * coarse.linear_iterations);
  EXPECT_LE(fine.linear_iterations, 15);
}

TEST(OctahedralSmoothing, AllFixedAndEmptyGraphs) {
  Problem p = twisted_bar(2, 1, 0.3);
  SmoothingReport report;
  const auto frames = smooth(MPI_COMM_WORLD, p, nullptr, 1e-6, report);
  if (rank_of(MPI_COMM_WORLD) == 0) {
    ASSERT_EQ(frames.size(), 8U);
    EXPECT_EQ(frames[7].coeffs(), p.constraints[7].frame.coeffs());
  }
  EXPECT_TRUE(smooth(MPI_COMM_WORLD, {}, nullptr, 1e-6, report).empty());
}
