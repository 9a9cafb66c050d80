// From a seamless map in a file to integer lengths: CPU seconds of every step.
//   bench_quantize MAP.hexex ... [--hexes N] [--repeat K] [--walls]
// prints one line per map and number of hexes (the map as it stands, scaled by 1 and 2, where none is given);
// with --walls what the walls in the file make, and ours.
#include <fmt/core.h>

#include <cstring>
#include <ctime>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "../../src/quantize/arc_system.hpp"
#include "../../src/quantize/reduction.hpp"
#include "../../src/quantize/separation.hpp"
#include "../../src/quantize/wall_cells.hpp"
#include "hexfield/base/parallel.hpp"
#include "hexfield/io/hexex_io.hpp"
#include "hexfield/map/verify.hpp"
#include "hexfield/quantize/exact_seamless.hpp"
#include "hexfield/quantize/motorcycle_complex.hpp"
#include "hexfield/quantize/quantization.hpp"

using namespace hexfield;

namespace {

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Timer {
  double last = cpu_seconds();
  double lap() {
    const double now = cpu_seconds();
    return now - std::exchange(last, now);
  }
};

template <class Work>
double per_run(int repeat, const Work& work) {
  Timer timer;
  for (int k = 0; k < repeat; ++k) work();
  return timer.lap() / repeat;
}

void run(const std::string& file, const std::vector<double>& hexes, int repeat) {
  Timer timer;
  const HexexInput input = read_hexex(file);
  const double read = timer.lap();
  const ExactSeamless exact = make_exactly_seamless(input.mesh, input.features, input.map);
  const double exactly = timer.lap();
  if (exact.failure != ExactFailure::none) {
    fmt::print("{}: {}\n", file, exact.violations[0].sentence);
    return;
  }
  const BlockComplex complex = motorcycle_complex(input.mesh, input.features, exact.codes, exact.map);
  const double traced = timer.lap();
  const auto critical = quantize::critical_set(complex);
  const auto system = quantize::bundle_system(complex, 1);
  const std::string name = file.substr(file.rfind('/') + 1);
  for (double n : hexes) {
    const double target = n > 0 ? n : -n * parametric_volume(exact.map);
    Quantization pump, ilp;
    const double by_pump = per_run(
        repeat, [&] { pump = quantize_complex(complex, {.method = QuantizeMethod::pump, .target_hexes = target}); });
    const double by_ilp = per_run(
        repeat, [&] { ilp = quantize_complex(complex, {.method = QuantizeMethod::ilp, .target_hexes = target}); });
    const double search = per_run(repeat, [&] { quantize::SeparationSearch(complex, critical).run(pump.lengths); });
    fmt::print(
        "{:.32} {} tets {} blocks {} arcs {} bundles {} equations | read {:.3f} exact {:.3f} complex {:.3f} | {:.0f} "
        "hexes: pump {:.3f} ms, {} rounds, {} cuts, objective {:.4f}, {} hexes; ilp {:.3f} ms, {} rounds, {} cuts, "
        "objective {:.4f}{}; search {:.3f} ms | ratio {:.3f}\n",
        name, input.mesh.num_tets(), complex.blocks.size(), complex.arcs.size(), system.num_bundles(),
        system.equations.size(), read, exactly, traced, target, 1e3 * by_pump, pump.rounds, pump.separations,
        pump.objective, pump.hexes, 1e3 * by_ilp, ilp.rounds, ilp.separations, ilp.objective,
        ilp.proven_optimal ? " optimal" : "", 1e3 * search, by_pump / by_ilp);
  }
}

// Walls around the inner singular edges, and edges with fewer than they have quarter-turns.
std::string singular_walls(const quantize::ChartMesh& mesh) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::pair<int, bool>> walls;  // wall half-faces, on the boundary
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(mesh.num_tets()); ++t) {
    if (!mesh.alive(t)) continue;
    for (const auto& e : tet_edge_vertices) {
      const std::int32_t a = mesh.tet(t).vertices[static_cast<std::size_t>(e[0])];
      const std::int32_t b = mesh.tet(t).vertices[static_cast<std::size_t>(e[1])];
      if (mesh.edge_code(a, b) == 0) continue;
      auto& entry = walls[std::minmax(a, b)];
      for (int f = 0; f < 4; ++f) {
        if (f == e[0] || f == e[1]) continue;
        entry.first += mesh.is_wall(4 * t + f);
        entry.second = entry.second || mesh.opposite(4 * t + f) < 0;
      }
    }
  }
  std::size_t inner = 0, few = 0, concave = 0, few_concave = 0;
  for (const auto& [edge, entry] : walls) {
    const int code = mesh.edge_code(edge.first, edge.second);
    if (entry.second) {
      if (code < 0) continue;
      ++concave;
      few_concave += entry.first < 2 * (2 + code);
    } else {
      ++inner;
      few += entry.first < 2 * (4 + code);
    }
  }
  return fmt::format("inner singular edges {}, with a wall missing {}; concave edges {}, with a wall missing {}", inner,
                     few, concave, few_concave);
}

