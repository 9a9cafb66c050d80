#pragma once

#include "fixed_map.hpp"
#include "hexfield/hex/hex_mesh.hpp"
#include "hexfield/mesh/features.hpp"

namespace hexfield::hex {

/// The hexes of an exact map. Without `open` they fill the map, else Error(bad_hex_mesh); with it (per half-face:
/// another tet belongs there, but is missing) those that are not whole are left out, and their features.
HexMesh assemble(const TetMesh& mesh, const Features& features, const FixedMap& fixed, const std::vector<char>* open);

}  // namespace hexfield::hex
