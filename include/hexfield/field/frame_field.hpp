#pragma once

#include <array>
#include <map>
#include <vector>

#include "hexfield/base/octahedral.hpp"
#include "hexfield/mesh/edit.hpp"
#include "hexfield/mesh/tet_mesh.hpp"

namespace hexfield {

/// Piecewise constant octahedral field: one frame per tet and one matching per half-face.
///
/// matchings[t][i] is M_tj across half-face (t, i) to tet j, F_t M_tj close to F_j; the opposite half-face
/// carries the inverse; identity on the boundary. See base/octahedral.hpp for the conventions.
struct FrameField {
  std::vector<Quaternion> frames;
  std::vector<std::array<octahedral::Rotation, 4>> matchings;

  octahedral::Rotation matching(HalfFaceId h) const {
    return matchings[h.tet().index()][static_cast<std::size_t>(h.local())];
  }
};

/// Lets a FrameField follow edits. Splits: children inherit the frame and the outer matchings, inner faces identity.
/// Collapses: two faces that become one get the product of their matchings. Swaps: everything in the chart of the
/// first old tet, where the new tets share the mean frame; inner faces identity. Monodromies of all edges that
/// an edit neither makes nor merges stay; the edge of a swap must be regular.
class FieldAttribute : public MeshAttribute {
 public:
  explicit FieldAttribute(FrameField& field) : field_(field) {}
  void on_split(const TetMesh& mesh, const SplitRecord& record) override;
  void on_collapse(const TetMesh& mesh, const CollapseRecord& record) override;
  void on_swap(const TetMesh& mesh, const SwapRecord& record) override;
  void on_compact(const std::vector<TetId>& new_tet) override;

 private:
  FrameField& field_;
};

/// Singular code of an edge: number of quad sectors minus 4 (interior) or minus 2 (boundary).
using EdgeCode = int;
inline constexpr EdgeCode compound_code = 1000;
inline constexpr EdgeCode undetermined_code = 1001;

/// Non-zero codes only. An edge that is not listed is regular.
using EdgeCodes = std::map<EdgeKey, EdgeCode>;

/// An axis that must keep its direction in one tet: frame * direction(label) = +direction.
struct AxisConstraint {
  enum class Kind { feature_face, feature_edge, singular_edge };
  TetId tet;
  octahedral::Label label;
  Vec3 direction;  ///< unit: outward face normal, or edge direction from the lower to the higher vertex id
  Kind kind;
  HalfFaceId face;  ///< for feature_face
  EdgeKey edge{};   ///< for edges
};

}  // namespace hexfield
