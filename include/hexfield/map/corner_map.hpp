#pragma once

#include <array>
#include <vector>

#include "hexfield/base/octahedral.hpp"
#include "hexfield/mesh/tet_mesh.hpp"

namespace hexfield {

/// A map of the tets of a TetMesh (no tombstones) into parameter space, one chart per tet: a seamless map,
/// or an integer-grid map when transitions, features and singular arcs are integer.
///
/// Across half-face (t, i) to tet j: f_j = R f_t + translation with R = rotation(h), the inverse of the
/// matching M_tj. The opposite half-face carries the inverse. Identity and zero on the boundary.
struct CornerMap {
  std::vector<std::array<Vec3, 4>> uvw;                        ///< per tet and local vertex
  std::vector<std::array<octahedral::Rotation, 4>> rotations;  ///< rotation part of the transitions

  octahedral::Rotation rotation(HalfFaceId h) const {
    return rotations[h.tet().index()][static_cast<std::size_t>(h.local())];
  }
};

using SeamlessMap = CornerMap;
using IntegerGridMap = CornerMap;

/// f_j - R f_t at the first vertex of face h: the translation of the transition out of tet h.tet().
Vec3 transition_translation(const TetMesh& mesh, const CornerMap& map, HalfFaceId h);

/// What verify_map() found.
struct MapReport {
  std::vector<TetId> inverted;       ///< tets with det <= 0 or not finite
  std::vector<EdgeKey> wrong_edges;  ///< image angle differs from the expected one by > 0.1 quarter-turn
  double max_residual = 0;           ///< largest |f_j - (R f_t + t)| and misalignment, in parameter units
  static constexpr double residual_tolerance = 1e-6;
  bool valid() const { return inverted.empty() && wrong_edges.empty() && max_residual <= residual_tolerance; }
};

}  // namespace hexfield
