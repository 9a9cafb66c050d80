#include <benchmark/benchmark.h>

#include <random>

#include "hexfield/base/session.hpp"
#include "hexfield/mesh/distributed.hpp"
#include "hexfield/mesh/edit.hpp"
#include "hexfield/mesh/input_check.hpp"
#include "hexfield/mesh/partition.hpp"
#include "hexfield/mesh/refine.hpp"
#include "hexfield/mesh/surface.hpp"
#include "support/meshes.hpp"

using namespace hexfield;
using hexfield::testing::kuhn_box;

namespace {

TetMesh box_of(const benchmark::State& state) {
  const int cells = static_cast<int>(state.range(0));
  return kuhn_box(cells, cells, cells);
}

// Rate of `per_iteration` things, under `name`.
void rate(benchmark::State& state, const char* name, double per_iteration) {
  state.counters[name] = benchmark::Counter(per_iteration, benchmark::Counter::kIsIterationInvariantRate);
}

void build(benchmark::State& state) {
  const TetMesh mesh = box_of(state);
  for (auto _ : state) benchmark::DoNotOptimize(build_tet_mesh(mesh.points, mesh.tets).opposite.data());
  rate(state, "tets/s", static_cast<double>(mesh.num_tets()));
}

void input_check(benchmark::State& state) {
  const TetMesh mesh = box_of(state);
  const Features features = features_from_angles(mesh);
  for (auto _ : state) benchmark::DoNotOptimize(check_input(mesh.points, mesh.tets, features).size());
  rate(state, "tets/s", static_cast<double>(mesh.num_tets()));
}

void refine(benchmark::State& state) {
  const TetMesh coarse = box_of(state);
  for (auto _ : state) {
    TetMesh mesh = coarse;
    Features none;
    refine_uniform(mesh, none);
    benchmark::DoNotOptimize(mesh.tets.data());
  }
  rate(state, "new tets/s", 8 * static_cast<double>(coarse.num_tets()));
}

// Splits one edge of every tenth of the tets.
void split_edges(benchmark::State& state) {
  const TetMesh start = box_of(state);
  Features features = features_from_angles(start);
  for (auto _ : state) {
    TetMesh mesh = start;
    Features copy = features;
    FeatureAttribute attribute(copy);
    for (std::size_t t = 0; t < start.num_tets(); t += 10)
      if (mesh.alive(TetId(static_cast<std::int64_t>(t))))
        split_edge(mesh, mesh.tets[t][0], mesh.tets[t][3], {&attribute});
    state.counters["splits"] = static_cast<double>(mesh.num_vertices() - start.num_vertices());
  }
}

void partition(benchmark::State& state) {
  const TetMesh mesh = box_of(state);
  for (auto _ : state) benchmark::DoNotOptimize(partition_tets(mesh, static_cast<int>(state.range(1))).data());
  rate(state, "tets/s", static_cast<double>(mesh.num_tets()));
}

void distribute(benchmark::State& state) {
  const TetMesh mesh = box_of(state);
  for (auto _ : state) benchmark::DoNotOptimize(DistributedMesh(MPI_COMM_WORLD, mesh).num_owned());
  rate(state, "tets/s", static_cast<double>(mesh.num_tets()));
}

void project(benchmark::State& state) {
  const TetMesh mesh = box_of(state);
  const ClosestSurface surface(mesh, features_from_angles(mesh));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> x(0, static_cast<double>(state.range(0)));
  std::vector<Vec3> points(1000);
  for (Vec3& p : points) p = {x(random), x(random), 0.1};
  for (auto _ : state)
    for (const Vec3& p : points) benchmark::DoNotOptimize(surface.project(p, 1).distance);
  rate(state, "points/s", 1000);
}

constexpr auto ms = benchmark::kMillisecond;
BENCHMARK(build)->Arg(16)->Arg(48)->UseRealTime()->Unit(ms);
BENCHMARK(input_check)->Arg(16)->Arg(48)->UseRealTime()->Unit(ms);
BENCHMARK(refine)->Arg(16)->Arg(24)->UseRealTime()->Unit(ms);
BENCHMARK(split_edges)->Arg(16)->Arg(32)->UseRealTime()->Unit(ms);
BENCHMARK(partition)->Args({32, 2})->Args({32, 16})->UseRealTime()->Unit(ms);
BENCHMARK(distribute)->Arg(32)->UseRealTime()->Unit(ms);
BENCHMARK(project)->Arg(16)->Arg(48)->UseRealTime()->Unit(ms);

}  // namespace

int main(int argc, char** argv) {
  Session session(argc, argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
