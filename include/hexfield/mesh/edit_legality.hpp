#pragma once

#include "hexfield/mesh/edit.hpp"

/// What an edit must not break, apart from the field. Nothing here changes the mesh.
namespace hexfield {

/// True when collapsing the edge (from, to) keeps the topology of the mesh, of its boundary, of the feature surfaces
/// and of the feature curves (link conditions on each of them), and `from` leaves no feature: it is no feature
/// point, and when it lies on a curve or surface, so does the edge.
bool collapse_keeps_topology(const TetMesh& mesh, const Features& features, VertexId from, VertexId to);
/// True when every tet that the collapse keeps stays positive.
bool collapse_keeps_positive(const TetMesh& mesh, VertexId from, VertexId to);

/// Faces of the ring of a -> b that are features or boundary, as positions in ring_vertices().
std::vector<int> ring_walls(const Features& features, const EdgeRing& ring, const std::vector<VertexId>& around,
                            VertexId a, VertexId b);
/// True when swap_edge() with this triangulation keeps a simplicial mesh with its features: the edge is no feature
/// edge, the walls are the feature faces of the edge and of one colour, no new edge or face exists already, and
/// (for flipped surfaces) both sides keep tets.
bool swap_keeps_topology(const TetMesh& mesh, const Features& features, const EdgeRing& ring,
                         const std::vector<VertexId>& around, const RingTriangulation& triangulation, VertexId a,
                         VertexId b);
/// True when every tet of the swap is positive.
bool swap_keeps_positive(const TetMesh& mesh, const std::vector<VertexId>& around,
                         const RingTriangulation& triangulation, VertexId a, VertexId b);
/// True when swap_face() at an inner face keeps topology, features and positive tets.
bool can_swap_face(const TetMesh& mesh, const Features& features, HalfFaceId h);

}  // namespace hexfield
