#pragma once

#include "hexfield/field/frame_field.hpp"
#include "hexfield/mesh/features.hpp"

namespace hexfield {

/// Feature edges whose dihedral angle lies near 45, 135, 225 or 315 degrees can be meshed with one quad sector more or
/// less, and a smooth field takes now this, now that along one curve, with a singular edge of opposite code beside
/// every other piece, or with an arc that runs now on the curve, now inside. Where one code prevails, the whole curve
/// gets it. Elsewhere quarter-turns about such edges take back, face by face, what makes the edges of the face less
/// singular (sum of the absolute codes); then every curve gets one code along such edges: that of its other edges, or
/// else the one whose quads come nearest to right angles. Matchings and codes follow; frames stay. Returns the number
/// of faces changed. Not collective.
int settle_blunt_edges(const TetMesh& mesh, const Features& features, FrameField& field, EdgeCodes& codes);

}  // namespace hexfield
