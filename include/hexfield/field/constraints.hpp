#pragma once

#include <span>
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

/// Where the sign of the axis of a singular edge comes from.
enum class SingularSign {
  by_code,      ///< the outgoing label: fixed by monodromy and code
  by_geometry,  ///< the sign that turns the frames least; codes may follow later (spec-lmff section 4)
};

/// The constraints of these tets (ascending) only, at the cost of these tets. Edges are taken when one of the tets
/// has them; by_geometry leaves the codes out of the choice of signs. Not collective.
std::vector<AxisConstraint> collect_constraints_of(const TetMesh& mesh, const Features& features,
                                                   const FrameField& field, const EdgeCodes& codes,
                                                   std::span<const TetId> tets, SingularSign sign);

}  // namespace hexfield
