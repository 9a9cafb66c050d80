#include "hexfield/map/integrable_frames.hpp"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <cmath>

#include "hexfield/base/parallel.hpp"
#include "hexfield/map/alignments.hpp"
#include "hexfield/map/verify.hpp"
#include "hexfield/solve/tet_energy.hpp"
#include "support/meshes.hpp"
#include "support/prism.hpp"

namespace hexfield {
namespace {

int rank_of(MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  return rank;
}

Mat3 jacobian_of(const TetMesh& mesh, const CornerMap& map, std::size_t t) {
  const auto& v = mesh.tets[t];
  const auto d = solve::gradient_operator({mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3])});
  Mat3 j = Mat3::Zero();
  for (std::size_t c = 0; c < 4; ++c) j += map.uvw[t][c] * d.row(static_cast<Eigen::Index>(c));
  return j;
}

// The rotation field, constraints and conforming space of a seamless map.
struct Setting {
  TetMesh mesh;
  CornerMap map;
  EdgeCodes codes;
  FrameField field;
  std::vector<AxisConstraint> constraints;
  ConformingSpace space;
};

Setting setting_of(TetMesh mesh, CornerMap map) {
  Setting s{std::move(mesh), std::move(map), {}, {}, {}, {}};
  s.codes = codes_of_map(s.mesh, s.map);
  s.field.matchings = matchings_of(s.map);
  for (std::size_t t = 0; t < s.mesh.num_tets(); ++t) {
    const Eigen::JacobiSVD<Mat3> svd(jacobian_of(s.mesh, s.map, t), Eigen::ComputeFullU | Eigen::ComputeFullV);
    s.field.frames.emplace_back(Mat3(svd.matrixV() * svd.matrixU().transpose()));
  }
  const Alignments alignments = alignments_of_map(s.mesh, {}, s.codes, s.map);
  auto add = [&](TetId t, int axis, const Vec3& d, AxisConstraint::Kind kind) {
    const bool negative = s.field.frames[t.index()].toRotationMatrix().col(axis).dot(d) < 0;
    s.constraints.push_back({t, static_cast<octahedral::Label>(2 * axis + (negative ? 1 : 0)), d, kind, {}, {}});
  };
  for (const FaceAlignment& f : alignments.faces)
    add(f.face.tet(), f.axis, outward_normal(s.mesh, f.face), AxisConstraint::Kind::feature_face);
  for (const EdgeAlignment& e : alignments.edges)
    add(e.tet, e.axis, (s.mesh.point(e.edge[1]) - s.mesh.point(e.edge[0])).normalized(),
        AxisConstraint::Kind::singular_edge);
  s.space = conforming_space(s.mesh, cut_graph(s.mesh, s.field.matchings, singular_edges(s.codes)), alignments);
  return s;
}

Setting prism() {
  auto p = testing::three_quad_prism(2, 2);
  return setting_of(std::move(p.mesh), std::move(p.map));
}

// The values live on rank 0 of `comm`; others pass empty ones.
const Setting& on_root(MPI_Comm comm, const Setting& s) {
  static const Setting nothing;
  return rank_of(comm) == 0 ? s : nothing;
}

std::vector<Mat3> optimise(MPI_Comm comm, const Setting& s, std::vector<IntegrableStageReport>& reports) {
  IntegrableOptions options;
  options.decrease_tolerance = 1e-9;
  options.last_decrease_tolerance = 1e-13;
  options.linear_tolerance = 1e-3;
  const Setting& r = on_root(comm, s);
  IntegrableFrames frames(comm, r.mesh, r.field, r.constraints, r.space, options);
  reports = optimise_integrable_frames(frames, comm, options, {}, {});
  return frames.gather();
}

// Map of the conforming space whose Jacobians are closest to the frames.
CornerMap fit(const Setting& s, const std::vector<Mat3>& frames) {
  solve::TetEnergy energy(solve::TetEnergy::Kind::frame_fit);
  for (std::size_t t = 0; t < frames.size(); ++t) {
    const auto& v = s.mesh.tets[t];
    std::array<solve::AffineScalar, 12> corners;
    for (std::size_t c = 0; c < 4; ++c)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t x = 3 * static_cast<std::size_t>(s.space.cut.classes[t][c]) + k;
        for (std::size_t e = s.space.row_start[x]; e < s.space.row_start[x + 1]; ++e)
          corners[3 * c + k].entries.push_back(
              {static_cast<PetscInt>(s.space.columns[e]), static_cast<double>(s.space.coefficients[e])});
      }
    const Mat3 combed = octahedral::matrix(s.space.cut.gauges[t]).transpose() * frames[t];
    energy.add(
        solve::gradient_operator({s.mesh.point(v[0]), s.mesh.point(v[1]), s.mesh.point(v[2]), s.mesh.point(v[3])}), 1.0,
        corners, combed.inverse());
  }
  Vec y = nullptr;
  VecCreateSeq(PETSC_COMM_SELF, static_cast<PetscInt>(s.space.num_unknowns()), &y);
  VecSet(y, 0.0);
  const solve::EnergyTerm* terms[] = {&energy};
  solve::solve_linear(MPI_COMM_SELF, terms, y, solve::Preconditioner::cholesky);
  const double* data = nullptr;
  VecGetArrayRead(y, &data);
  const std::vector<double> values(data, data + s.space.num_unknowns());
  VecRestoreArrayRead(y, &data);
  VecDestroy(&y);
  return to_corner_map(s.space, coordinates(s.space, values));
}

