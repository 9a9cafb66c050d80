#pragma once

#include <vector>

#include "hexfield/quantize/block_complex.hpp"

namespace hexfield {

/// How integers are found (spec-quantization 4 and 5).
enum class QuantizeMethod {
  pump,      ///< integer sheets from a dictionary of the patch equations, separation search
  ilp,       ///< integer program with exact secants of the squares (CBC), separation search
  positive,  ///< every arc at least min_layers: always valid, no search; for pump's and ilp's failures
};

/// What the integers shall be close to (spec-quantization 4.5).
enum class QuantizeObjective {
  arcs,   ///< the lengths of arcs
  paths,  ///< the lengths of paths between features, along each axis, and a little the lengths of arcs
};

struct QuantizeOptions {
  QuantizeMethod method = QuantizeMethod::pump;
  double target_hexes = 10000;  ///< scales the map: s^3 times its volume
  int min_layers = 1;           ///< least length of every feature and singular arc, and of every separation; above 0
  double time_limit = 120;      ///< seconds of one integer program
  QuantizeObjective objective = QuantizeObjective::arcs;
  double arc_share = 0.01;  ///< of the arcs in the objective of paths, above 0, at most 1
  /// Per arc the least number of hexes along it, 0 or more; or empty.
  std::vector<std::int64_t> least = {};
};

/// Integer lengths of the arcs of a complex.
struct Quantization {
  std::vector<std::int64_t> lengths;
  QuantizeMethod method = QuantizeMethod::positive;  ///< that they come from
  double scale = 1;                                  ///< s: wanted length of an arc is s times its length in the map
  double objective = 0;                              ///< that was minimised; for arcs: sum of (l - s length)^2
  std::int64_t hexes = 0;
  int rounds = 0;               ///< of separation search
  std::size_t separations = 0;  ///< constraints it found
  std::size_t sheets = 0;       ///< pump: those that it pumped
  bool proven_optimal = false;  ///< for the constraints in force
};

/// Integer lengths close to the scaled real ones such that opposite sides of every patch agree, no feature or
/// singular arc and no boundary region collapses, and no two of them that are apart coincide. Throws
/// Error(no_integer_grid_map) when a program has no solution, Error(usage) for options out of range. Not collective;
/// separations are searched in parallel, with the same result for any number of threads.
Quantization quantize_complex(const BlockComplex& complex, const QuantizeOptions& options);

/// Patches whose sides differ, links and regions shorter than the least number of layers, and critical entities at
/// distance zero, or at less than that number (spec-quantization 4.1 to 4.4).
std::vector<Violation> check(const BlockComplex& complex, const std::vector<std::int64_t>& lengths, int min_layers = 1);

/// Sum of the integer volumes of the blocks (4.7).
std::int64_t count_hexes(const BlockComplex& complex, const std::vector<std::int64_t>& lengths);

}  // namespace hexfield
