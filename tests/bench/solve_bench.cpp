#include <benchmark/benchmark.h>

#include "../../src/solve/assembly.hpp"
#include "hexfield/base/session.hpp"
#include "hexfield/solve/kernels.hpp"
#include "hexfield/solve/tet_energy.hpp"
#include "support/meshes.hpp"

using namespace hexfield;
using hexfield::testing::kuhn_box;

namespace {

void rate(benchmark::State& state, const char* name, double per_iteration) {
  state.counters[name] = benchmark::Counter(per_iteration, benchmark::Counter::kIsIterationInvariantRate);
}

Mat3 sheared() {
  Mat3 j;
  j << 1.1, 0.2, 0, -0.3, 0.8, 0.1, 0, 0.4, 1.5;
  return j;
}

solve::TetEnergy energy_of(const TetMesh& mesh) {
  solve::TetEnergy energy(solve::TetEnergy::Kind::symmetric_dirichlet);
  for (const auto& v : mesh.tets) {
    std::array<solve::AffineScalar, 12> corners;
    for (std::size_t c = 0; c < 4; ++c)
      for (std::size_t k = 0; k < 3; ++k)
        corners[3 * c + k].entries = {{static_cast<PetscInt>(3 * v[c].value + static_cast<int>(k)), 1.0}};
    energy.add(solve::gradient_operator({mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3])}), 1.0,
               corners, sheared());
  }
  return energy;
}

void kernel(benchmark::State& state) {
  const Mat3 j = sheared();
  solve::Vec9 g;
  solve::Mat9 h;
  for (auto _ : state) benchmark::DoNotOptimize(solve::symmetric_dirichlet(j, g, h));
  rate(state, "tets/s", 1);
}

void factored_kernel(benchmark::State& state) {
  const Mat3 j = sheared();
  Mat3 g;
  solve::FactoredHessian h;
  for (auto _ : state) benchmark::DoNotOptimize(solve::symmetric_dirichlet(j, g, h));
  rate(state, "tets/s", 1);
}

void inversion(benchmark::State& state) {
  const Mat3 j = sheared();
  Mat3 d = -sheared();
  d(0, 2) = 1;
  for (auto _ : state) benchmark::DoNotOptimize(solve::first_inversion(j, d));
  rate(state, "tets/s", 1);
}

// Energy, gradient and assembled Hessian of a mesh.
void assembly(benchmark::State& state) {
  const int cells = static_cast<int>(state.range(0));
  const TetMesh mesh = kuhn_box(cells, cells, cells);
  const solve::TetEnergy energy = energy_of(mesh);
  const solve::EnergyTerm* terms[] = {&energy};
  solve::VecHandle y, gradient;
  VecCreateSeq(PETSC_COMM_SELF, static_cast<PetscInt>(3 * mesh.num_vertices()), y.out());
  for (std::size_t v = 0; v < mesh.num_vertices(); ++v)
    for (int k = 0; k < 3; ++k)
      VecSetValue(y.get(), static_cast<PetscInt>(3 * v) + k, mesh.points[v][k], INSERT_VALUES);
  VecDuplicate(y.get(), gradient.out());
  solve::Assembly assembled(PETSC_COMM_SELF, terms, y.get());
  assembled.derivatives(y.get(), gradient.get());
  for (auto _ : state) benchmark::DoNotOptimize(assembled.derivatives(y.get(), gradient.get()));
  rate(state, "tets/s", static_cast<double>(mesh.num_tets()));
}

BENCHMARK(kernel);
BENCHMARK(factored_kernel);
BENCHMARK(inversion);
BENCHMARK(assembly)->Arg(10)->Arg(20)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

int main(int argc, char** argv) {
  Session session(argc, argv);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
