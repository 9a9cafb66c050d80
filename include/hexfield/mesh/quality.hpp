#pragma once

#include "hexfield/mesh/tet_mesh.hpp"

namespace hexfield {

/// tr(J^T J)^3 / det(J)^2 with J the Jacobian that maps the regular tet to (a, b, c, d): 27 for a regular tet of any
/// size, infinite for tets that are not positive.
double tet_distortion(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
double tet_distortion(const TetMesh& mesh, TetId t);
/// log(tr(J^T J) / det(J)^{2/3}), the quality energy of spec-lmff section 6: a third of the logarithm of the
/// distortion, log 3 at its best.
double log_energy(double distortion);

/// Sum of the volumes of all alive tets, in their order.
double total_volume(const TetMesh& mesh);

}  // namespace hexfield
