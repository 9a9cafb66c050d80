#include "hexfield/map/compute_map.hpp"

#include <gtest/gtest.h>

#include <Eigen/SVD>

#include "hexfield/map/verify.hpp"
#include "support/maps.hpp"

using namespace hexfield;
using hexfield::testing::mapped_box;
using hexfield::testing::MappedMesh;
using hexfield::testing::valence_prism;

namespace {

int rank(MPI_Comm comm = MPI_COMM_WORLD) {
  int r = 0;
  MPI_Comm_rank(comm, &r);
  return r;
}

// The field of a map: rotations closest to the inverses of its Jacobians, matchings of its transitions.
FrameField field_of(const MappedMesh& m) {
  FrameField field;
  field.matchings = m.map.rotations;
  for (auto& faces : field.matchings)
    for (auto& r : faces) r = octahedral::inverse(r);
  for (std::size_t i = 0; i < m.mesh.num_tets(); ++i) {
    Mat3 domain, image;
    for (std::size_t k = 0; k < 3; ++k) {
      domain.col(static_cast<Eigen::Index>(k)) = m.mesh.point(m.mesh.tets[i][k + 1]) - m.mesh.point(m.mesh.tets[i][0]);
      image.col(static_cast<Eigen::Index>(k)) = m.map.uvw[i][k + 1] - m.map.uvw[i][0];
    }
    const Eigen::JacobiSVD<Mat3> svd(domain * image.inverse(), Eigen::ComputeFullU | Eigen::ComputeFullV);
    field.frames.emplace_back(Mat3(svd.matrixU() * svd.matrixV().transpose()));
  }
  return field;
}

struct Outcome {
  SeamlessResult seamless;
  IgmResult igm;
};

// Inputs are only given on rank 0, as the contract says.
Outcome run(const MappedMesh& m, const Control& control, double hexes, MPI_Comm comm = MPI_COMM_WORLD) {
  const MappedMesh input = rank(comm) == 0 ? m : MappedMesh();
  const FrameField field = rank(comm) == 0 ? field_of(m) : FrameField();
  Outcome outcome;
  SeamlessOptions seamless;
  seamless.target_hexes = hexes;
  outcome.seamless = compute_seamless_map(comm, input.mesh, input.features, field, input.codes, seamless, control);
  if (!outcome.seamless.report.valid()) return outcome;
  IgmOptions igm;
  igm.target_hexes = hexes;
  outcome.igm =
      compute_integer_grid_map(comm, input.mesh, input.features, input.codes, outcome.seamless.map, igm, control);
  return outcome;
}

void expect_integer_grid(const MappedMesh& m, const Outcome& outcome, double hexes) {
  ASSERT_TRUE(outcome.seamless.report.valid());
  ASSERT_TRUE(outcome.igm.report.valid()) << outcome.igm.reason;
  EXPECT_TRUE(outcome.igm.quantization_valid);
  EXPECT_EQ(outcome.igm.reason, "");
  if (rank() != 0) return;
  EXPECT_EQ(verify_map(m.mesh, m.features, m.codes, outcome.seamless.map).max_residual, 0);
  EXPECT_TRUE(check_integer_grid(m.mesh, m.features, m.codes, outcome.igm.map).empty());
  EXPECT_NEAR(parametric_volume(outcome.igm.map), hexes, 1e-9);
}

}  // namespace

// Fact 24: with the frames of an affine map the conforming fit is that map.
TEST(SeamlessMap, OfAnAffineMapIsThatMap) {
  const MappedMesh m = mapped_box(2, 3, 2);
  const Outcome outcome = run(m, {}, 96);
  ASSERT_TRUE(outcome.seamless.report.valid());
  if (rank() != 0) return;
  const CornerMap& map = outcome.seamless.map;
  for (std::size_t i = 0; i < m.mesh.num_tets(); ++i)
    for (std::size_t k = 1; k < 4; ++k) {
      const Vec3 want = 2 * (m.mesh.point(m.mesh.tets[i][k]) - m.mesh.point(m.mesh.tets[i][0]));
      EXPECT_LT((map.uvw[i][k] - map.uvw[i][0] - want).norm(), 1e-8);
    }
}

