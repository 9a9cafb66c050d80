#pragma once

#include <map>
#include <string>
#include <vector>

#include "hexfield/hex/sphere_triangulation.hpp"

namespace hexfield {

/// Bounds of the splits that a table considers.
struct CutLimits {
  int max_valence = 6;    ///< of any edge on the way, also the longest cycle
  int max_vertices = 13;  ///< of any triangulation on the way
};

/// What is known of one type of triangulation.
struct CutRow {
  int splits_to_5 = 0;  ///< f of spec-sheets 4.1: least number of splits to curves of valence at most 5
  int splits_to_6 = 0;  ///< the same when curves of valence 6 may remain
  /// Cycles that begin a shortest way to valence 5, one per orbit of the automorphisms, by the numbers of the
  /// vertices in the code. Ascending.
  std::vector<std::vector<int>> cycles;
};

/// Rows by canonical code.
using CutTable = std::map<std::string, CutRow>;

/// Computes the rows of the types and of all that splits within the limits make of them, by exhaustive search over
/// all cycles, every split treating one triangulation (spec-sheets 4.1). Takes seconds of CPU per hundred types.
/// Types that no splits within the limits make curves get no row.
CutTable make_cut_table(const std::vector<SphereTriangulation>& types, const CutLimits& limits = {});
/// The eleven types with valences 3, 4 and 5 only.
std::vector<SphereTriangulation> types_of_valence_345();

/// The table that the program carries: make_cut_table() of types_of_valence_345(), which are the eight nodes of the
/// paper and the curves; tests/hex/make_cut_table.cpp writes it anew.
const CutTable& cut_table();
/// Its text, one row per line: code | splits_to_5 | splits_to_6 | cycles in the letters of the code.
std::string to_text(const CutTable& table);

/// Cycles of the table for this very triangulation: those of its row under all isomorphisms, ascending; empty
/// when the table has no row for it.
std::vector<std::vector<int>> table_cycles(const CutTable& table, const SphereTriangulation& sphere);

/// The general cut (Proposition 1 of the paper, completed in spec-sheets section 5): a cycle through a vertex of
/// degree of at least 6 whose two halves have fewer vertices than the triangulation, or, for the one type without
/// such a cycle, a cycle whose halves are nodes of valence 3, 4 and 5. Throws Error(bad_input) when no vertex has a
/// degree of at least 6.
std::vector<int> general_cut(const SphereTriangulation& sphere);

}  // namespace hexfield
