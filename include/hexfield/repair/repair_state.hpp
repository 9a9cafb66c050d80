#pragma once

#include <set>
#include <vector>

#include "hexfield/field/compute_field.hpp"

namespace hexfield {

/// What stage 3 works on: the mesh with its features, the field with its codes, and what the repair needs to
/// remember between operations. Held whole by one rank.
struct RepairState : FieldResult {
  std::vector<double> target_length;  ///< per vertex: mean length of its edges in the input, kept under splits
  std::map<EdgeKey, int> pairs;       ///< singular edges of two arcs made by one unzipping share an id; they repel
  std::set<EdgeKey> kept;             ///< singular edges that must stay on their feature surface
};

}  // namespace hexfield
