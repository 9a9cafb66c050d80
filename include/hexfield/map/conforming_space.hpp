#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "hexfield/map/alignments.hpp"
#include "hexfield/map/cut_graph.hpp"

namespace hexfield {

/// All maps that are continuous up to the transitions of a cut graph and keep the alignments, as x = N y:
/// x holds three coordinates per corner class in combed charts (x[3 c + k]), y holds free unknowns. N has
/// exact small integer entries, of which most rows have a single +-1 (spec-lmff section 8, steps 3 to 5).
///
/// y[0, num_reals) are real unknowns; y[num_reals, num_reals + num_integers) are those that an integer-grid
/// map makes integer (translations of the cut, coordinates of features and singular arcs): x is an
/// integer-grid map exactly when they are, and every integer choice of them is one.
struct ConformingSpace {
  CutGraph cut;
  std::size_t num_reals = 0;
  std::size_t num_integers = 0;
  /// Row x of N: entries [row_start[x], row_start[x + 1]).
  std::vector<std::size_t> row_start;
  std::vector<std::int32_t> columns;
  std::vector<std::int32_t> coefficients;
  /// Whether coordinate x is an integer in an integer-grid map (no real unknown in its row).
  std::vector<char> integral;
  /// Each unknown in terms of the map: sum of coefficient * x[source], or for source < 0 coefficient *
  /// component ~source of the translations of the cut patches (3 per patch).
  std::vector<std::vector<std::pair<std::int32_t, std::int32_t>>> definitions;
  /// Corner class at the origin, per component.
  std::vector<std::int32_t> pins;
  /// Tets that every map of this space makes flat: the constraints contradict the mesh or each other.
  std::vector<TetId> collapsed;

  std::size_t num_unknowns() const { return num_reals + num_integers; }
  std::size_t num_coordinates() const { return 3 * cut.num_classes(); }
};

/// The space of the maps with these alignments (axes in the charts before combing). One vertex per
/// component is pinned at the origin: a critical point if there is one, else on a curve, else on a surface.
ConformingSpace conforming_space(const TetMesh& mesh, CutGraph cut, const Alignments& alignments);

/// x = N y.
std::vector<double> coordinates(const ConformingSpace& space, std::span<const double> y);

/// The map with coordinates x (3 per corner class) in combed charts.
CornerMap to_corner_map(const ConformingSpace& space, std::span<const double> x);

/// y of the map of the space that agrees with `map` (charts before combing) up to its deviation from it.
std::vector<double> unknowns_of(const TetMesh& mesh, const ConformingSpace& space, const CornerMap& map);

/// Rounds y to a dyadic grid such that all sums in N y and in R x + t are exact in doubles: the map
/// N y is then bitwise seamless and aligned. Integers stay what they are.
void quantize_to_dyadic_grid(const ConformingSpace& space, std::span<double> y);

}  // namespace hexfield
