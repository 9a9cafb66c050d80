#pragma once

#include "hexfield/repair/repair_state.hpp"

/// Repairs of singular edges (Liu & Bommes 2023 section 5.2 "Establishing Meshable Edges"; spec-lmff section 5.4).
/// Each works on the tets at the edge, its ends and their neighbours only, returns whether it mended something, and
/// leaves the field as it was when it did not: it may have refined the mesh then. Nothing here is collective.
namespace hexfield {

/// The isolation split of spec-lmff section 1 for the one-ring of v: afterwards features and arcs that are not at v
/// are not in its one-ring either, as far as splits can do it. Returns the number of splits.
int split_one_ring(RepairState& state, VertexId v);

/// D1: an inner edge with a monodromy about two axes is unzipped on one triangle at it, such that it keeps a
/// quarter-turn and the new arc of two edges takes another one. Half-turns about edge diagonals are no product of two
/// quarter-turns: there the edge keeps a half-turn, which lower_index() mends. Of all triangles at the edge and all
/// factorisations the one that leaves the least turning around the edge is taken.
bool repair_compound_edge(RepairState& state, const EdgeKey& edge);

/// A compound edge is contracted: often it is all that keeps two halves of a node apart. One of its ends takes the place
/// of the other, where the remeshing may do that (remesh.hpp) and what comes about is a node that hex meshes have, or
/// has compound edges left.
bool contract_compound_edge(RepairState& state, const EdgeKey& edge);

/// An inner edge of |code| >= 2 gives one quarter-turn to a new arc of two edges, such that |code| drops by one.
bool lower_index(RepairState& state, const EdgeKey& edge);

/// D4: unzips a quarter-turn inside a sector between feature faces that holds no quad, so that it holds one more, and
/// inside one of four or more quads, so that it holds one less where the edge has |code| >= 2. One sector per call.
bool repair_sectors(RepairState& state, const EdgeKey& edge);

/// D2 on feature surfaces: an arc whose axis is the normal of a surface passes through it at a point, so an edge that
/// runs inside the surface is unzipped into a tet at its side: the edge gets regular, the arc two edges longer.
bool lift_from_surface(RepairState& state, const EdgeKey& edge);

/// Makes the three singular edges of an inner triangle regular by one matching, if that does it.
bool remove_singular_triangle(RepairState& state, const FaceKey& face);

/// Puts a vertex of the boundary that is on no feature curve one layer below the surface (paper section 5.2; spec-lmff
/// section 5.4, "Boundary arcs off features: push inside"): a new vertex takes over its place and the surface. Singular
/// edges that v has on the surface are inside afterwards and keep their codes; an arc that came to v across the surface
/// goes on to the new vertex. False, and the state is as it was, where codes beyond +-1 or compound ones meet v, or
/// no place below makes all tets positive. Copies the state: meant for a Neighbourhood. Frames are not smoothed.
bool push_inside(RepairState& state, VertexId v);

/// push_inside() for all vertices of all arcs that run along smooth surfaces, such that whole arcs go inside and stay
/// on the surface only where they end on feature curves: connected arcs on boundary edges whose mean dihedral angle is
/// within 45 degrees of flat, and inner arcs that touch the surface without crossing it. Returns the number of
/// vertices pushed.
int push_arcs_inside(RepairState& state);

/// Puts a vertex of a feature surface inside the domain, on no feature curve, to the side of the surface where `side`,
/// a tet at it, lies: a new vertex takes over its place, the surface and all tets beyond. Singular edges that v has in
/// the surface are at its side afterwards and keep their codes; an arc that came to v from beyond goes on through the
/// new vertex. False, and the state is as it was, where v has more than one arc beyond, where the surface would not be
/// flat for the field at the new vertex, or where no place at the side makes all tets positive. Copies the state: meant
/// for a Neighbourhood. Frames are not smoothed.
bool push_off_surface(RepairState& state, VertexId v, TetId side);

/// push_off_surface() for all vertices of arcs that run in feature surfaces although their axis is the normal
/// (see lift_from_surface()): each arc from end to end to one side, the one where more of its ends lie, so that it
/// crosses the surface once or not at all; edge by edge it would change sides at every vertex. Also vertices where an
/// arc touches a surface without crossing it. Returns the number of vertices pushed.
int lift_arcs_from_surfaces(RepairState& state);

/// What repair_edges() did.
struct EdgeRepairCounts {
  int contracted = 0, compound = 0, index = 0, sectors = 0, lifted = 0, triangles = 0, pushed = 0;
  int total() const { return contracted + compound + index + sectors + lifted + triangles + pushed; }
};

/// Which of them repair_edges() applies. Stage I of the schedule leaves compound edges inside to shrink (section 5.7).
struct EdgeRepairOptions {
  bool contract = true, compound = true, compound_inside = true, index = true, sectors = true, lift = true, triangles = true, push = true;
  int rounds = 6;  ///< at most; ends when a round mends nothing
};

/// Applies them to all edges of the state, in key order, on disjoint places at the same time. The result does not
/// depend on the number of threads.
EdgeRepairCounts repair_edges(RepairState& state, const EdgeRepairOptions& options = {});

}  // namespace hexfield
