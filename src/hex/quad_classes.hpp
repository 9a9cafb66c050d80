#pragma once

#include <vector>

#include "hexfield/hex/hex_complex.hpp"

namespace hexfield::hex {

/// Interior quads joined to their opposites across regular edges (spec-sheets 6.2): maximal straight patches between
/// singular edges and the boundary. A sheet without bends is a union of classes.
struct QuadClasses {
  std::vector<int> class_of;  ///< per quad; -1 on the boundary
  IncidenceLists quads;       ///< per class, ascending
  std::vector<char> usable;   ///< no feature quad, does not cross or touch itself
  IncidenceLists conflicts;   ///< per class: classes that cross it or end at the same boundary edge, ascending
  IncidenceLists rims;        ///< per class: singular edges at which it has one quad or two, ascending
  IncidenceLists special;     ///< per class: its vertices where more than one curve of quads can pass, ascending
};
/// Sheets may bend at the regular edges `bends`, ascending, which then count as singular ones.
QuadClasses build_quad_classes(const HexComplex& complex, const std::vector<int>& feature_quads,
                               const std::vector<int>& bends = {});

}  // namespace hexfield::hex
