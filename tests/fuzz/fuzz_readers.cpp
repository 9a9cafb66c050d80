// Feeds mutated files to every reader: each must be read as a valid mesh or refused by Error(bad_input).
//
//   fuzz_readers [INPUTS] [SEED]          default: 2000 inputs, seed 1
//
// Writes the first offending input to fuzz-failure.bin in the working directory and ends with status 1.
// Best built with HEXFIELD_SANITIZE.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>

#include "io/samples.hpp"
#include "mutate.hpp"
#include "readers.hpp"
#include "seeds.hpp"

// Nothing that a reader does for these small files needs as much; no effect without the sanitizer.
extern "C" const char* __asan_default_options() { return "max_allocation_size_mb=256:detect_leaks=0"; }

namespace {

using namespace hexfield;

// What happens to `data`: "read" or "refused"; a sentence when it is neither.
std::string judged(const fuzz::Seed& seed, const std::string& data) {
  try {
    if (seed.hexex) {
      const HexexInput input = io::read_hexex(io::Scanner(seed.name, data));
      require(input.map.rotations.size() == input.mesh.num_tets(), "rotations are missing");
      return "read";
    }
    const io::CellSoup soup = io::parse_soup(seed.name, data);
    if (!seed.hexes) {
      const auto found = check(io::assemble_tets(soup).mesh);
      return found.empty() ? "read" : "accepted, but: " + found[0].sentence;
    }
    io::assemble_hexes(soup);
    return "read";
  } catch (const Error& error) {
    const std::string& text = error.sentence();
    const bool one_sentence = text.find('\n') == std::string::npos && text.starts_with(seed.name) && text.back() == '.';
    if (error.code() == ExitCode::bad_input && one_sentence) return "refused";
    return fmt::format("code {}: {}", static_cast<int>(error.code()), error.what());
  } catch (const std::exception& error) {
    return fmt::format("an exception: {}", error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t inputs = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 2000;
  const std::uint64_t first_seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  const std::vector<fuzz::Seed> seeds = fuzz::seeds();
  std::map<std::string, std::uint64_t> counts;
  double slowest = 0;
  for (std::uint64_t i = 0; i < inputs; ++i) {
    fuzz::Mutator mutator(first_seed + i);
    const fuzz::Seed& seed = seeds[mutator.below(seeds.size())];
    const std::string data = mutator.mutated(seed.data, seeds[mutator.below(seeds.size())].data);
    const auto start = std::chrono::steady_clock::now();
    const std::string verdict = judged(seed, data);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (seconds > slowest) slowest = seconds;
    ++counts[verdict];
    if (verdict == "read" || verdict == "refused") continue;
    std::ofstream("fuzz-failure.bin", std::ios::binary) << data;
    fmt::print("seed {} ({}): {}\n", first_seed + i, seed.name, verdict);
    return 1;
  }
  fmt::print("{} inputs: {}; slowest {:.3f} s\n", inputs, counts, slowest);
  return 0;
}
