#pragma once

#include <vector>

#include "hexfield/field/frame_field.hpp"
#include "hexfield/mesh/features.hpp"

namespace hexfield {

/// All axes that frames and maps must keep, ordered by tet, then faces before edges:
///  * feature and boundary faces, in each tet at them: the label closest to the outward normal;
///  * feature edges, in every tet around them: one label transported by the matchings, perpendicular to the
///    labels of the feature faces there, chosen such that it is closest on average; the rotation axis where
///    the edge is singular;
///  * singular edges (codes != 0): the outgoing label, whose sign follows the code, transported likewise.
/// An edge without a consistent label (compound monodromy) yields no constraint. An edge that is both
/// feature and singular is listed once, as feature edge. Not collective.
std::vector<AxisConstraint> collect_constraints(const TetMesh& mesh, const Features& features, const FrameField& field,
                                                const EdgeCodes& codes);

}  // namespace hexfield