TEST(IntegrableFrames, TheStartIsARestStateForAnAffineMapInAnyGauge) {
  TetMesh mesh = testing::kuhn_box(3, 2, 2);
  CornerMap map;
  map.rotations.assign(mesh.num_tets(), {0, 0, 0, 0});
  std::vector<octahedral::Rotation> gauge(mesh.num_tets());
  for (std::size_t t = 0; t < mesh.num_tets(); ++t) {
    gauge[t] = static_cast<octahedral::Rotation>((7 * t) % octahedral::order);
    auto& corners = map.uvw.emplace_back();
    for (std::size_t c = 0; c < 4; ++c) corners[c] = octahedral::apply(gauge[t], mesh.point(mesh.tets[t][c]));
  }
  for (std::size_t i = 0; i < 4 * mesh.num_tets(); ++i) {
    const HalfFaceId h(static_cast<std::int64_t>(i));
    if (mesh.is_boundary(h)) continue;
    const auto other = gauge[mesh.opposite_half_face(h).tet().index()];
    map.rotations[i / 4][i % 4] = octahedral::product(other, octahedral::inverse(gauge[i / 4]));
  }
  const Setting s = setting_of(std::move(mesh), std::move(map));
  const Setting& r = on_root(MPI_COMM_WORLD, s);
  const IntegrableOptions options;
  IntegrableFrames frames(MPI_COMM_WORLD, r.mesh, r.field, r.constraints, r.space, options);
  const auto report = frames.run({1e2, 1e6}, 1e-6, {});
  EXPECT_NEAR(report.distortion, 0.0, 1e-12);
  EXPECT_LT(report.smoothness, 1e-24);
  EXPECT_LT(report.max_curl, 1e-12);
}

TEST(IntegrableFrames, TheFramesOfASeamlessMapAreIntegrable) {
  const Setting s = prism();
  const Setting& r = on_root(MPI_COMM_WORLD, s);
  IntegrableOptions options;
  options.max_newton_steps = 0;
  IntegrableFrames frames(MPI_COMM_WORLD, r.mesh, r.field, r.constraints, r.space, options);
  std::vector<Mat3> exact;
  for (std::size_t t = 0; t < r.mesh.num_tets(); ++t) exact.push_back(jacobian_of(r.mesh, r.map, t));
  frames.set(exact);
  const auto report = frames.run({0, 1}, 1e-6, {});
  EXPECT_LT(report.integrability, 1e-24);
  EXPECT_LT(report.max_curl, 1e-12);
  const auto back = frames.gather();
  for (std::size_t t = 0; t < back.size(); ++t) EXPECT_LT((back[t] - exact[t]).norm(), 1e-12 * exact[t].norm());
  if (rank_of(MPI_COMM_WORLD) != 0) return;
  // The conforming fit reproduces the map up to a translation.
  const CornerMap map = fit(s, exact);
  for (std::size_t t = 0; t < exact.size(); ++t)
    EXPECT_LT((octahedral::matrix(s.space.cut.gauges[t]) * jacobian_of(s.mesh, map, t) - exact[t]).norm(), 1e-9);
}

