#pragma once

#include <span>
#include <vector>

#include "hexfield/field/align_field.hpp"
#include "hexfield/field/constraints.hpp"
#include "hexfield/mesh/edit.hpp"
#include "hexfield/repair/repair_state.hpp"

/// What every operation of the repair is made of: splits that all values of a RepairState follow, changes of
/// matchings on both sides of a face, codes and frames brought up to date on a few edges or tets. All of it costs
/// what the named edges or tets cost, never the whole mesh. Nothing here is collective.
namespace hexfield {

/// Lets everything in a RepairState follow edits: features, frames and matchings, codes, pairs, kept edges
/// and target lengths (mean of the parents of a new vertex). Where a collapse makes two singular edges one, the
/// code is that of one of them: the caller computes it again.
class StateAttributes {
 public:
  explicit StateAttributes(RepairState& state);
  const std::vector<MeshAttribute*>& all() const { return all_; }

 private:
  class RepairValues : public MeshAttribute {
   public:
    explicit RepairValues(RepairState& state) : state_(state) {}
    void on_split(const TetMesh& mesh, const SplitRecord& record) override;
    void on_collapse(const TetMesh& mesh, const CollapseRecord& record) override;
    void on_swap(const TetMesh& mesh, const SwapRecord& record) override;
    void on_compact(const std::vector<TetId>&) override {}

   private:
    RepairState& state_;
  };
  FeatureAttribute features_;
  FieldAttribute field_;
  RepairValues values_;
  std::vector<MeshAttribute*> all_;
};

/// The splits of mesh/edit.hpp on a whole state. The new vertex is returned.
VertexId split_edge(RepairState& state, VertexId a, VertexId b);
VertexId split_face(RepairState& state, HalfFaceId h);
VertexId split_tet(RepairState& state, TetId t);
/// The collapse and the swap of mesh/edit.hpp on a whole state; legality is up to the caller.
void collapse_edge(RepairState& state, VertexId from, VertexId to);
void swap_edge(RepairState& state, TetId seed, VertexId a, VertexId b, const RingTriangulation& triangulation);
/// Removes tombstones of tets.
void compact(RepairState& state);

/// Sets the matching across h in the chart of h.tet(), and its inverse on the other side. h is an inner face.
void set_matching(RepairState& state, HalfFaceId h, octahedral::Rotation matching);

/// A boundary face or a tagged one.
bool is_feature_face(const RepairState& state, HalfFaceId h);
/// Is the vertex, or the edge (that of a ring), part of such a face?
bool on_feature_face(const RepairState& state, VertexId v);
bool in_feature_face(const RepairState& state, const EdgeRing& ring);
bool in_feature_face(const RepairState& state, const EdgeKey& edge);
/// Is the vertex the end of a feature edge; or that or a feature point?
bool on_feature_edge(const RepairState& state, VertexId v);
bool on_feature_curve(const RepairState& state, VertexId v);
/// A feature edge, or one whose code is not zero.
bool is_special(const RepairState& state, const EdgeKey& edge);
EdgeCode code_of(const RepairState& state, const EdgeKey& edge);
bool on_boundary(const TetMesh& mesh, VertexId v);

inline VertexId other_end(const EdgeKey& edge, VertexId v) { return edge[0] == v ? edge[1] : edge[0]; }
/// The vertices of these tets, ascending.
std::vector<VertexId> vertices_of(const TetMesh& mesh, std::span<const TetId> tets);
/// An id that no pair of arcs has yet.
int new_pair(const RepairState& state);

/// The edges of these tets, ascending.
std::vector<EdgeKey> edges_of(const TetMesh& mesh, std::span<const TetId> tets);
/// The edges at v, ascending by their other end.
std::vector<EdgeKey> edges_at(const TetMesh& mesh, VertexId v);
/// Those with a code.
std::vector<EdgeKey> singular_edges_at(const RepairState& state, VertexId v);
/// The vertices after v of the arc that leaves it by `edge`, as far as it has no branches, at most `steps`.
std::vector<VertexId> along_arc(const RepairState& state, VertexId v, EdgeKey edge, int steps);
/// Ring of a -> b from a tet found at a.
EdgeRing ring_of(const TetMesh& mesh, VertexId a, VertexId b);

/// Computes the codes of these edges again from frames and matchings; edges that are gone lose theirs.
void update_codes(RepairState& state, std::span<const EdgeKey> edges);
/// The same for edges of which a tet is known.
void update_codes(RepairState& state, std::span<const std::pair<EdgeKey, TetId>> edges);

/// Algorithm 1 on these tets only (spec-lmff section 4), aligned to features and singular edges; the frames of
/// other tets are boundary values. `sign` says how the axes of singular edges get their sign.
AlignReport smooth(RepairState& state, std::span<const TetId> tets, int sweeps,
                   SingularSign sign = SingularSign::by_geometry);

/// The same, aligned to features only: what singular edges shall follow.
AlignReport smooth_to_features(RepairState& state, std::span<const TetId> tets, int sweeps);

/// Everything that must always hold: the checks of mesh, features, field and graph, and sizes.
std::vector<Violation> check(const RepairState& state);

}  // namespace hexfield
