#pragma once

#include "hexfield/repair/repair_state.hpp"

/// Arcs that have to meet. Where three arcs of code -1 come together at a rounded corner, the smooth field may let one
/// of them turn into the direction of the second and the third end on the surface beside the bend. Every one-ring has a
/// map then, but the two legs of the bend and the third arc have all three coordinates of one point, and in no
/// injective map two arcs share a point. They become one node of four arcs. Nothing here is collective.
namespace hexfield {

/// Contracts the shortest edge path from p, an inner vertex of one arc, to q, one of another, so that q becomes a node.
/// False, and the state is as it was, where no path of a few edges is free, where tets would turn over, or where q
/// would be no node or have no map. Copies the state: meant for a Neighbourhood whose editable tets are those within
/// two rings of p and q.
bool merge_arcs(RepairState& local, VertexId p, VertexId q);

/// merge_arcs() wherever an arc of code -1 bends by more than 60 degrees beside another one that ends on the surface
/// there. Returns the number of nodes made.
int merge_crossing_arcs(RepairState& state);

}  // namespace hexfield
