#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hexfield/field/align_field.hpp"

namespace hexfield {

/// What of project_frame() does not depend on the frame.
struct FrameProjection {
  Quaternion turn;           ///< takes the axis of the first label onto its direction, or the only frame that fits
  Vec3 axis = Vec3::Zero();  ///< of the first label; zero when two axes fix the frame
};
FrameProjection projection_of(const FrameConstraint& constraint);
Quaternion project_frame(const Quaternion& q, const FrameProjection& projection);

struct ConstrainedTet {
  ConstrainedTet(std::int32_t t, const FrameConstraint& c) : tet(t), constraint(c), projection(projection_of(c)) {}
  std::int32_t tet;
  FrameConstraint constraint;
  FrameProjection projection;
};

/// Flat data of Algorithm 1 on one rank. Slot `tets` of the frames is a zero quaternion that stands for
/// the missing neighbour at boundary faces.
struct AlignData {
  std::size_t owned = 0;                                            ///< tets that move: the first ones
  std::size_t tets = 0;                                             ///< with ghosts
  std::vector<std::array<std::int32_t, 4>> neighbours;              ///< per owned tet
  std::vector<std::array<octahedral::Rotation, 4>> from_neighbour;  ///< M_ji: q_j M_ji is in the chart of i
  std::vector<ConstrainedTet> constraints;                          ///< ascending by tet
};

struct SweepLimits {
  double guard;  ///< smallest allowed |dot| of matched frames
  double turn;   ///< smallest allowed dot of a frame with its successor
};

/// `to` limited to the largest allowed turn away from `from`; both of one sign afterwards.
Quaternion limited(const Quaternion& from, Quaternion to, double smallest_dot);

/// One Jacobi sweep: next from current; where the guard is broken in `current`, back to `previous`.
/// Returns the number of such tets.
long jacobi_sweep(const AlignData& data, const SweepLimits& limits, const std::vector<Quaternion>& previous,
                  const std::vector<Quaternion>& current, std::vector<Quaternion>& next);

/// Replaces every current frame that breaks the guard by the previous one; returns how many.
long revert_broken(const AlignData& data, double guard, const std::vector<Quaternion>& previous,
                   const std::vector<Quaternion>& current, std::vector<Quaternion>& next);

}  // namespace hexfield
