#pragma once

#include "hexfield/base/control.hpp"
#include "hexfield/hex/hex_mesh.hpp"
#include "hexfield/mesh/features.hpp"

namespace hexfield {

/// Parameters of stage 8. A sweep visits every active vertex once.
struct ImproveOptions {
  int max_rounds = 50;            ///< sweeps that raise the minimum
  int max_untangle_rounds = 200;  ///< sweeps around non-positive hexes, only while there are any
  int smoothing_rounds = 5;       ///< sweeps over all vertices before the minimum is raised
  double shape_weight = 0.1;      ///< of the mean ratio beside the inverse scaled Jacobian; keeps edges from collapsing
  double good_enough = 0.7;  ///< hexes of at least this scaled Jacobian are not worked on when the minimum is raised
};

/// Stage 8: raises the minimum scaled Jacobian by moving vertices: boundary vertices slide on the input
/// surface of their colour, curve vertices on their curve, feature vertices stay. A positive hex never
/// becomes non-positive. The same bytes for any number of threads. Not collective.
///
/// Each vertex takes Newton steps on an energy of the corners it touches: the inverse scaled Jacobian to a
/// power that grows from sweep to sweep, so that the worst corner decides, and the mean ratio; determinants
/// are regularised as by Garanzha et al., Foldover-free maps in 50 lines of code (2021), until all are
/// positive. Vertices of one colour class share no hex and move at once.
/// Throws Error(stopped) at the end of a sweep when the control asks for it; `hexes` is then the iterate.
void improve_hex_mesh(HexMesh& hexes, const TetMesh& mesh, const Features& features, const ImproveOptions& options,
                      const Control& control);

}  // namespace hexfield
