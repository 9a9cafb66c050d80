#pragma once

#include <vector>

#include "hexfield/field/frame_field.hpp"

namespace hexfield {

/// Closest matchings of all inner faces from the frames; identity on the boundary. The side of the
/// smaller tet id decides and the other gets the inverse. Not collective.
void compute_matchings(const TetMesh& mesh, FrameField& field);

/// Gauge change of one tet by g: frame F becomes F g, every matching M_tj becomes g^-1 M_tj. All results of
/// the library are invariant under it.
void change_gauge(const TetMesh& mesh, FrameField& field, TetId tet, octahedral::Rotation g);

/// Gauge changes along a breadth-first dual spanning forest (from the smallest ids) that make its matchings
/// the identity, so that most faces of the mesh carry the identity. Not collective.
void comb(const TetMesh& mesh, FrameField& field);

/// Rotation angle in radians between the matched frames across h: of F_t M_tj and F_j; 0 on the boundary.
double matched_angle(const TetMesh& mesh, const FrameField& field, HalfFaceId h);

/// Broken invariants: wrong sizes, frames that are not unit, matchings of the two sides not inverse.
std::vector<Violation> check(const TetMesh& mesh, const FrameField& field);

}  // namespace hexfield
