#pragma once

#include <array>
#include <cstdint>

#include "hexfield/base/geometry.hpp"

/// The 24 rotations of the cube and the signed axis labels they permute (spec-lmff section 0).
///
/// Conventions, fixed here and used everywhere:
///  * Axis labels: 0 = +u, 1 = -u, 2 = +v, 3 = -v, 4 = +w, 5 = -w; negate(a) = a xor 1; a / 2 = axis.
///  * A Rotation is an element R of the octahedral group O; matrix(R) is a signed permutation matrix.
///  * Matching of tets i and j: M_ij is the element with F_i M_ij closest to F_j; M_ji = M_ij^-1.
///  * An axis vector a in the chart of i is M_ij^T a in the chart of j: label_in_j = image(inverse(M_ij), a).
///  * Coordinates of a map go the same way: f_i = M_ij f_j + t, thus f_j = M_ij^-1 (f_i - t).
///    The rotation that maps coordinates from i to j is the inverse of the matching M_ij.
namespace hexfield::octahedral {

/// Index of a group element: 0 identity; 1..3 half-turns about u, v, w; 4..9 quarter-turns about
/// +u, -u, +v, -v, +w, -w; 10..15 half-turns about edge diagonals; 16..23 third-turns.
using Rotation = std::uint8_t;
using Label = std::uint8_t;

inline constexpr int order = 24;
inline constexpr Rotation identity = 0;
inline constexpr Label no_label = 255;

constexpr Label negate(Label a) { return static_cast<Label>(a ^ 1); }
constexpr int axis(Label a) { return a / 2; }
constexpr double sign(Label a) { return (a & 1) != 0 ? -1.0 : 1.0; }

/// a b: first b, then a (matrix product).
Rotation product(Rotation a, Rotation b);
Rotation inverse(Rotation a);
/// The label of R applied to the axis vector of label a.
Label image(Rotation r, Label a);
const Mat3& matrix(Rotation r);
const Quaternion& quaternion(Rotation r);
/// Unit vector of a label.
Vec3 direction(Label a);
/// Exact product of matrix(r) and x (coordinates are only swapped and negated).
Vec3 apply(Rotation r, const Vec3& x);

/// Identity and the nine rotations about a coordinate axis: the monodromies that admit meshable arcs.
constexpr bool is_axial(Rotation r) { return r < 10; }
/// Monodromy about two axes at once (defect D1).
constexpr bool is_compound(Rotation r) { return r >= 10; }

/// The quarter-turn by +90 degrees about the axis of label a.
Rotation quarter_turn(Label a);
/// The axis of an axial, non-identity rotation, signed such that quarter-turns are by +90 degrees
/// about it; half-turns give the positive axis.
Label rotation_axis(Rotation r);

/// Element of O closest to the rotation q: largest |dot| of unit quaternions, the first index wins ties.
Rotation closest(const Quaternion& q);
/// Matching of two frames: closest(F_i^-1 F_j).
Rotation matching(const Quaternion& frame_i, const Quaternion& frame_j);

}  // namespace hexfield::octahedral
