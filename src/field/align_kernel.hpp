#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hexfield/field/align_field.hpp"

namespace hexfield {

/// Flat data of Algorithm 1 on one rank. Slot `tets` of the frames is a zero quaternion that stands for
/// the missing neighbour at boundary faces.
struct AlignData {
  std::size_t owned = 0;                                            ///< tets that move: the first ones
  std::size_t tets = 0;                                             ///< with ghosts
  std::vector<std::array<std::int32_t, 4>> neighbours;              ///< per owned tet
  std::vector<std::array<octahedral::Rotation, 4>> from_neighbour;  ///< M_ji: q_j M_ji is in the chart of i
  std::vector<std::pair<std::int32_t, FrameConstraint>> constraints;
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
