#include "hexfield/solve/minimise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "hexfield/base/error.hpp"
#include "hexfield/base/parallel.hpp"
#include "hexfield/solve/tet_energy.hpp"
#include "support/meshes.hpp"

namespace hexfield::solve {
namespace {

using Corners = std::array<AffineScalar, 12>;

int rank(MPI_Comm comm = MPI_COMM_WORLD) {
  int r = 0;
  MPI_Comm_rank(comm, &r);
  return r;
}
int size(MPI_Comm comm = MPI_COMM_WORLD) {
  int s = 1;
  MPI_Comm_size(comm, &s);
  return s;
}

// Distributed vector whose entries are start(i); owned contiguously.
Vec make_vector(PetscInt n, const std::function<double(PetscInt)>& start, MPI_Comm comm = MPI_COMM_WORLD) {
  Vec y = nullptr;
  VecCreate(comm, &y);
  VecSetBlockSize(y, 3);
  VecSetSizes(y, PETSC_DECIDE, n);
  VecSetType(y, VECMPI);
  PetscInt begin = 0;
  PetscInt end = 0;
  VecGetOwnershipRange(y, &begin, &end);
  for (PetscInt i = begin; i < end; ++i) VecSetValue(y, i, start(i), INSERT_VALUES);
  VecAssemblyBegin(y);
  VecAssemblyEnd(y);
  return y;
}

std::vector<double> gather(Vec y) {
  VecScatter scatter = nullptr;
  Vec all = nullptr;
  VecScatterCreateToAll(y, &scatter, &all);
  VecScatterBegin(scatter, y, all, INSERT_VALUES, SCATTER_FORWARD);
  VecScatterEnd(scatter, y, all, INSERT_VALUES, SCATTER_FORWARD);
  PetscInt n = 0;
  VecGetSize(all, &n);
  const double* data = nullptr;
  VecGetArrayRead(all, &data);
  std::vector<double> values(data, data + n);
  VecRestoreArrayRead(all, &data);
  VecScatterDestroy(&scatter);
  VecDestroy(&all);
  return values;
}

// Vertex coordinates are unknowns 3 v + k; tets are dealt out in blocks of ranks.
Corners vertex_corners(const std::array<VertexId, 4>& tet) {
  Corners corners;
  for (std::size_t c = 0; c < 4; ++c)
    for (std::size_t k = 0; k < 3; ++k)
      corners[3 * c + k].entries = {{static_cast<PetscInt>(3 * tet[c].value + static_cast<int>(k)), 1.0}};
  return corners;
}

TetEnergy mesh_energy(const TetMesh& mesh, TetEnergy::Kind kind, const Mat3& frame = Mat3::Identity(),
                      MPI_Comm comm = MPI_COMM_WORLD) {
  TetEnergy energy(kind);
  const std::size_t n = mesh.num_tets();
  const auto p = static_cast<std::size_t>(size(comm));
  const auto r = static_cast<std::size_t>(rank(comm));
  for (std::size_t t = n * r / p; t < n * (r + 1) / p; ++t) {
    const auto& v = mesh.tets[t];
    const auto d = gradient_operator({mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3])});
    energy.add(d, 1.0 + 0.1 * static_cast<double>(t % 3), vertex_corners(v), frame);
  }
  return energy;
}

double wobble(PetscInt i) { return 0.12 * std::sin(3.7 * static_cast<double>(i) + 0.4); }

double start_of(const TetMesh& mesh, PetscInt i) {
  return mesh.points[static_cast<std::size_t>(i / 3)][i % 3] + wobble(i);
}

