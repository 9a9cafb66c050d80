#pragma once

#include "arc_system.hpp"

namespace hexfield::quantize {

/// A shortest path of arcs between two seeds (features or boundary): its arcs along each axis of its start frame, with
/// the sign of their direction, and its share of the objective; the shares of all paths sum to 1.
struct ObjectivePath {
  std::array<ArcSum, 3> along;
  double weight = 0;
};

/// Paths that cross every border between the cells of the seeds once (spec-quantization 4.5 B). Empty when there are
/// fewer than two seeds.
std::vector<ObjectivePath> objective_paths(const BlockComplex& complex, const CriticalSet& critical);

}  // namespace hexfield::quantize
