#pragma once

#include <array>

#include "hexfield/base/geometry.hpp"

/// Real spherical harmonics of degree 4 (m = -4..4, index m + 4) and the octahedral frames among them
/// [Huang 2011; Ray et al. 2016; spec-lmff section 2]. A frame is the unit vector D(R) a0 of the symmetric
/// function of its three axes; the 24 frames that differ by an octahedral rotation share one vector.
namespace hexfield::harmonics {

using Sh = Eigen::Matrix<double, 9, 1>;
using ShMatrix = Eigen::Matrix<double, 9, 9>;

/// Unit vector of the frame with axes x, y, z: sqrt(7/12) at m = 0 and sqrt(5/12) at m = 4.
const Sh& reference();
/// Antisymmetric generator L_k of rotations about axis k (0 x, 1 y, 2 z): D(exp(w)) = exp(w_x L_x + w_y L_y + w_z L_z).
const ShMatrix& generator(int k);
/// The columns L_x s, L_y s, L_z s. For a frame their Gram matrix is 20/3 times the identity.
Eigen::Matrix<double, 9, 3> tangent(const Sh& s);
/// Degree-4 harmonics at the unit vector n, scaled to unit norm; equals D(R) e_0 where R takes z to n.
Sh zonal(const Vec3& n);
/// D(R) s.
Sh rotated(const Quaternion& r, const Sh& s);
/// D(R) a0 of a frame.
Sh of_frame(const Quaternion& frame);

/// Frames with one axis along n: sqrt(7/12) zonal(n) + sqrt(5/12) (sin 4t h_minus + cos 4t h_plus), with
/// orthonormal columns h_minus, h_plus (D(R) e_-4 and D(R) e_4 for one rotation R that takes z to n).
struct AlignedBasis {
  Quaternion rotation;  ///< R: takes z to n
  Sh offset;            ///< sqrt(7/12) zonal(n)
  Eigen::Matrix<double, 9, 2> twist;
};
AlignedBasis aligned_basis(const Vec3& n);

/// The frame closest to q: maximises <q, D(R) a0>.
struct Projected {
  Quaternion frame;
  Sh sh;
  double dot = 0;  ///< <q, sh>
};
/// Best of five seeds and of the optional guess, each followed by Newton steps on the rotation.
/// A vector without any preference (q = 0) gives the identity.
Projected project(const Sh& q);
/// Newton from one frame; finds the local maximum uphill of it.
Projected project_from(const Sh& q, const Quaternion& start);
/// The closest frame among those aligned with the basis; exact.
Projected project(const Sh& q, const AlignedBasis& basis);

}  // namespace hexfield::harmonics
