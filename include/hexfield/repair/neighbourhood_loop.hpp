#pragma once

#include <functional>
#include <span>

#include "hexfield/repair/neighbourhood.hpp"

namespace hexfield {

/// A place where an operation works: the tets within `rings` vertex rings of the seeds are editable.
struct Place {
  std::vector<VertexId> seeds;
  int rings = 1;
};

/// Works on a copy of a place; `seeds` are local ids. Returns whether the copy is to be committed.
using LocalOperation = std::function<bool(Neighbourhood& copy, std::span<const VertexId> seeds)>;

/// Runs `operation` once at every place: claims, in order, places that share no tet, works on them at the same time
/// and commits them in order; the others wait for the next round, and find there what has been committed. Places
/// whose seeds are gone are passed over, and those that wait when the budget of work is spent. `commits[i]` says
/// whether place i was changed. The result does not depend on the number of threads. Not collective.
std::vector<char> for_places(RepairState& state, std::span<const Place> places, const LocalOperation& operation);

}  // namespace hexfield
