#pragma once

#include <span>

#include "hexfield/field/edge_codes.hpp"
#include "hexfield/repair/meshability.hpp"

namespace hexfield {

/// edge_meshable() of an edge whose ring and sectors, in either orientation, are known.
bool edge_meshable(const FieldView& view, const EdgeKey& edge, const EdgeRing& ring, std::span<const Sector> between);

}  // namespace hexfield
