#pragma once

#include <array>
#include <utility>
#include <vector>

#include "hexfield/mesh/features.hpp"
#include "hexfield/mesh/tet_mesh.hpp"

namespace hexfield {

/// Where a half-face of a new tet comes from.
struct NewHalfFace {
  HalfFaceId half_face;
  /// The old half-face it is (part of); invalid for faces that are new inside an old tet.
  HalfFaceId origin;
};

/// What one split did; the only way an attribute learns of it. Old tets are tombstones by now, but
/// their attributes can still be read by slot; origin_face() gives the vertices of an old face.
///
/// Every old tet that has all parents is replaced by one child per parent: the tet with that parent
/// replaced by the new vertex, at the same local index. Children of one old tet are consecutive, in the
/// order of `parents`.
struct SplitRecord {
  VertexId new_vertex;
  std::vector<VertexId> parents;                  ///< the new vertex is their mean: 2, 3 or 4 vertices, ascending
  std::vector<std::pair<TetId, TetId>> child_of;  ///< (new tet, old tet), ascending in the new tet
  std::vector<NewHalfFace> half_faces;            ///< all four half-faces of every new tet, ascending
};

/// The vertices of the old face that `half_face` (with a valid origin) is or is part of.
FaceKey origin_face(const TetMesh& mesh, const SplitRecord& record, const NewHalfFace& half_face);

/// What the collapse of the edge (from, to) did. Tets at both ends are tombstones (attributes still readable by
/// slot); the other tets at `from` keep their slot and have `to` in its place.
struct CollapseRecord {
  VertexId from, to;
  /// Of every removed tet: the faces that became one. Each is a half-face of the removed tet with what was
  /// beyond it (invalid on the boundary); now the two beyond are opposite to each other.
  struct Merged {
    HalfFaceId at_from, beyond_from;  ///< the face at `from`, opposite to `to`
    HalfFaceId at_to, beyond_to;      ///< the face at `to`, opposite to `from`
  };
  std::vector<Merged> merged;
  std::vector<TetId> moved;          ///< tets in which `to` replaced `from`, ascending
  std::vector<VertexId> neighbours;  ///< all x of old edges (from, x) but `to`, ascending
  std::vector<EdgeKey> link;         ///< all (x, y) of old faces (from, x, y), ascending; `to` may be one of them
};

/// What an edge or face swap did: `removed` tets are tombstones (attributes still readable by slot), the tets
/// `added` fill the same space.
struct SwapRecord {
  EdgeKey removed_edge;        ///< invalid ids after a face swap
  std::vector<TetId> removed;  ///< around the edge in the order of its ring
  /// Half-faces between removed tets, one side each, in an order that reaches all of them from removed[0];
  /// a closed ring lists one more than that needs: the last one comes back to removed[0].
  std::vector<std::pair<HalfFaceId, HalfFaceId>> crossings;
  /// (new tet, old tet on the same side of all feature faces), ascending in the new tet.
  std::vector<std::pair<TetId, TetId>> added;
  std::vector<NewHalfFace> half_faces;  ///< all four half-faces of every new tet, ascending
  /// Surface edges: (old face, the face that takes its place).
  std::vector<std::pair<FaceKey, FaceKey>> flipped;
};

/// An attribute of the mesh that follows its edits (frames, matchings, features, SH coefficients, ...).
class MeshAttribute {
 public:
  virtual ~MeshAttribute() = default;
  virtual void on_split(const TetMesh& mesh, const SplitRecord& record) = 0;
  /// Attributes that do not say how they follow a collapse or swap throw Error(bug).
  virtual void on_collapse(const TetMesh& mesh, const CollapseRecord& record);
  virtual void on_swap(const TetMesh& mesh, const SwapRecord& record);
  /// new_tet[old slot] (invalid for tombstones) after compact().
  virtual void on_compact(const std::vector<TetId>& new_tet) = 0;
};

/// Keeps Features right under edits: both halves of a split feature edge and all children of a split
/// feature face inherit the colour, children of a tet its material; collapsed edges and faces take the colour of
/// the one that is a feature; a swap at a surface edge flips the two feature faces.
class FeatureAttribute : public MeshAttribute {
 public:
  explicit FeatureAttribute(Features& features) : features_(features) {}
  void on_split(const TetMesh& mesh, const SplitRecord& record) override;
  void on_collapse(const TetMesh& mesh, const CollapseRecord& record) override;
  void on_swap(const TetMesh& mesh, const SwapRecord& record) override;
  void on_compact(const std::vector<TetId>& new_tet) override;

 private:
  Features& features_;
};

/// Splits the edge (a, b) at its midpoint; every tet around it becomes two. At a non-manifold edge only
/// the fan found by find_tet_with_edge() is split (see find_non_manifold() in mesh/manifold.hpp).
/// Throws Error(bug) when there is no such edge. Returns the new vertex.
VertexId split_edge(TetMesh& mesh, VertexId a, VertexId b, const std::vector<MeshAttribute*>& attributes);
/// Splits the face of `h` at its centroid: the one or two tets at it become three each. Returns the new vertex.
VertexId split_face(TetMesh& mesh, HalfFaceId h, const std::vector<MeshAttribute*>& attributes);
/// Splits a tet at its centroid into four. Returns the new vertex.
VertexId split_tet(TetMesh& mesh, TetId t, const std::vector<MeshAttribute*>& attributes);

/// Collapses the edge (from, to) onto `to`, which keeps its place; `from` becomes a vertex without tets.
/// Legality is up to the caller (mesh/edit_legality.hpp). Throws Error(bug) when there is no such edge or two
/// tets would become one.
void collapse_edge(TetMesh& mesh, VertexId from, VertexId to, const std::vector<MeshAttribute*>& attributes);

/// Triangulation of the polygon of vertices around an edge: r_k is the vertex besides a and b where tets k - 1
/// and k of edge_ring(a -> b) meet; an open ring of n tets has n + 1 of them.
struct RingTriangulation {
  std::vector<std::array<int, 3>> triangles;  ///< positions, ascending in each: number of vertices - 2 of them
  /// Positions whose faces with the edge are feature faces (boundary faces included), else -1. Their diagonal
  /// must be an edge of the triangulation: it takes the place of the edge in the surface.
  std::array<int, 2> walls{-1, -1};
};

/// Vertices r_k around a -> b for its ring, see RingTriangulation.
std::vector<VertexId> ring_vertices(const TetMesh& mesh, const EdgeRing& ring, VertexId a, VertexId b);

/// Replaces the tets around a -> b by two per triangle, one with each end: 3-2, 4-4, 5-6, ... swaps. At a boundary
/// edge the walls must be the two ends of the open ring. `seed`: a tet with the edge. Legality is up to the caller.
void swap_edge(TetMesh& mesh, TetId seed, VertexId a, VertexId b, const RingTriangulation& triangulation,
               const std::vector<MeshAttribute*>& attributes);
/// 2-3 swap: replaces an inner face by the edge between the two vertices opposite to it.
void swap_face(TetMesh& mesh, HalfFaceId h, const std::vector<MeshAttribute*>& attributes);

/// Removes tombstones; vertices keep their ids, tets keep their order.
void compact(TetMesh& mesh, const std::vector<MeshAttribute*>& attributes);

}  // namespace hexfield
