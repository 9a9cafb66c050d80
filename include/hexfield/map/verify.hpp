#pragma once

#include <map>

#include "hexfield/field/frame_field.hpp"
#include "hexfield/map/corner_map.hpp"
#include "hexfield/mesh/features.hpp"

namespace hexfield {

/// Judges a map (spec-lmff section 8, step 6): the exact orientation of every tet in parameter space, the
/// image angle of every edge against 4 + code (inner) or 2 + code (boundary) quarter-turns, and the
/// residuals of transitions and alignments. Edges at an inverted tet are not judged by their angle.
/// Not collective; rank 0 holds the map.
MapReport verify_map(const TetMesh& mesh, const Features& features, const EdgeCodes& codes, const CornerMap& map);

/// Codes that a map with positive tets has: image angle in quarter-turns, rounded, minus 4 (inner edges)
/// or 2 (boundary edges); non-zero ones only.
EdgeCodes codes_of_map(const TetMesh& mesh, const CornerMap& map);

/// Places where the map is not an integer-grid map bit by bit: transitions that are not exact or not
/// integer, features and singular arcs off the lattice, tets that are not positive.
std::vector<Violation> check_integer_grid(const TetMesh& mesh, const Features& features, const EdgeCodes& codes,
                                          const IntegerGridMap& map);

/// Volume of the map in parameter space: the number of hexes of an integer-grid map.
double parametric_volume(const CornerMap& map);

}  // namespace hexfield
