#include <benchmark/benchmark.h>

#include "hexfield/base/parallel.hpp"
#include "hexfield/hex/extract.hpp"
#include "hexfield/hex/improve.hpp"
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

BENCHMARK(extract_many_hexes_per_tet)->ArgsProduct({{20, 60}, {1, 2}})->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(extract_many_tets_per_hex)->ArgsProduct({{32}, {1, 2}})->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(improve)->ArgsProduct({{12}, {1, 2}})->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
