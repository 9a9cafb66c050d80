#pragma once

#include <vector>

#include "hexfield/repair/repair_state.hpp"

namespace hexfield {

/// Regular vertices of feature curves (two feature edges of one code, in line where the vertex is a feature point) at
/// which exactly one singular arc of the inside ends, ascending. Such an arc has the coordinates of the curve in every
/// map, along its whole length: where its other end lies beside another curve of the same plane, no injective map
/// exists although every one-ring has one.
std::vector<VertexId> ends_on_curves(const RepairState& state);

/// Is v such an end whose arc arrives parallel to one face of a reentrant curve, and against the normal of the other
/// (spec-lmff section 5.6, the concave cases of constrained zipper nodes)? Its streamline goes on inside, where the arc
/// does not, and both have the coordinates of the parallel face: the one-ring has no map, though counts allow it.
bool is_zipper_on_curve(const RepairState& state, VertexId v);

/// Moves the end of the arc off the curve into the feature face that it is perpendicular to (DT1 of a
/// boundary-truncated sector), so that curve and arc get coordinates of their own. Editable must be
/// all tets that touch the tets at v. False when there is no such face or a vertex there would need repair; `local`
/// is then as it was.
bool free_arc_end(RepairState& local, VertexId v);

}  // namespace hexfield
