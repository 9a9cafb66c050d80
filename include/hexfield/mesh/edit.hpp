#pragma once

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

/// An attribute of the mesh that follows its edits (frames, matchings, features, SH coefficients, ...).
class MeshAttribute {
 public:
  virtual ~MeshAttribute() = default;
  virtual void on_split(const TetMesh& mesh, const SplitRecord& record) = 0;
  /// new_tet[old slot] (invalid for tombstones) after compact().
  virtual void on_compact(const std::vector<TetId>& new_tet) = 0;
};

/// Keeps Features right under splits: both halves of a split feature edge and all children of a split
/// feature face inherit the colour; children of a tet inherit its material.
class FeatureAttribute : public MeshAttribute {
 public:
  explicit FeatureAttribute(Features& features) : features_(features) {}
  void on_split(const TetMesh& mesh, const SplitRecord& record) override;
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

/// Removes tombstones; vertices keep their ids, tets keep their order.
void compact(TetMesh& mesh, const std::vector<MeshAttribute*>& attributes);

}  // namespace hexfield
