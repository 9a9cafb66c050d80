#pragma once

#include <vector>

#include "hexfield/map/alignments.hpp"
#include "hexfield/map/conforming_space.hpp"
#include "integer_lattice.hpp"

namespace hexfield {

/// A length that must not collapse when the map is rounded: form (over the integer unknowns, numbered from
/// 0) evaluates to `length` > 0 in the seamless map and must stay at least 1.
struct Spacing {
  LinearForm form;
  double length = 0;
  VertexId where;
};

/// Lengths of the map with unknowns y that rounding must keep (a stand-in for the separation search of
/// spec-quantization 4.4, for maps without a motorcycle complex):
///  * links: chains of feature and singular edges between points where all coordinates are integer;
///  * thickness: from every feature and boundary face, and sideways from every feature and singular edge,
///    straight along an axis to the next face of constant coordinate on that axis, or past an arc.
/// One entry per distinct form. Charts are combed.
std::vector<Spacing> required_spacings(const TetMesh& mesh, const ConformingSpace& space, const Alignments& alignments,
                                       std::span<const double> y);

}  // namespace hexfield
