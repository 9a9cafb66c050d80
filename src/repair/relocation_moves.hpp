#pragma once

#include <span>
#include <vector>

#include "hexfield/mesh/surface.hpp"
#include "hexfield/repair/repair_state.hpp"
#include "singular_vertices.hpp"

namespace hexfield {

/// A wished displacement: the vertex goes to its place + share (target - place).
struct Move {
  SingularVertex who;
  Vec3 target;
  double share = 1;
};

/// Targets of vertices on features become the closest points of the curves and surfaces of the input of their colour,
/// where they have one and, for surfaces, where its normal is within 45 degrees of the one at the vertex.
void project_to_originals(std::vector<Move>& moves, const ClosestSurface& surface, const ClosestCurve& curves);

/// Lessens the shares, each only as far as its own tets need it, until every tet of `tets` stays positive and no
/// feature triangle turns over. `moves` ascending by vertex, `tets`: all at their vertices.
void shorten_moves(const RepairState& state, std::span<const TetId> tets, std::vector<Move>& moves);

/// Carries the moves out; frames at features turn with them, keeping their labels. Returns the tets at vertices that
/// moved, ascending.
std::vector<TetId> apply_moves(RepairState& state, std::span<const Move> moves);

}  // namespace hexfield
