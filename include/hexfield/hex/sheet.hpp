#pragma once

#include <array>
#include <string>
#include <vector>

#include "hexfield/hex/hex_complex.hpp"

namespace hexfield {

/// The two sides of a sheet of quads (spec-sheets section 3): side A of quad k is hex a_hex[k]; side B is the other.
struct SheetSides {
  std::vector<int> quads;      ///< ascending
  std::vector<int> a_hexes;    ///< per quad: its hex on side A
  std::vector<int> vertices;   ///< of the sheet, ascending
  std::vector<int> b_corners;  ///< 8 hex + corner of all corners at vertices of the sheet on side B, ascending
  std::string defect;          ///< why the quads are no sheet; then nothing else is meant
  int defect_vertex = -1;      ///< where the defect is at one vertex
};

/// Sides of a set of quads that has to be a sheet: interior quads without feature, connected, a surface with its
/// boundary in the boundary of the mesh, two-sided, and at each of its vertices one curve that cuts the hexes there
/// in exactly two parts. Side A is that of hex 0 when the sheet separates the mesh, else that of the lower hex of
/// the lowest quad. `feature_quads` are quads of the complex that no sheet may hold, ascending.
SheetSides sheet_sides(const HexMesh& mesh, const HexComplex& complex, std::vector<int> quads,
                       const std::vector<int>& feature_quads);
/// Quads of the complex that carry a feature of the mesh, ascending. Those not in the complex are left out.
std::vector<int> feature_quads_of(const HexMesh& mesh, const HexComplex& complex);

/// What an inflation made. The vertices of the mesh before keep their ids on side A; vertex old_vertices + k is the
/// twin of `twin_of[k]` on side B. Hexes before keep their ids; hex old_hexes + k is quad k of the sheet, its first
/// four vertices on side A.
struct Inflation {
  HexMesh mesh;
  std::vector<int> twin_of;  ///< ascending
};

/// Thickens a sheet to a layer of hexes (section 2.2 of the paper). Twins move apart by `gap` of the way to the
/// middle of the hexes on their side; on the boundary along its quads, on feature lines along them.
/// Colours are carried: a feature surface that the sheet cuts gets a strip of quads, a feature line an edge; a line
/// along the sheet stays with the side that its surfaces need; a corner stays where more of its lines are. New hexes
/// have the material of side A. Throws Error(bad_input) with the reason when the quads are no sheet or a
/// corner or a seam of surfaces would be torn apart; its first id is the vertex where the reason is at one.
Inflation inflate_sheet(const HexMesh& mesh, const HexComplex& complex, std::vector<int> quads, double gap = 0.25);

/// The hexes that are crossed by the edges parallel to an edge: opposite in a quad, again and again.
struct HexSheet {
  std::vector<int> edges;  ///< ascending
  std::vector<int> hexes;  ///< ascending
  bool simple = true;      ///< no hex is crossed twice and no two of its edges share a vertex
};
HexSheet sheet_of_edge(const HexMesh& mesh, const HexComplex& complex, int edge);

/// Inverse of inflate_sheet(): the two ends of each edge of the sheet become one vertex, at their middle or, where
/// only one of them is held by a feature, at that one. The lower vertex stays; ids move down where something is
/// removed. collapse(inflate) is the mesh before. Throws Error(bad_input) with the reason when the sheet is not
/// simple, when the result is no hex mesh, or when different features would meet.
HexMesh collapse_sheet(const HexMesh& mesh, const HexComplex& complex, const HexSheet& sheet);

/// One layer of hexes along the whole boundary, so that singular boundary edges come to lie inside; the surface
/// does not move. The old boundary vertices go inwards by `depth` of the way to the middle of their hexes; the new
/// ones have the next ids. Colours are carried as by inflate_sheet().
HexMesh pad(const HexMesh& mesh, const HexComplex& complex, double depth = 0.4);

}  // namespace hexfield
