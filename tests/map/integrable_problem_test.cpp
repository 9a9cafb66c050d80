#include "../../src/map/integrable_problem.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "support/meshes.hpp"

namespace hexfield::integrable {
namespace {

// A small box with frames that turn from tet to tet and the features of a box. One rank holds it all.
struct Small {
  TetMesh mesh = testing::kuhn_box(2, 1, 1);
  FrameField field;
  std::vector<AxisConstraint> constraints;
  DistributedMesh distributed{MPI_COMM_SELF, mesh};

  Small() {
    for (std::size_t t = 0; t < mesh.num_tets(); ++t) {
      const auto s = static_cast<double>(t);
      const Vec3 axis = Vec3(std::sin(s), std::cos(2 * s), 0.3).normalized();
      field.frames.emplace_back(Eigen::AngleAxisd(0.2 * std::sin(3 * s), axis));
    }
    field.matchings.assign(mesh.num_tets(), {0, 0, 0, 0});
    for (std::size_t i = 0; i < 4 * mesh.num_tets(); ++i) {
      const HalfFaceId h(static_cast<std::int64_t>(i));
      if (!mesh.is_boundary(h)) continue;
      const Vec3 n = outward_normal(mesh, h);
      int axis = 0;
      n.cwiseAbs().maxCoeff(&axis);
      const auto label = static_cast<octahedral::Label>(2 * axis + (n[axis] < 0 ? 1 : 0));
      constraints.push_back({h.tet(), label, n, AxisConstraint::Kind::feature_face, h, {}});
    }
  }
};

Eigen::MatrixXd dense_hessian(Problem& problem) {
  const auto n = static_cast<Eigen::Index>(problem.size());
  Eigen::MatrixXd h(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::VectorXd x = Eigen::VectorXd::Unit(n, i);
    problem.multiply({x.data(), problem.size()}, {h.col(i).data(), problem.size()});
  }
  return h;
}

TEST(IntegrableProblem, GradientMatchesDifferencesOfTheEnergy) {
  Small small;
  Problem problem(small.distributed, small.field, {}, true);
  const IntegrableStage stage{3, 50};
  std::vector<double> frames = problem.start();
  for (std::size_t i = 0; i < frames.size(); ++i) frames[i] += 0.05 * std::sin(static_cast<double>(i));
  problem.refresh_scales(problem.start());
  problem.set_stage(stage);
  std::vector<double> gradient(frames.size());
  problem.linearise(frames, gradient);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    std::vector<double> plus = frames, minus = frames;
    plus[i] += 1e-6;
    minus[i] -= 1e-6;
    const double difference = (problem.energies(plus).total(stage) - problem.energies(minus).total(stage)) / 2e-6;
    EXPECT_NEAR(gradient[i], difference, 1e-6 * (1 + std::abs(difference)));
  }
}

TEST(IntegrableProblem, HessianProductIsSymmetricAndHasItsBlocks) {
  Small small;
  Problem problem(small.distributed, small.field, {}, true);
  problem.set_stage({3, 50});
  std::vector<double> gradient(problem.size());
  problem.linearise(problem.start(), gradient);
  const Eigen::MatrixXd h = dense_hessian(problem);
  EXPECT_LT((h - h.transpose()).norm(), 1e-12 * h.norm());
  for (std::size_t t = 0; t < small.mesh.num_tets(); ++t) {
    const auto i = static_cast<Eigen::Index>(9 * t);
    EXPECT_LT((h.block<9, 9>(i, i) - problem.block(t)).norm(), 1e-12 * h.norm());
  }
}

// Spec-lmff section 12, fact 23: the step in the projected space is that of the system with multipliers.
TEST(IntegrableProblem, LocalEliminationEqualsTheConstrainedNewtonStep) {
  Small small;
  Problem free(small.distributed, small.field, {}, true);
  Problem constrained(small.distributed, small.field, small.constraints, true);
  const std::vector<double> frames = constrained.start();
  const auto n = static_cast<Eigen::Index>(free.size());
  Eigen::VectorXd g(n), projected(n);
  for (Problem* p : {&free, &constrained}) {
    p->set_stage({3, 50});
    Eigen::VectorXd& target = p == &free ? g : projected;
    p->linearise(frames, {target.data(), p->size()});
  }
  const Eigen::MatrixXd h = dense_hessian(free);
  // Rows of A: an orthonormal basis of what each projector removes.
  std::vector<Eigen::VectorXd> rows;
  for (std::size_t t = 0; t < small.mesh.num_tets(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::SelfAdjointEigenSolver<Mat3> eigen(Mat3::Identity() - constrained.projectors(t)[k]);
      for (int i = 0; i < 3; ++i) {
        if (eigen.eigenvalues()[i] < 0.5) continue;
        Eigen::VectorXd row = Eigen::VectorXd::Zero(n);
        row.segment<3>(static_cast<Eigen::Index>(9 * t + 3 * k)) = eigen.eigenvectors().col(i);
        rows.push_back(row);
      }
    }
  const auto m = static_cast<Eigen::Index>(rows.size());
  ASSERT_GT(m, 20);
  Eigen::MatrixXd kkt = Eigen::MatrixXd::Zero(n + m, n + m);
  kkt.topLeftCorner(n, n) = h;
  for (Eigen::Index i = 0; i < m; ++i)
    kkt.row(n + i).head(n) = kkt.col(n + i).head(n) = rows[static_cast<std::size_t>(i)];
  Eigen::VectorXd rhs = Eigen::VectorXd::Zero(n + m);
  rhs.head(n) = -g;
  const Eigen::VectorXd expected = kkt.fullPivLu().solve(rhs).head(n);

  // The same by P H P on the constrained space, where the identity completes it.
  Eigen::MatrixXd reduced(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    Eigen::VectorXd x = Eigen::VectorXd::Unit(n, i);
    const Eigen::VectorXd whole = x;
    constrained.project({x.data(), constrained.size()});
    constrained.multiply({x.data(), constrained.size()}, {reduced.col(i).data(), constrained.size()});
    reduced.col(i) += whole - x;
  }
  const Eigen::VectorXd step = reduced.fullPivLu().solve(-projected);
  EXPECT_LT((step - expected).norm(), 1e-9 * expected.norm());
}

TEST(IntegrableProblem, NoTetInvertsBeforeItsStepLimit) {
  Small small;
  Problem problem(small.distributed, small.field, small.constraints, true);
  std::vector<double> direction(problem.size());
  for (std::size_t i = 0; i < direction.size(); ++i) direction[i] = std::sin(1.7 * static_cast<double>(i));
  problem.project(direction);
  const auto limits = problem.step_limits(problem.start(), direction);
  for (std::size_t t = 0; t < limits.size(); ++t) {
    const Jacobians j(problem.start().data() + 9 * t), d(direction.data() + 9 * t);
    for (double part : {0.2, 0.5, 0.9, 0.999})
      EXPECT_GT(Mat3(j + part * std::min(limits[t], 100.0) * d).determinant(), 0);
  }
}

}  // namespace
}  // namespace hexfield::integrable