TEST(TetEnergy, DerivativesMatchDifferencesWithRepeatedUnknownsAndConstants) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> uniform(-0.2, 0.2);
  const std::array<Vec3, 4> rest = {Vec3(0, 0, 0), Vec3(1, 0.1, 0), Vec3(0.2, 1, 0), Vec3(0, 0.3, 1)};
  Corners corners;
  for (std::size_t s = 0; s < 12; ++s) {
    corners[s].constant = rest[s / 3][static_cast<Eigen::Index>(s % 3)];
    corners[s].entries = {{static_cast<PetscInt>(40 - s % 7), 1.0}, {static_cast<PetscInt>(s), -0.5}};
    if (s % 4 == 0) corners[s].entries.push_back({static_cast<PetscInt>(s), 2.0});
  }
  Mat3 frame = Mat3::Identity();
  frame(0, 1) = 0.3;
  for (auto kind : {TetEnergy::Kind::symmetric_dirichlet, TetEnergy::Kind::frame_fit}) {
    TetEnergy energy(kind);
    energy.add(gradient_operator(rest), 2.5, corners, frame);
    const std::size_t n = energy.unknowns(0).size();
    ASSERT_EQ(n, 19u);
    std::vector<double> y(n), g(n), h(n * n), plus(n), minus(n), unused(n * n);
    for (double& v : y) v = uniform(engine);
    ASSERT_TRUE(std::isfinite(energy.derivatives(0, y, g, h)));
    for (std::size_t i = 0; i < n; ++i) {
      std::vector<double> a = y, b = y;
      a[i] += 1e-6;
      b[i] -= 1e-6;
      EXPECT_NEAR(g[i], (energy.value(0, a) - energy.value(0, b)) / 2e-6, 1e-5 * (1 + std::abs(g[i])));
      energy.derivatives(0, a, plus, unused);
      energy.derivatives(0, b, minus, unused);
      for (std::size_t k = 0; k < n; ++k) {
        EXPECT_NEAR(h[i * n + k], h[k * n + i], 1e-10);
        if (kind == TetEnergy::Kind::symmetric_dirichlet) continue;  // clamped; the kernel has its own test
        EXPECT_NEAR(h[i * n + k], (plus[k] - minus[k]) / 2e-6, 1e-5);
      }
    }
  }
}

TEST(TetEnergy, MaxStepIsWhereTheTetInverts) {
  TetEnergy energy(TetEnergy::Kind::symmetric_dirichlet);
  const std::array<VertexId, 4> tet = {VertexId(0), VertexId(1), VertexId(2), VertexId(3)};
  const std::array<Vec3, 4> rest = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  energy.add(gradient_operator(rest), 1.0, vertex_corners(tet));
  std::vector<double> y, dy(12, 0.0);
  for (const Vec3& p : rest) y.insert(y.end(), p.data(), p.data() + 3);
  dy[11] = -4;  // the top goes down
  EXPECT_NEAR(energy.max_step(0, y, dy), 0.25, 1e-15);
  dy[11] = 1;
  EXPECT_EQ(energy.max_step(0, y, dy), std::numeric_limits<double>::infinity());
}

TEST(Minimise, SymmetricDirichletOfAFreeMeshGoesToARigidMotion) {
  const TetMesh mesh = testing::kuhn_box(3, 2, 2);
  const TetEnergy energy = mesh_energy(mesh, TetEnergy::Kind::symmetric_dirichlet);
  const EnergyTerm* terms[] = {&energy};
  for (auto preconditioner : {Preconditioner::amg, Preconditioner::cholesky, Preconditioner::block_jacobi}) {
    Vec y = make_vector(static_cast<PetscInt>(3 * mesh.num_vertices()), [&](PetscInt i) { return start_of(mesh, i); });
    NewtonOptions options;
    options.preconditioner = preconditioner;
    options.block_size = 3;
    options.gradient_tolerance = 1e-10;
    int monitored = 0;
    double last = evaluate(MPI_COMM_WORLD, terms, y);
    EXPECT_GT(last, 1.0);
    options.monitor = [&](int iteration, double value, double) {
      ++monitored;
      EXPECT_EQ(iteration, monitored);
      EXPECT_LE(value, last);
      last = value;
      return true;
    };
    SCOPED_TRACE(static_cast<int>(preconditioner));
    const NewtonResult result = minimise(MPI_COMM_WORLD, terms, y, options);
    EXPECT_NE(result.end, NewtonEnd::iteration_limit);
    EXPECT_NEAR(result.energy, 0.0, 1e-12);
    EXPECT_LE(result.iterations, 20);
    EXPECT_EQ(result.iterations, monitored);
    VecDestroy(&y);
  }
}

