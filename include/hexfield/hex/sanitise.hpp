#pragma once

#include <vector>

#include "hexfield/base/error.hpp"
#include "hexfield/map/corner_map.hpp"
#include "hexfield/mesh/features.hpp"
#include "hexfield/mesh/tet_mesh.hpp"

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

/// An integer-grid map with defects, made as exact as it can be.
struct HealedMap {
  enum class Tet : char {
    positive,
    flat,      ///< of no volume in the map
    unusable,  ///< inverted, or beside a transition, boundary or feature that no lattice value fits
  };
  IntegerGridMap map;              ///< exact between usable tets
  std::vector<Tet> tets;           ///< state per tet
  std::vector<VertexId> moved;     ///< vertices whose images were moved to make tets positive, ascending
  std::vector<Violation> defects;  ///< everything that sanitise_igm() would refuse the map for
};

/// As sanitise_igm(), but goes on where a corner is off by more than `tolerance`, up to `limit`: every vertex takes the
/// median of what its tets say. Images of vertices at inverted and flat tets are then moved within their lattice
/// planes and lines where that makes all tets around them positive. Error(bad_hex_mesh) only for coordinates that are
/// not finite or too large. Not collective; same bytes for any number of threads.
HealedMap heal_igm(const TetMesh& mesh, const Features& features, const IntegerGridMap& map, double tolerance = 1e-2,
                   double limit = 0.4);

}  // namespace hexfield
