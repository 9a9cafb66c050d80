#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include "../../src/hex/quad_classes.hpp"
#include "hexfield/base/parallel.hpp"
#include "hexfield/hex/extract.hpp"
#include "hexfield/hex/hex_singular_graph.hpp"
#include "hexfield/hex/improve.hpp"
#include "hexfield/hex/sheet.hpp"
#include "support/hex_meshes.hpp"
#include "support/mapped_meshes.hpp"

using namespace hexfield;
using namespace hexfield::testing;

namespace {

// A prism with a valence-5 line: few tets, `size` hexes along each of their edges.
void extract_many_hexes_per_tet(benchmark::State& state) {
  const int size = static_cast<int>(state.range(0));
  set_threads(static_cast<int>(state.range(1)));
  const MappedMesh m = polygon_prism({size, size, size, size, size}, size);
  std::size_t hexes = 0;
  for (auto _ : state) hexes += extract_hex_mesh(m.mesh, {}, m.map).hexes.size();
  state.counters["hexes/s"] = benchmark::Counter(static_cast<double>(hexes), benchmark::Counter::kIsRate);
}

// A cube of 6 n^3 tets with one hex in 8 cells.
void extract_many_tets_per_hex(benchmark::State& state) {
  const int cells = static_cast<int>(state.range(0));
  set_threads(static_cast<int>(state.range(1)));
  const MappedMesh m = scaled_box(cells, cells, cells, Vec3::Constant(0.5));
  std::size_t hexes = 0;
  std::size_t tets = 0;
  for (auto _ : state) {
    hexes += extract_hex_mesh(m.mesh, {}, m.map).hexes.size();
    tets += m.mesh.num_tets();
  }
  state.counters["hexes/s"] = benchmark::Counter(static_cast<double>(hexes), benchmark::Counter::kIsRate);
  state.counters["tets/s"] = benchmark::Counter(static_cast<double>(tets), benchmark::Counter::kIsRate);
}

void improve(benchmark::State& state) {
  set_threads(static_cast<int>(state.range(1)));
  const int size = static_cast<int>(state.range(0));
  const MappedMesh m = polygon_prism({size, size, size}, size);
  const HexMesh start = extract_hex_mesh(m.mesh, {}, m.map);
  for (auto _ : state) {
    HexMesh hexes = start;
    improve_hex_mesh(hexes, m.mesh, {}, {}, {});
    benchmark::DoNotOptimize(hexes.points.data());
  }
  state.counters["hexes"] = static_cast<double>(start.hexes.size());
}

// Singular graph, classes of quads and one inflation on a padded block of about size^3 hexes.
void sheets(benchmark::State& state) {
  set_threads(static_cast<int>(state.range(1)));
  const int size = static_cast<int>(state.range(0));
  const HexMesh block = hex_grid({size, size, size});
  const HexMesh mesh = pad(block, build_hex_complex(block));
  for (auto _ : state) {
    const HexComplex complex = build_hex_complex(mesh);
    const HexSingularGraph graph = hex_singular_graph(mesh, complex);
    const hex::QuadClasses classes = hex::build_quad_classes(complex, feature_quads_of(mesh, complex));
    // The largest class that is a sheet by itself: a plane through the block.
    int best = -1;
    for (int c = 0; c < static_cast<int>(classes.usable.size()); ++c)
      if (classes.usable[static_cast<std::size_t>(c)] != 0 && classes.rims[c].empty() &&
          (best < 0 || classes.quads[c].size() > classes.quads[best].size()))
        best = c;
    const auto quads = classes.quads[best];
    const Inflation inflated = inflate_sheet(mesh, complex, {quads.begin(), quads.end()});
    state.counters["nodes"] = static_cast<double>(graph.nodes.size());
    state.counters["classes"] = static_cast<double>(classes.usable.size());
    state.counters["quads"] = static_cast<double>(quads.size());
    benchmark::DoNotOptimize(inflated.mesh.hexes.data());
  }
  state.counters["hexes"] = static_cast<double>(mesh.hexes.size());
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["peak_MB"] = static_cast<double>(usage.ru_maxrss) / 1024;
}

BENCHMARK(extract_many_hexes_per_tet)->ArgsProduct({{20, 60}, {1, 2}})->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(extract_many_tets_per_hex)->ArgsProduct({{32}, {1, 2}})->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(improve)->ArgsProduct({{12}, {1, 2}})->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(sheets)->ArgsProduct({{40, 98}, {1, 2}})->Iterations(1)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
