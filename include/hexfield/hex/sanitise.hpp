#pragma once

#include <vector>

#include "hexfield/base/error.hpp"
#include "hexfield/map/corner_map.hpp"
#include "hexfield/mesh/features.hpp"

namespace hexfield {

/// An integer-grid map made exact.
struct SanitisedMap {
  IntegerGridMap map;
  double largest_move = 0;  ///< of a corner, in parameter units
  /// What cannot be made exact within the tolerance, and tets that are not positive; ids are tets or vertices.
  std::vector<Violation> violations;
};

/// Rounds the transitions to integers, the boundary and the features to lattice planes, lines and points, and
/// singular edges to lattice lines, and every coordinate to one dyadic grid, such that all of this then holds
/// bit for bit (spec-quantization 7.1). A map that is exact already is only cut to the grid (52 bits).
/// Deviations above `tolerance` (parameter units) are violations. Not collective; same bytes for any number
/// of threads.
SanitisedMap sanitise_igm(const TetMesh& mesh, const Features& features, const IntegerGridMap& map,
                          double tolerance = 1e-2);

}  // namespace hexfield
