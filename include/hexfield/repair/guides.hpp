#pragma once

#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "hexfield/repair/unzip_search.hpp"

/// Guides of constrained zipper nodes (spec-lmff section 5.6, "Guides"): feature curves along which an arc is unzipped,
/// and the free path beyond them. Nothing here is collective.
namespace hexfield {

/// A place to follow the field from: a vertex, a tet at it and a chart of reference, here that of the tet where the
/// walk began; `to_start` takes coordinates of the tet's chart there.
struct FlowPlace {
  VertexId vertex;
  TetId tet;
  octahedral::Rotation to_start = octahedral::identity;
};

/// The tets at place.vertex that are connected to place.tet without crossing a feature face, each with the rotation
/// of its chart to the chart of reference; breadth first, in local face order. Singular edges at the vertex make the
/// charts depend on the way, but not the label of an axis that they all keep.
std::vector<FlowPlace> flow_star(const RepairState& state, const FlowPlace& place);

/// Direction in space of a vector of the chart of reference, at the place.
Vec3 in_space(const RepairState& state, const FlowPlace& place, const Vec3& reference);

/// A label of the chart of reference in the chart of the place.
octahedral::Label label_at(const FlowPlace& place, octahedral::Label reference);

struct Guide {
  std::vector<FlowPlace> places;  ///< one per vertex of the curve: the walk from the start to where it ends
  HalfFaceId exit;                ///< boundary face at the last vertex that u leaves through; invalid if there is none
};

/// Walks from `start` along feature edges that run along the label u of its chart, until a vertex with a boundary
/// face whose outward normal label is u, or to the end of such edges. Closed walks end. Among several faces to leave
/// through it takes the one that lies most in the direction `side` (of the chart of start).
Guide walk_guide(const RepairState& state, const FlowPlace& start, octahedral::Label u, const Vec3& side);

}  // namespace hexfield
