#pragma once

#include <vector>

#include "hexfield/field/spherical_harmonics.hpp"
#include "hexfield/mesh/edit.hpp"

namespace hexfield {

/// Harmonics vectors per vertex; a new vertex gets the frame closest to the sum of its parents.
class VertexShAttribute : public MeshAttribute {
 public:
  explicit VertexShAttribute(std::vector<harmonics::Sh>& sh) : sh_(sh) {}
  void on_split(const TetMesh& mesh, const SplitRecord& record) override;
  void on_compact(const std::vector<TetId>&) override {}

 private:
  std::vector<harmonics::Sh>& sh_;
};

struct RefinementReport {
  int splits = 0;
  bool capped = false;  ///< the limit of splits ended it
};

/// Splits the longest edge of singular faces (closest matchings around the three vertex frames do not
/// compose to the identity) while it is longer than `edge_factor` times the mean edge of the mesh; first in,
/// first out, at most `max_splits` (spec-lmff section 2). Leaves tombstones. Not collective.
RefinementReport refine_singular_faces(TetMesh& mesh, std::vector<harmonics::Sh>& vertex_sh, double edge_factor,
                                       int max_splits, std::vector<MeshAttribute*> attributes);

/// Frame per tet slot: closest to the sum of the vectors of its four vertices.
std::vector<Quaternion> tet_frames(const TetMesh& mesh, const std::vector<harmonics::Sh>& vertex_sh);

}  // namespace hexfield
