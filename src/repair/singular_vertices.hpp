#pragma once

#include <functional>
#include <vector>

#include "hexfield/repair/relocation_energy.hpp"
#include "hexfield/repair/repair_state.hpp"

namespace hexfield {

/// A singular edge as seen from one of its ends.
struct SingularSpoke {
  VertexId end;
  EdgeCode code;
  bool feature;  ///< also a feature edge
};

/// A vertex of the singular graph and what its features let it do.
struct SingularVertex {
  enum class Place { fixed, curve, surface, inside };
  VertexId vertex;
  std::vector<SingularSpoke> spokes;  ///< ascending by end
  Place place = Place::fixed;
  int colour = 0;           ///< of its curve or surface
  Vec3 direction{0, 0, 0};  ///< unit tangent of the curve or normal of the surface

  bool is_zipper() const;  ///< exactly one spoke of code 1 and one of -1
  RelocationEnergy::Freedom freedom() const;
};

/// All ends of singular edges, ascending. Vertices that may not move, and those at boundary faces that are no
/// feature faces, are fixed.
std::vector<SingularVertex> singular_vertices(const RepairState& state, const std::function<bool(VertexId)>& may_move);

}  // namespace hexfield