TEST(IntegerGridMap, OfABoxHasTheWantedCells) {
  const MappedMesh m = mapped_box(2, 2, 2);
  expect_integer_grid(m, run(m, {}, 64), 64);
  expect_integer_grid(m, run(m, {}, 70), 64);
}

// Row "triangular prism": the smallest legal map has one cell per sector and layer.
TEST(IntegerGridMap, OfPrismsWithAnArcInside) {
  const MappedMesh three = valence_prism(3, 2, 2);
  expect_integer_grid(three, run(three, {}, 24), 24);
  const MappedMesh five = valence_prism(5, 2, 2);
  expect_integer_grid(five, run(five, {}, 40), 40);
}

TEST(IntegerGridMap, KeepsArcsApartFromSidesAtATinyTarget) {
  const MappedMesh m = valence_prism(3, 2, 2);
  const Outcome outcome = run(m, {}, 0.5);
  expect_integer_grid(m, outcome, 3);
}

TEST(IntegerGridMap, DoesNotDependOnTheCharts) {
  MappedMesh m = valence_prism(3, 2, 2);
  const Outcome plain = run(m, {}, 50);
  hexfield::testing::change_charts(m, 21);
  const Outcome changed = run(m, {}, 50);
  ASSERT_TRUE(plain.igm.report.valid());
  ASSERT_TRUE(changed.igm.report.valid());
  if (rank() != 0) return;
  EXPECT_EQ(std::lround(parametric_volume(plain.igm.map)), std::lround(parametric_volume(changed.igm.map)));
}

TEST(MapStages, StopAfterAStepWhenAsked) {
  const MappedMesh m = valence_prism(3, 2, 2);
  Control control;
  int offers = 0;
  control.offer_iterate = [&](const std::string&, const std::function<std::vector<double>()>& gather) {
    ++offers;
    const std::vector<double> iterate = gather();
    if (rank() == 0)
      EXPECT_GT(iterate.size(), 0u);
    else
      EXPECT_EQ(iterate.size(), 0u);
  };
  control.stop_requested = [&] { return offers >= 2; };
  try {
    run(m, control, 50);
    FAIL() << "The run did not stop.";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::stopped);
  }
  EXPECT_EQ(offers, 2);
}

// A run that was stopped anywhere and goes on from its last iterate ends at the map of an undisturbed run.
TEST(MapStages, GoOnFromAnIterate) {
  const MappedMesh m = valence_prism(5, 2, 2);
  const Outcome undisturbed = run(m, {}, 100);
  for (int limit : {1, 3, 6}) {
    std::map<std::string, std::vector<double>> saved;
    int offers = 0;
    Control control;
    control.offer_iterate = [&](const std::string& name, const std::function<std::vector<double>()>& gather) {
      saved[name] = gather();
      ++offers;
    };
    control.stop_requested = [&] { return offers >= limit; };
    bool stopped = false;
    try {
      run(m, control, 100);
    } catch (const Error& error) {
      stopped = error.code() == ExitCode::stopped;
    }
    EXPECT_TRUE(stopped);
    control.stop_requested = nullptr;
    control.restore_iterate = [&](const std::string& name) -> std::optional<std::vector<double>> {
      const auto found = saved.find(name);
      if (found == saved.end()) return std::nullopt;
      return found->second;
    };
    const Outcome resumed = run(m, control, 100);
    EXPECT_TRUE(resumed.igm.report.valid());
    ASSERT_EQ(resumed.igm.map.uvw.size(), undisturbed.igm.map.uvw.size());
    EXPECT_EQ(resumed.igm.map.uvw, undisturbed.igm.map.uvw);
  }
}

TEST(MapStages, SameBytesForAnyNumberOfRanks) {
  for (int valence : {3, 5}) {
    const MappedMesh m = valence_prism(valence, 3, 2);
    const Outcome together = run(m, {}, 200);
    const Outcome alone = run(m, {}, 200, MPI_COMM_SELF);
    ASSERT_TRUE(alone.igm.report.valid());
    if (rank() != 0) continue;
    EXPECT_EQ(together.seamless.map.uvw, alone.seamless.map.uvw);
    EXPECT_EQ(together.igm.map.uvw, alone.igm.map.uvw);
  }
}
