#include "hexfield/field/align_field.hpp"

#include <gtest/gtest.h>

#include <random>

#include "box_features.hpp"
#include "hexfield/base/parallel.hpp"
#include "hexfield/field/constraints.hpp"
#include "hexfield/field/matchings.hpp"

using namespace hexfield;

namespace {

bool on_root() {
  int r = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &r);
  return r == 0;
}

struct Problem {
  TetMesh mesh = hexfield::testing::kuhn_box(4, 3, 3);
  Features features = hexfield::testing::sharp_features(mesh);
  FrameField field;
  std::vector<AxisConstraint> constraints;
};

// The constant field of a box, disturbed by small random turns and random gauge changes.
Problem disturbed(double radians) {
  Problem p;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-radians, radians);
  for (std::size_t i = 0; i < p.mesh.num_tets(); ++i) {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    p.field.frames.push_back(Quaternion(1, x / 2, y / 2, z / 2).normalized());
  }
  compute_matchings(p.mesh, p.field);
  for (std::size_t i = 0; i < p.mesh.num_tets(); i += 3)
    change_gauge(p.mesh, p.field, TetId(static_cast<std::int64_t>(i)),
                 static_cast<octahedral::Rotation>(random() % 24));
  p.constraints = collect_constraints(p.mesh, p.features, p.field, {});
  return p;
}

double energy(const TetMesh& mesh, const FrameField& field) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.num_tets(); ++i)
    for (int f = 0; f < 4; ++f)
      sum += std::pow(matched_angle(mesh, field, HalfFaceId(TetId(static_cast<std::int64_t>(i)), f)), 2) / 2;
  return sum;
}

AlignReport align_everywhere(Problem& p, int sweeps) {
  const DistributedMesh mesh(MPI_COMM_WORLD, on_root() ? p.mesh : TetMesh());
  AlignOptions options;
  options.sweeps = sweeps;
  return align_field(mesh, p.field, p.constraints, options);
}

}  // namespace

TEST(AlignField, ConstantFieldIsAFixedPoint) {
  Problem p = disturbed(0);
  const FrameField before = p.field;
  const AlignReport report = align_everywhere(p, 5);
  EXPECT_LT(report.largest_turn, 1e-14);
  EXPECT_EQ(report.misaligned, 0);
  if (!on_root()) return;
  for (std::size_t i = 0; i < p.mesh.num_tets(); ++i)
    EXPECT_NEAR(std::abs(before.frames[i].dot(p.field.frames[i])), 1, 1e-14);
}

TEST(AlignField, MeetsConstraintsAndKeepsMatchings) {
  Problem p = disturbed(0.3);
  const auto matchings = p.field.matchings;
  const double before = energy(p.mesh, p.field);
  const AlignReport report = align_everywhere(p, 300);
  EXPECT_EQ(report.misaligned, 0);
  EXPECT_EQ(report.reverted, 0);
  if (!on_root()) return;
  EXPECT_EQ(p.field.matchings, matchings);
  EXPECT_LT(energy(p.mesh, p.field), 1e-6 * before);
  for (const auto& [tet, c] : frame_constraints(p.constraints))
    for (std::size_t k = 0; k < static_cast<std::size_t>(c.count); ++k)
      EXPECT_LT((p.field.frames[tet.index()] * octahedral::direction(c.labels[k]) - c.directions[k]).norm(), 1e-12);
}

TEST(AlignField, SubmeshSweepsReachTheSameEnergyAsJacobi) {
  Problem jacobi = disturbed(0.3);
  Problem gauss_seidel = jacobi;
  align_everywhere(jacobi, 600);
  std::vector<TetId> all;
  for (std::size_t i = 0; i < jacobi.mesh.num_tets(); ++i) all.emplace_back(static_cast<std::int64_t>(i));
  AlignOptions options;
  options.sweeps = 300;
  const auto report = align_submesh(gauss_seidel.mesh, gauss_seidel.field, gauss_seidel.constraints, all, options);
  EXPECT_EQ(report.misaligned, 0);
  if (!on_root()) return;
  EXPECT_NEAR(energy(jacobi.mesh, jacobi.field), energy(gauss_seidel.mesh, gauss_seidel.field), 1e-6);
}

TEST(AlignField, SubmeshLeavesOtherTetsAlone) {
  Problem p = disturbed(0.3);
  const FrameField before = p.field;
  const std::vector<TetId> some{TetId(7), TetId(8), TetId(30)};
  align_submesh(p.mesh, p.field, p.constraints, some, {});
  for (std::size_t i = 0; i < p.mesh.num_tets(); ++i) {
    const bool moved = !(before.frames[i].coeffs() == p.field.frames[i].coeffs());
    EXPECT_EQ(moved, i == 7 || i == 8 || i == 30) << i;
  }
}

TEST(AlignField, SameBytesForAnyNumberOfThreadsAndRanks) {
  const int before = threads();
  std::vector<FrameField> results;
  for (int count : {1, 2, 3}) {
    set_threads(count);
    Problem p = disturbed(0.4);
    align_everywhere(p, 30);
    results.push_back(p.field);
  }
  set_threads(before);
  if (!on_root()) return;
  // What one rank alone computes is the yardstick for all numbers of ranks.
  Problem alone = disturbed(0.4);
  const DistributedMesh mesh(MPI_COMM_SELF, alone.mesh);
  AlignOptions options;
  options.sweeps = 30;
  align_field(mesh, alone.field, alone.constraints, options);
  for (const FrameField& r : results)
    for (std::size_t i = 0; i < r.frames.size(); ++i) EXPECT_EQ(r.frames[i].coeffs(), alone.field.frames[i].coeffs());
}

TEST(AlignField, GuardKeepsMatchedFramesApart) {
  // A turn of nearly 180 degrees between two tets may shrink, but never passes through the half-turn.
  Problem p = disturbed(0);
  for (std::size_t i = 0; i < p.mesh.num_tets() / 2; ++i)
    p.field.frames[i] =
        (Quaternion(Eigen::AngleAxisd(2.9, Vec3(1, 2, 3).normalized())) * p.field.frames[i]).normalized();
  p.constraints.clear();
  align_everywhere(p, 50);
  if (!on_root()) return;
  for (std::size_t i = 0; i < p.mesh.num_tets(); ++i)
    for (int f = 0; f < 4; ++f)
      EXPECT_LT(matched_angle(p.mesh, p.field, HalfFaceId(TetId(static_cast<std::int64_t>(i)), f)), 171 * M_PI / 180);
}