std::string sizes(const BlockComplex& c) {
  return fmt::format("{} nodes {} arcs {} patches {} blocks, {} violations", c.nodes.size(), c.arcs.size(),
                     c.patches.size(), c.blocks.size(), check(c).size());
}

// The walls that the file lists, and ours: what each makes, and whether more can be removed.
void compare_walls(const std::string& file) {
  const HexexInput input = read_hexex(file);
  const ExactSeamless exact = make_exactly_seamless(input.mesh, input.features, input.map);
  const std::string name = file.substr(file.rfind('/') + 1);
  for (const bool reduce : {false, true}) {
    quantize::ChartMesh walls(input.mesh, input.features, exact.codes, exact.map);
    quantize::WallCells cells(walls);
    quantize::trace_and_reduce(walls, cells, reduce);
    fmt::print("{:40.40} ours {}: {}; {}\n", name, reduce ? "reduced" : "raw", sizes(cells.complex),
               singular_walls(walls));
  }
  quantize::ChartMesh walls(input.mesh, input.features, exact.codes, exact.map);
  std::set<FaceKey> given;
  for (const WallTriangle& w : input.walls) {
    FaceKey key = w.vertices;
    std::sort(key.begin(), key.end());
    given.insert(key);
  }
  std::size_t set = 0;
  for (std::int32_t h = 0; h < static_cast<std::int32_t>(4 * walls.num_tets()); ++h) {
    if (walls.is_wall(h) || !given.contains(input.mesh.key(HalfFaceId(static_cast<std::int64_t>(h))))) continue;
    int axis = -1;
    for (int k = 0; k < 3; ++k) {
      const auto x = [&](int i) {
        return walls.points.value(
            walls.point(h / 4, tet_face_vertices[static_cast<std::size_t>(h % 4)][static_cast<std::size_t>(i)]), k);
      };
      if (x(0) == x(1) && x(0) == x(2)) axis = k;
    }
    if (axis < 0) continue;
    walls.set_wall(h, axis, 1);
    ++set;
  }
  quantize::WallCells cells(walls);
  try {
    cells.build();
    fmt::print("{:40.40} given: {} walls of {}, {} cuts; {}; {}; removable {}\n", name, set, given.size(),
               cells.cuts().size(), sizes(cells.complex), singular_walls(walls),
               quantize::removable_patches(cells.complex).size());
  } catch (const Error& error) {
    fmt::print("{:40.40} given: {}; {}\n", name, error.sentence(), singular_walls(walls));
  }
}

}  // namespace

int main(int argc, char** argv) {
  set_threads(1);
  std::vector<std::string> files;
  std::vector<double> hexes;
  int repeat = 1;
  bool walls = false;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--hexes") == 0 && i + 1 < argc)
      hexes.push_back(std::stod(argv[++i]));
    else if (std::strcmp(argv[i], "--walls") == 0)
      walls = true;
    else if (std::strcmp(argv[i], "--repeat") == 0 && i + 1 < argc)
      repeat = std::stoi(argv[++i]);
    else
      files.emplace_back(argv[i]);
  }
  if (hexes.empty()) hexes = {-1, -8};
  for (const std::string& file : files) walls ? compare_walls(file) : run(file, hexes, repeat);
  return 0;
}
