#pragma once

#include <vector>

#include "hexfield/field/frame_field.hpp"
#include "hexfield/mesh/edit.hpp"

namespace hexfield {

/// Splits until no tet carries more constraints than a feature face and an edge of it (spec-lmff section 1):
///  1. inner faces with three vertices on feature faces, and feature faces with two or more feature edges, at
///     their centroid;
///  2. edges off feature faces with both ends on feature faces, and edges inside a feature face (not feature
///     edges) with both ends on feature edges, at their midpoint.
/// `attributes` follow the splits; `features` is one that does (FeatureAttribute). Leaves tombstones.
/// Returns the number of splits. Not collective.
int split_for_features(TetMesh& mesh, const Features& features, const std::vector<MeshAttribute*>& attributes);

/// Splits until special edges (feature or singular) are isolated (spec-lmff section 1): faces with three
/// special edges; regular edges between two special vertices; singular non-feature edges with both ends on
/// features. `codes` and `field` must follow through their attributes. Returns the number of splits.
int split_for_singularities(TetMesh& mesh, const Features& features, const EdgeCodes& codes,
                            const std::vector<MeshAttribute*>& attributes);

/// Lets EdgeCodes follow edits: both halves of a split singular edge inherit the code; collapsed edges take the code
/// of the one that is singular (the caller recomputes where both are); the edge of a swap is regular.
class CodesAttribute : public MeshAttribute {
 public:
  explicit CodesAttribute(EdgeCodes& codes) : codes_(codes) {}
  void on_split(const TetMesh& mesh, const SplitRecord& record) override;
  void on_collapse(const TetMesh& mesh, const CollapseRecord& record) override;
  void on_swap(const TetMesh& mesh, const SwapRecord& record) override;
  void on_compact(const std::vector<TetId>& new_tet) override;

 private:
  EdgeCodes& codes_;
};

}  // namespace hexfield
