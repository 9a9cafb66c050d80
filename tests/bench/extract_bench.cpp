// Extraction from integer-grid maps in files, multiplied by 1, 2, 4 and 8: wall and CPU seconds, time per hex.
//   bench_extract MAP.igm.hexex ... [--threads T] [--largest K]
#include <fmt/core.h>

#include <chrono>
#include <cstring>
#include <ctime>
#include <string>
#include <vector>

#include "hexfield/base/parallel.hpp"
#include "hexfield/hex/extract.hpp"
#include "hexfield/io/hexex_io.hpp"

using namespace hexfield;

namespace {

void run(const std::string& file, int largest) {
  const HexexInput input = read_hexex(file);
  for (int scale = 1; scale <= largest; scale *= 2) {
    IntegerGridMap map = input.map;
    for (auto& tet : map.uvw)
      for (Vec3& p : tet) p *= scale;
    const auto wall = std::chrono::steady_clock::now();
    const std::clock_t cpu = std::clock();
    const HexMesh mesh = extract_hex_mesh(input.mesh, {}, map);
    const double cpu_seconds = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
    const auto n = static_cast<double>(mesh.hexes.size());
    fmt::print(
        "{:32.32} tets {:6} scale {} hexes {:8.0f} ({:7.2f} per tet) wall {:7.3f} s cpu {:7.3f} s, {:6.3f} us cpu "
        "per hex, {:6.2f} M hexes per cpu second, {:6.2f} M per wall second\n",
        file.substr(file.rfind('/') + 1), input.mesh.num_tets(), scale, n,
        n / static_cast<double>(input.mesh.num_tets()), seconds, cpu_seconds, 1e6 * cpu_seconds / n,
        1e-6 * n / cpu_seconds, 1e-6 * n / seconds);
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> files;
  int largest = 8;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--threads") == 0 && i + 1 < argc)
      set_threads(std::stoi(argv[++i]));
    else if (std::strcmp(argv[i], "--largest") == 0 && i + 1 < argc)
      largest = std::stoi(argv[++i]);
    else
      files.emplace_back(argv[i]);
  }
  for (const std::string& file : files) run(file, largest);
  return 0;
}
