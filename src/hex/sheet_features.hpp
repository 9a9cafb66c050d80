#pragma once

#include <map>
#include <vector>

#include "hexfield/hex/sheet.hpp"

namespace hexfield::hex {

/// Where vertices go when a mesh is cut along a sheet, or along its whole boundary by a layer outside it.
struct SheetMap {
  std::vector<int> twin;       ///< per old vertex: its new twin, -1 when it has none
  std::vector<int> b_corners;  ///< 8 hex + corner that take the twin, ascending
  std::vector<char> on_sheet;  ///< per edge of the complex

  /// New vertex of corner `vertex` of a hex.
  int image(const HexMesh& mesh, int hex, int vertex) const;
};

/// Carries the feature entities of `before` to `after`, whose points and hexes are those after the inflation (see
/// inflate_sheet()). Throws Error(bad_input) when a corner or a seam of surfaces would be torn apart.
void carry_over_sheet(const HexMesh& before, const HexComplex& complex, const SheetMap& map, HexMesh& after);

/// The same for a layer outside the whole boundary: features of the boundary move to the twins, surfaces and lines
/// inside that end there are prolonged.
void carry_to_padding(const HexMesh& before, const HexComplex& complex, const SheetMap& map, HexMesh& after);

}  // namespace hexfield::hex