TEST(Minimise, StopsWhenTheMonitorSaysSo) {
  const TetMesh mesh = testing::kuhn_box(2, 2, 2);
  const TetEnergy energy = mesh_energy(mesh, TetEnergy::Kind::symmetric_dirichlet);
  const EnergyTerm* terms[] = {&energy};
  Vec y = make_vector(static_cast<PetscInt>(3 * mesh.num_vertices()), [&](PetscInt i) { return start_of(mesh, i); });
  NewtonOptions options;
  options.monitor = [](int iteration, double, double) { return iteration < 2; };
  const NewtonResult result = minimise(MPI_COMM_WORLD, terms, y, options);
  EXPECT_EQ(result.end, NewtonEnd::stopped);
  EXPECT_EQ(result.iterations, 2);
  VecDestroy(&y);
}

TEST(Minimise, AStartOutsideTheDomainIsTheSameErrorOnAllRanks) {
  const TetMesh mesh = testing::kuhn_box(1, 1, 1);
  const TetEnergy energy = mesh_energy(mesh, TetEnergy::Kind::symmetric_dirichlet);
  const EnergyTerm* terms[] = {&energy};
  Vec y = make_vector(static_cast<PetscInt>(3 * mesh.num_vertices()), [](PetscInt) { return 0.0; });
  EXPECT_EQ(evaluate(MPI_COMM_WORLD, terms, y), std::numeric_limits<double>::infinity());
  EXPECT_THROW(minimise(MPI_COMM_WORLD, terms, y, {}), Error);
  VecDestroy(&y);
}

// An element that fails on the last rank only.
class Failing final : public EnergyTerm {
 public:
  std::size_t num_elements() const override { return rank() + 1 == size() ? 1 : 0; }
  std::span<const PetscInt> unknowns(std::size_t) const override { return unknowns_; }
  double value(std::size_t, std::span<const double>) const override { return 0; }
  double derivatives(std::size_t, std::span<const double>, std::span<double>, std::span<double>) const override {
    throw Error(ExitCode::bug, "seeded");
  }

 private:
  std::vector<PetscInt> unknowns_{0};
};

TEST(Minimise, AFailureOfOneElementIsTheSameErrorOnAllRanks) {
  const Failing failing;
  const EnergyTerm* terms[] = {&failing};
  Vec y = make_vector(3, [](PetscInt) { return 0.0; });
  try {
    minimise(MPI_COMM_WORLD, terms, y, {});
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.sentence(), "seeded");
  }
  VecDestroy(&y);
}

TEST(SolveLinear, FrameFitReproducesAnAffineMap) {
  const TetMesh mesh = testing::kuhn_box(4, 3, 2);
  Mat3 jacobian;
  jacobian << 1, 0.2, 0, -0.3, 0.8, 0.1, 0, 0.4, 1.5;
  const TetEnergy energy = mesh_energy(mesh, TetEnergy::Kind::frame_fit, jacobian.inverse());
  LeastSquares pin;
  if (rank() == 0)
    for (int k = 0; k < 3; ++k) pin.add({{{k, 1.0}}, -0.5 * k}, 1.0);
  const EnergyTerm* terms[] = {&energy, &pin};
  for (auto preconditioner : {Preconditioner::amg, Preconditioner::cholesky}) {
    Vec y = make_vector(static_cast<PetscInt>(3 * mesh.num_vertices()), wobble);
    const NewtonResult result = solve_linear(MPI_COMM_WORLD, terms, y, preconditioner, 3);
    EXPECT_LT(result.energy, 1e-18);
    const auto values = gather(y);
    for (std::size_t v = 0; v < mesh.num_vertices(); ++v) {
      const Vec3 expected = jacobian * mesh.points[v] + Vec3(0, 0.5, 1);
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(values[3 * v + static_cast<std::size_t>(k)], expected[k], 1e-10);
    }
    VecDestroy(&y);
  }
}

// The same with all entries on rank 0.
Vec make_vector_on_root(PetscInt n, const std::function<double(PetscInt)>& start, MPI_Comm comm) {
  Vec y = nullptr;
  VecCreateMPI(comm, rank(comm) == 0 ? n : 0, n, &y);
  if (rank(comm) == 0)
    for (PetscInt i = 0; i < n; ++i) VecSetValue(y, i, start(i), INSERT_VALUES);
  VecAssemblyBegin(y);
  VecAssemblyEnd(y);
  return y;
}

