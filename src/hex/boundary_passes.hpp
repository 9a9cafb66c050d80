#pragma once

#include <optional>
#include <vector>

#include "quad_classes.hpp"

namespace hexfield::hex {

/// The ways in which a sheet without bends can pass a boundary vertex: arcs of interior quads from one boundary edge to
/// another, straight at regular edges, that hold all quads of each of their classes at the vertex. Each as its classes,
/// ascending; the ways in ascending order. Nothing when there are too many to list.
std::optional<std::vector<std::vector<int>>> boundary_passes(const HexComplex& complex, const QuadClasses& classes,
                                                             int vertex);

}  // namespace hexfield::hex
