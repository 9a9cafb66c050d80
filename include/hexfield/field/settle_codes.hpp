#pragma once

#include "hexfield/field/frame_field.hpp"
#include "hexfield/mesh/features.hpp"

namespace hexfield {

/// Feature edges whose dihedral angle lies near 45, 135, 225 or 315 degrees can be meshed with one quad sector more or
/// less, and a smooth field takes now this, now that along one curve, with a singular edge of opposite code beside
/// every other piece. Takes back by quarter-turns about such an edge, face by face, what makes the edges of the face
/// less singular (sum of the absolute codes), until nothing does. Matchings and codes follow; frames stay. Returns the
/// number of faces changed. Not collective.
int settle_blunt_edges(const TetMesh& mesh, const Features& features, FrameField& field, EdgeCodes& codes);

}  // namespace hexfield