// A stretched, pinned box; the minimiser is unique.
std::vector<double> stretched_box(MPI_Comm comm) {
  const TetMesh mesh = testing::kuhn_box(5, 3, 3);
  const TetEnergy energy = mesh_energy(mesh, TetEnergy::Kind::symmetric_dirichlet, Mat3::Identity(), comm);
  LeastSquares pins;
  for (std::size_t v = 0; v < mesh.num_vertices() && rank(comm) == 0; ++v) {
    const Vec3& p = mesh.points[v];
    if (p.x() > 0.5 && p.x() < 4.5) continue;
    for (int k = 0; k < 3; ++k)
      pins.add({{{static_cast<PetscInt>(3 * v) + k, 1.0}}, -p[k] * (k == 0 ? 1.4 : 1.0)}, 100.0);
  }
  const EnergyTerm* terms[] = {&energy, &pins};
  Vec y = make_vector(
      static_cast<PetscInt>(3 * mesh.num_vertices()), [&](PetscInt i) { return start_of(mesh, i); }, comm);
  NewtonOptions options;
  options.block_size = 3;
  options.gradient_tolerance = 1e-12;
  EXPECT_EQ(minimise(comm, terms, y, options).end, NewtonEnd::converged);
  auto values = gather(y);
  VecDestroy(&y);
  return values;
}

TEST(Minimise, SameBytesForAnyNumberOfThreads) {
  const int before = threads();
  set_threads(1);
  const auto one = stretched_box(MPI_COMM_WORLD);
  set_threads(3);
  const auto three = stretched_box(MPI_COMM_WORLD);
  set_threads(before);
  EXPECT_EQ(one, three);
}

TEST(Minimise, SameResultForAnyNumberOfRanks) {
  const auto together = stretched_box(MPI_COMM_WORLD);
  const auto alone = stretched_box(MPI_COMM_SELF);
  ASSERT_EQ(together.size(), alone.size());
  for (std::size_t i = 0; i < alone.size(); ++i) EXPECT_NEAR(together[i], alone[i], 1e-8 * 7);
}

// A squashed box with two corners pulled apart, given up after a few steps, far from converged. `stop`: ends there, and
// goes on from what it remembers.
std::vector<double> pulled_box(MPI_Comm comm, int stop = 0) {
  const TetMesh mesh = testing::kuhn_box(4, 4, 3);
  const TetEnergy energy = mesh_energy(mesh, TetEnergy::Kind::symmetric_dirichlet, Mat3::Identity(), comm);
  LeastSquares pins;
  const auto n = static_cast<PetscInt>(3 * mesh.num_vertices());
  if (rank(comm) == 0)
    for (int k = 0; k < 3; ++k) pins.add({{{k, 1.0}, {n - 3 + k, -1.0}}, 9.0 - k}, 1e4);
  const EnergyTerm* terms[] = {&energy, &pins};
  Vec y = make_vector_on_root(
      n, [&](PetscInt i) { return start_of(mesh, i) * (i % 3 == 0 ? 0.3 : 1.0); }, comm);
  NewtonOptions options;
  options.preconditioner = Preconditioner::cholesky;
  options.max_iterations = 6;
  options.gradient_tolerance = 1e-12;
  NewtonMemory memory;
  options.memory = &memory;
  if (stop > 0) {
    options.monitor = [&](int iteration, double, double) { return iteration < stop; };
    EXPECT_EQ(minimise(comm, terms, y, options).end, NewtonEnd::stopped);
    options.monitor = nullptr;
  }
  const NewtonResult result = minimise(comm, terms, y, options);
  EXPECT_EQ(result.end, NewtonEnd::iteration_limit);
  EXPECT_EQ(result.iterations, 6);
  auto values = gather(y);
  VecDestroy(&y);
  return values;
}

TEST(Minimise, SameBytesForAnyNumberOfRanksWhereOneOwnsTheUnknowns) {
  EXPECT_EQ(pulled_box(MPI_COMM_WORLD), pulled_box(MPI_COMM_SELF));
}

TEST(Minimise, SameBytesAfterAnInterruption) {
  const auto undisturbed = pulled_box(MPI_COMM_WORLD);
  for (int stop : {1, 2, 5}) EXPECT_EQ(pulled_box(MPI_COMM_WORLD, stop), undisturbed);
}

}  // namespace
}  // namespace hexfield::solve
