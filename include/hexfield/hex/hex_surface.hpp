#pragma once

#include "hexfield/hex/hex_mesh.hpp"
#include "hexfield/mesh/features.hpp"

namespace hexfield {

/// Shape and features of a hex mesh as tets: twelve around the middle of each hex, vertices of the hex mesh first.
struct HexSurface {
  TetMesh mesh;
  Features features;
};

/// Completes the tags of a hex mesh as complete_features() does for tets: boundary quads, edges sharper than
/// `degrees` and corners get colours of their own where they have none; the tags given stay. Returns the shape, on
/// which improve_hex_mesh() can slide vertices and check_against() can judge.
HexSurface complete_hex_features(HexMesh& mesh, double degrees = default_feature_angle_degrees);

}  // namespace hexfield