TEST(IntegrableFrames, RotationsOfAPrismWithASingularArcBecomeASeamlessMap) {
  const Setting s = prism();
  int arc_edges = 0;
  for (const auto& [edge, code] : s.codes)
    if (s.mesh.point(edge[0]).head(2).norm() + s.mesh.point(edge[1]).head(2).norm() < 1e-9) arc_edges += code == -1;
  ASSERT_EQ(arc_edges, 2);
  std::vector<IntegrableStageReport> reports;
  const auto frames = optimise(MPI_COMM_WORLD, s, reports);
  ASSERT_EQ(reports.size(), 6u);
  EXPECT_GT(reports[0].max_curl, 1e-3);
  EXPECT_LT(reports[5].max_curl, 1e-5);
  if (rank_of(MPI_COMM_WORLD) != 0) return;
  for (const AxisConstraint& c : s.constraints) {
    const Mat3& j = frames[c.tet.index()];
    const int axis = octahedral::axis(c.label);
    if (c.kind == AxisConstraint::Kind::feature_face)
      EXPECT_LT(j.row(axis).cross(c.direction).norm(), 1e-12);
    else
      for (int k = 0; k < 3; ++k) EXPECT_LT(k == axis ? 0.0 : std::abs(j.row(k).dot(c.direction)), 1e-12);
  }
  const CornerMap map = fit(s, frames);
  EXPECT_TRUE(verify_map(s.mesh, {}, s.codes, map).valid());
}

TEST(IntegrableFrames, SameResultForAnyNumberOfRanksAndThreads) {
  const Setting s = prism();
  std::vector<IntegrableStageReport> reports;
  const int before = threads();
  set_threads(1);
  const auto together = optimise(MPI_COMM_WORLD, s, reports);
  set_threads(3);
  const auto threaded = optimise(MPI_COMM_WORLD, s, reports);
  set_threads(before);
  EXPECT_EQ(together, threaded);
  const auto alone = optimise(MPI_COMM_SELF, s, reports);
  if (rank_of(MPI_COMM_WORLD) != 0) return;
  for (std::size_t t = 0; t < alone.size(); ++t) EXPECT_LT((alone[t] - together[t]).norm(), 1e-8);
}

TEST(IntegrableFrames, AnInterruptedScheduleIsResumed) {
  const Setting s = prism();
  const Setting& r = on_root(MPI_COMM_WORLD, s);
  const IntegrableOptions options;
  std::vector<double> saved;
  Control control;
  int offers = 0;
  control.stop_requested = [&] { return offers > 0; };
  control.offer_iterate = [&](const std::string&, const std::function<std::vector<double>()>& gather) {
    saved = gather();
    ++offers;
  };
  control.restore_iterate = [&](const std::string&) -> std::optional<std::vector<double>> {
    if (offers == 0) return std::nullopt;
    return saved;
  };
  IntegrableFrames first(MPI_COMM_WORLD, r.mesh, r.field, r.constraints, r.space, options);
  EXPECT_THROW(optimise_integrable_frames(first, MPI_COMM_WORLD, options, control, {}), Error);
  control.stop_requested = nullptr;
  IntegrableFrames second(MPI_COMM_WORLD, r.mesh, r.field, r.constraints, r.space, options);
  const auto reports = optimise_integrable_frames(second, MPI_COMM_WORLD, options, control, {});
  EXPECT_LT(reports.size(), 6u);
  EXPECT_LT(reports.back().max_curl, 1e-4);
}

TEST(IntegrableFrames, AStopIsHeardInTheLinearSolver) {
  const Setting s = prism();
  const Setting& r = on_root(MPI_COMM_WORLD, s);
  int asked = 0;
  Control control;
  control.stop_requested = [&] { return ++asked >= 2; };
  IntegrableFrames frames(MPI_COMM_WORLD, r.mesh, r.field, r.constraints, r.space, {});
  const std::vector<Mat3> before = frames.gather();
  const IntegrableStageReport report = frames.run({1e4, 1e4}, 1e-3, control);
  EXPECT_TRUE(report.stopped);
  EXPECT_EQ(asked, 2);
  EXPECT_EQ(report.newton_steps, 0);
  EXPECT_EQ(frames.gather(), before);
}

TEST(IntegrableFrames, TheWorkEndsTheSchedule) {
  const Setting s = prism();
  const Setting& r = on_root(MPI_COMM_WORLD, s);
  IntegrableOptions options;
  options.max_work = 30;
  IntegrableFrames frames(MPI_COMM_WORLD, r.mesh, r.field, r.constraints, r.space, options);
  int judged = 0;
  const auto reports = optimise_integrable_frames(frames, MPI_COMM_WORLD, options, {},
                                                  [&](std::size_t, IntegrableFrames&, const IntegrableStageReport&) {
                                                    ++judged;
                                                    return false;
                                                  });
  EXPECT_EQ(reports.size(), static_cast<std::size_t>(judged));
  EXPECT_TRUE(reports.back().exhausted);
  EXPECT_LT(reports.size(), options.schedule.size());
  // A step that was begun is ended.
  EXPECT_LT(frames.work(), options.max_work + 2 * options.max_linear_iterations + 10);
}

}  // namespace
}  // namespace hexfield
