#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "hexfield/io/named_arrays.hpp"
#include "hexfield/map/compute_map.hpp"
#include "hexfield/quantize/block_complex.hpp"
#include "hexfield/quantize/quantization.hpp"

namespace hexfield {

/// Walls and arcs of a complex, to be drawn: cells of blocks.vtk by indices into `points`.
struct BlockPicture {
  std::vector<Vec3> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::array<std::int32_t, 4>> walls;  ///< per triangle: patch, its two blocks (-1: none), boundary
  std::vector<std::array<std::int32_t, 2>> lines;
  std::vector<std::array<std::int32_t, 4>> arcs;  ///< per line: arc, code, feature, integer length
};

/// The value of stage 5: integers for the map that the stage hands on.
struct QuantizeResult {
  std::string kind = "rounding";  ///< "pump", "ilp", "positive" (every arc at least 1), or "rounding": none yet
  Quantization integers;
  std::vector<double> wanted;    ///< per arc: the scaled length in the map
  std::vector<double> unknowns;  ///< integer unknowns of the conforming space of the exact map
  std::vector<Vec3> stretches;   ///< per tet, of MapQuantizer
  double largest_move = 0;       ///< of an edge vector when the map was made exact, parameter units
  std::int64_t nodes = 0, arcs = 0, patches = 0, blocks = 0, euler = 0;
  std::map<std::string, double> seconds;  ///< of the clock: exact, complex, integers
  std::vector<std::string> notes;         ///< sentences on further tries and fallbacks
  BlockPicture picture;
};

/// The arc next to one of the places whose integer is furthest from the wanted length, as a sentence; empty without
/// arcs or places.
std::string spacing_near(const QuantizeResult& result, const std::vector<Vec3>& places);

BlockPicture picture_of(const BlockComplex& complex, const std::vector<std::int64_t>& lengths);

/// As arrays of a checkpoint group and back, bit for bit; names begin with "quantize_". The arrays refer to `result`.
NamedArrays pack(const QuantizeResult& result);
QuantizeResult unpack_quantize(const NamedArrays& arrays);

/// All arrays of both, which have no name in common.
NamedArrays joined(NamedArrays a, const NamedArrays& b);

}  // namespace hexfield
