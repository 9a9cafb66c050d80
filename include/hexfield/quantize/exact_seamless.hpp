#pragma once

#include <vector>

#include "hexfield/base/error.hpp"
#include "hexfield/field/frame_field.hpp"
#include "hexfield/map/corner_map.hpp"
#include "hexfield/mesh/features.hpp"

namespace hexfield {

/// Why a map cannot be made exactly seamless.
enum class ExactFailure {
  none,
  not_finite,       ///< a coordinate is no finite number
  inverted_input,   ///< tets that are not positive before anything is moved
  unclear_index,    ///< an edge whose image angle is no multiple of a quarter-turn, within a tenth of one
  not_seamless,     ///< a transition or an alignment misses by more than the tolerance
  contradiction,    ///< tets that the alignments and transitions force flat
  inverted_output,  ///< tets that are not positive once everything is exact
};

/// In a few words, for sentences.
const char* name(ExactFailure failure);

/// A seamless map made exact.
struct ExactSeamless {
  /// Combed charts: the identity across all faces off a cut. Every transition, every aligned face and edge holds
  /// bit for bit, every tet is positive by an exact predicate. Only when `failure` is none.
  SeamlessMap map;
  EdgeCodes codes;          ///< of the singular edges, from the image angles
  double largest_move = 0;  ///< of an edge vector of a tet in its chart, parameter units
  ExactFailure failure = ExactFailure::none;
  std::vector<Violation> violations;  ///< what failed; ids are tets, or the two vertices of an edge
};

/// Doubles for which a numerically seamless map is exactly so (spec-quantization 2): the map is expressed in the
/// free unknowns of the space of all maps with its transitions and alignments (the exact elimination of 2.3 and 2.4
/// is that of conforming_space()), these are rounded to one dyadic grid, and the corners follow as exact sums.
/// Alignments: boundary and feature faces to planes, feature and singular edges to lines. A residual above
/// `tolerance`, relative to the mean edge vector of the map, is refused. No tombstones. Not collective.
ExactSeamless make_exactly_seamless(const TetMesh& mesh, const Features& features, const SeamlessMap& map,
                                    double tolerance = 1e-3);

/// Transitions and alignments that do not hold bit for bit, tets that are not positive (exact predicate).
std::vector<Violation> check_exactly_seamless(const TetMesh& mesh, const Features& features, const EdgeCodes& codes,
                                              const SeamlessMap& map);

}  // namespace hexfield
