#pragma once

#include "hexfield/base/control.hpp"
#include "hexfield/hex/hex_mesh.hpp"
#include "hexfield/mesh/features.hpp"

namespace hexfield {

struct ImproveOptions {
  int max_rounds = 50;
};

/// Stage 8: raises the minimum scaled Jacobian by moving vertices: boundary vertices slide on the input
/// surface of their colour, curve vertices on their curve, feature vertices stay. A positive hex never
/// becomes non-positive. The same bytes for any number of threads. Not collective.
void improve_hex_mesh(HexMesh& hexes, const TetMesh& mesh, const Features& features, const ImproveOptions& options,
                      const Control& control);

}  // namespace hexfield
