#include "../../src/map/untangle.hpp"

#include <gtest/gtest.h>

#include <random>

#include "hexfield/field/constraints.hpp"
#include "hexfield/map/verify.hpp"
#include "support/maps.hpp"

using namespace hexfield;
using hexfield::testing::mapped_box;
using hexfield::testing::MappedMesh;

namespace {

int rank() {
  int r = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &r);
  return r;
}

// A box with its map; everything is on rank 0 only.
struct Box {
  MappedMesh m;
  ConformingSpace space;
  MapProblem problem;

  static MappedMesh make() { return rank() == 0 ? mapped_box(4, 3, 3) : MappedMesh(); }
  static ConformingSpace space_of(const MappedMesh& m) {
    if (rank() != 0) return {};
    return conforming_space(m.mesh, cut_graph(m.mesh, matchings_of(m.map), singular_edges(m.codes)),
                            alignments_of_map(m.mesh, m.features, m.codes, m.map));
  }
  Box() : m(make()), space(space_of(m)), problem(MPI_COMM_WORLD, m.mesh, space) {}

  std::size_t inverted(const std::vector<double>& y) const {
    std::size_t n = 0;
    if (rank() == 0)
      n = verify_map(m.mesh, m.features, m.codes, to_corner_map(space, coordinates(space, y))).inverted.size();
    MPI_Bcast(&n, 1, MPI_UNSIGNED_LONG, 0, MPI_COMM_WORLD);
    return n;
  }
  // The map itself, its free coordinates shaken by up to `amount`.
  std::vector<double> shaken(double amount) const {
    if (rank() != 0) return {};
    std::vector<double> y = unknowns_of(m.mesh, space, m.map);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-amount, amount);
    for (std::size_t i = 0; i < space.num_reals; ++i) y[i] += uniform(random);
    return y;
  }
};

}  // namespace

TEST(Untangle, MakesShakenMapsPositiveAndLeavesPositiveOnesAlone) {
  const Box box;
  const Control silent;
  SolveMonitor monitor(silent, "test");
  const std::vector<double> start = box.shaken(1.5);
  ASSERT_GT(box.inverted(start), 20u);
  const std::vector<double> end = untangle(box.problem, start, {}, 1, 30, monitor);
  EXPECT_EQ(box.inverted(end), 0u);
  EXPECT_EQ(untangle(box.problem, end, {}, 1, 30, monitor), end);
}

TEST(MakePositive, RightsTetsWhereTheFramesAreFarFromIntegrable) {
  const Box box;
  const Control silent;
  SolveMonitor monitor(silent, "test");
  // Frames turned by up to 75 degrees one way and the other about z: the true map still has positive symmetric parts.
  std::vector<Mat3> frames;
  std::mt19937 random(6);
  std::uniform_real_distribution<double> angle(-75 * M_PI / 180, 75 * M_PI / 180);
  if (rank() == 0)
    for (std::size_t t = 0; t < box.m.mesh.num_tets(); ++t)
      frames.push_back(Eigen::AngleAxisd(angle(random), Vec3::UnitZ()).toRotationMatrix());
  const std::vector<double> start = box.shaken(1.5);
  ASSERT_GT(box.inverted(start), 20u);
  int asked = 0;
  const auto done = [&](const std::vector<double>& y) {
    ++asked;
    return box.inverted(y) == 0;
  };
  const std::vector<double> end = make_positive(box.problem, start, {}, frames, monitor, done);
  EXPECT_EQ(box.inverted(end), 0u);
  EXPECT_GE(asked, 1);
}

// Integers that are fixed stay, to the bit.
TEST(MakePositive, KeepsFixedIntegers) {
  const Box box;
  const Control silent;
  SolveMonitor monitor(silent, "test");
  std::vector<double> start = box.shaken(1.5);
  std::vector<double> fixed;
  std::vector<Mat3> frames;
  if (rank() == 0) {
    const auto reals = static_cast<std::ptrdiff_t>(box.space.num_reals);
    // The longest coordinate grows, and the steps of the frames with it.
    for (auto i = start.begin() + reals; i != start.end(); ++i) *i *= 2;
    fixed.assign(start.begin() + reals, start.end());
    frames.assign(box.m.mesh.num_tets(), 0.5 * Mat3::Identity());
  }
  int size = static_cast<int>(fixed.size());
  MPI_Bcast(&size, 1, MPI_INT, 0, MPI_COMM_WORLD);
  fixed.resize(static_cast<std::size_t>(size));
  MPI_Bcast(fixed.data(), size, MPI_DOUBLE, 0, MPI_COMM_WORLD);
  ASSERT_GT(box.inverted(start), 0u);
  const auto done = [&](const std::vector<double>& y) { return box.inverted(y) == 0; };
  const std::vector<double> end = make_positive(box.problem, start, fixed, frames, monitor, done);
  EXPECT_EQ(box.inverted(end), 0u);
  if (rank() == 0) {
    EXPECT_TRUE(std::equal(fixed.begin(), fixed.end(), end.begin() + static_cast<std::ptrdiff_t>(box.space.num_reals)));
  }
}
