#pragma once

#include "cells.hpp"
#include "hexfield/hex/hex_mesh.hpp"
#include "hexfield/mesh/features.hpp"

namespace hexfield::hex {

/// Feature points, lines and quads of the hex mesh: each side of a hex is known by its slot (hex, direction),
/// never by its vertices, so that coarse meshes with several edges or faces between the same vertices come
/// out right. Also asserts that the boundary of the map is covered by hex sides exactly once.
/// Throws Error(bad_hex_mesh) naming the feature or boundary simplex that is not on the lattice.
/// `partial`: features on tets or hexes that are missing are left out, and nothing is asserted.
void carry_features(const TetMesh& mesh, const Features& features, const FixedMap& map, const VertexTets& star,
                    const LatticeVertices& vertices, const Cells& cells, HexMesh& out, bool partial = false);

}  // namespace hexfield::hex
