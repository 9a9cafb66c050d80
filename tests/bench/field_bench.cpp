#include <benchmark/benchmark.h>

#include <ctime>

#include "../../src/field/align_kernel.hpp"
#include "hexfield/base/parallel.hpp"
#include "hexfield/base/session.hpp"
#include "hexfield/field/constraints.hpp"
#include "hexfield/field/matchings.hpp"
#include "hexfield/field/octahedral_smoothing.hpp"
#include "hexfield/field/spherical_harmonics.hpp"
#include "hexfield/field/vertex_field.hpp"
#include "support/meshes.hpp"

using namespace hexfield;

namespace {

// CPU seconds of all threads: what others do on the machine does not count.
double cpu() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// A box blown up halfway to a ball: no features, so its smooth field is singular inside.
TetMesh rounded_box(int cells) {
  TetMesh mesh = hexfield::testing::kuhn_box(cells, cells, cells);
  for (Vec3& p : mesh.points) {
    const Vec3 x = 2 * p / cells - Vec3::Ones();
    const double norm = x.norm();
    p = norm > 0 ? Vec3(x * (0.5 + 0.5 * x.cwiseAbs().maxCoeff() / norm)) : x;
  }
  return mesh;
}

// A twisted field with the alignment of the boundary, whose matchings are not all the identity.
AlignData twisted(const TetMesh& mesh, std::vector<Quaternion>& frames) {
  FrameField field;
  for (std::size_t i = 0; i < mesh.num_tets(); ++i) {
    const Vec3 c = centroid(mesh, TetId(static_cast<std::int64_t>(i)));
    field.frames.emplace_back(Eigen::AngleAxisd(2 * c.norm(), c.normalized()));
  }
  compute_matchings(mesh, field);
  comb(mesh, field);
  AlignData data;
  data.owned = data.tets = mesh.num_tets();
  data.neighbours.resize(data.tets);
  data.from_neighbour.resize(data.tets);
  for (std::size_t i = 0; i < data.tets; ++i)
    for (std::size_t f = 0; f < 4; ++f) {
      const HalfFaceId o = mesh.opposite[i][f];
      data.neighbours[i][f] = o.valid() ? o.tet().value : static_cast<std::int32_t>(data.tets);
      data.from_neighbour[i][f] = octahedral::inverse(field.matchings[i][f]);
    }
  for (const auto& [tet, c] : frame_constraints(collect_constraints(mesh, {}, field, {})))
    data.constraints.emplace_back(tet.value, c);
  frames = field.frames;
  frames.emplace_back(0, 0, 0, 0);
  return data;
}

// Bytes per CPU second of a[i] = b[i] + s c[i] on arrays much larger than the caches, best of several runs [STREAM].
double triad_bandwidth() {
  const std::size_t n = std::size_t{1} << 24;
  std::vector<double> a(n, 0.0), b(n, 1.0), c(n, 2.0);
  double best = 0;
  for (int run = 0; run < 5; ++run) {
    const double start = cpu();
    parallel_for(n, std::size_t{1} << 18, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) a[i] = b[i] + 3 * c[i];
    });
    benchmark::DoNotOptimize(a.data());
    best = std::max(best, 24 * static_cast<double>(n) / (cpu() - start));
  }
  return best;
}

// Sweeps of Algorithm 1 and the share of what the memory would allow: each sweep must read the frame, the
// neighbours and matchings of a tet and write a frame, when the frames of neighbours come from caches.
void algorithm_1(benchmark::State& state) {
  const int cells = static_cast<int>(state.range(0));
  set_threads(static_cast<int>(state.range(1)));
  const TetMesh mesh = rounded_box(cells);
  std::vector<Quaternion> previous;
  const AlignData data = twisted(mesh, previous);
  std::vector<Quaternion> current = previous, next = previous;
  const SweepLimits limits{std::cos(170 * M_PI / 360), std::cos(9 * M_PI / 360)};
  const double bytes = 2 * sizeof(Quaternion) + sizeof(data.neighbours[0]) + sizeof(data.from_neighbour[0]);
  const double bandwidth = triad_bandwidth();
  double seconds = 0, updates = 0;
  for (auto _ : state) {
    const double start = cpu();
    benchmark::DoNotOptimize(jacobi_sweep(data, limits, previous, current, next));
    seconds += cpu() - start;
    updates += static_cast<double>(data.owned);
    previous.swap(current);
    current.swap(next);
  }
  state.counters["tets"] = static_cast<double>(data.owned);
  state.counters["updates/s per core"] = updates / seconds;
  state.counters["triad GB/s per core"] = bandwidth / 1e9;
  state.counters["share of bound"] = updates / seconds * bytes / bandwidth;
}

// The vertex field of one shape on finer and finer meshes.
void initial_field(benchmark::State& state) {
  const int cells = static_cast<int>(state.range(0));
  set_threads(static_cast<int>(state.range(1)));
  const TetMesh mesh = rounded_box(cells);
  const RootGraph graph = vertex_graph(mesh);
  const std::vector<NodeConstraint> constraints = vertex_constraints(mesh, {}, 70);
  SmoothingOptions options;
  options.tolerance = 1e-4;
  SmoothingReport report;
  double seconds = 0;
  for (auto _ : state) {
    report = {};
    const double start = cpu();
    smooth_octahedral_field(MPI_COMM_WORLD, graph, constraints, nullptr, options, report, {});
    seconds += cpu() - start;
  }
  const auto tets = static_cast<double>(mesh.num_tets());
  state.counters["tets"] = tets;
  state.counters["CPU s per M tets"] = seconds / static_cast<double>(state.iterations()) / (tets / 1e6);
  state.counters["CG iterations"] = report.linear_iterations;
  state.counters["steps"] = static_cast<double>(report.energies.size()) - 1;
  state.counters["energy"] = report.energies.back();
}

// Closest frames of vectors near frames.
void project(benchmark::State& state) {
  std::vector<harmonics::Sh> vectors;
  for (int i = 0; i < 1000; ++i) {
    const Quaternion q(Eigen::AngleAxisd(0.01 * i, Vec3(1, 0.3 * i, 2).normalized()));
    vectors.push_back(2 * harmonics::of_frame(q) + 0.2 * harmonics::Sh::Unit(i % 9));
  }
  for (auto _ : state)
    for (const auto& v : vectors) benchmark::DoNotOptimize(harmonics::project(v).dot);
  state.counters["vectors/s"] = benchmark::Counter(1000, benchmark::Counter::kIsIterationInvariantRate);
}

constexpr auto ms = benchmark::kMillisecond;
BENCHMARK(algorithm_1)->Args({20, 1})->Args({54, 1})->Args({54, 2})->UseRealTime()->Unit(ms);
BENCHMARK(initial_field)->Args({12, 1})->Args({20, 1})->Args({34, 1})->Args({54, 1})->UseRealTime()->Unit(ms);
BENCHMARK(project)->Unit(ms);

}  // namespace

int main(int argc, char** argv) {
  Session session(argc, argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
