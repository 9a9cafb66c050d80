#pragma once

#include <span>
#include <vector>

#include "hexfield/field/frame_field.hpp"
#include "hexfield/mesh/distributed.hpp"

/// Algorithm 1 of Liu and Bommes 2023 (FeatureAlignedSmoothField; spec-lmff section 4): averaging of
/// quaternions over face neighbours with fixed matchings, then projection onto the axis constraints.
namespace hexfield {

struct AlignOptions {
  int sweeps = 100;
  double guard_degrees = 170;   ///< matched frames never get this far apart, so that no index can jump
  double max_turn_degrees = 9;  ///< largest turn of one frame in one sweep; keeps the guard safe
  double tolerance = 0;         ///< ends when no frame turned more than this (radians); 0: all sweeps
};

struct AlignReport {
  int sweeps = 0;
  double largest_turn = 0;  ///< radians, in the last sweep
  long reverted = 0;        ///< updates that the guard undid
  long misaligned = 0;      ///< tets that still miss a constraint by more than 1e-9 radians
};

/// At most two perpendicular axes of one tet that constraints fix; further ones are dropped, faces first.
struct FrameConstraint {
  int count = 0;
  std::array<octahedral::Label, 2> labels{};
  std::array<Vec3, 2> directions{};
};

/// Constraint of each tet that `constraints` name, ordered by tet.
std::vector<std::pair<TetId, FrameConstraint>> frame_constraints(std::span<const AxisConstraint> constraints);

/// The frame closest to q that meets the constraint: the smallest turn of the first axis onto its direction,
/// twisted about it as near to q as possible or fixed by the second.
Quaternion project_frame(const Quaternion& q, const FrameConstraint& constraint);

/// Sweeps over the tets of a list, in its order (Gauss-Seidel); frames of all other tets stay and act as
/// boundary values. With a tolerance, tets are passed over while no frame that they depend on has turned more than
/// that. Not collective.
AlignReport align_submesh(const TetMesh& mesh, FrameField& field, std::span<const AxisConstraint> constraints,
                          std::span<const TetId> tets, const AlignOptions& options);

/// Jacobi sweeps over the whole mesh, distributed: `field` and `constraints` are read and written on rank 0.
/// The same bytes for any number of ranks and threads. Collective; the report is the same on all ranks.
AlignReport align_field(const DistributedMesh& mesh, FrameField& field, std::span<const AxisConstraint> constraints,
                        const AlignOptions& options);

}  // namespace hexfield
