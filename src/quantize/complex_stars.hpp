#pragma once

#include "hexfield/quantize/block_complex.hpp"

namespace hexfield::quantize {

/// What meets in the nodes and arcs of a complex; all lists ascend.
struct ComplexStars {
  explicit ComplexStars(const BlockComplex& complex);

  std::vector<std::vector<std::int32_t>> node_patches, node_arcs;
  /// Blocks, with the direction from the arc's first node to its second in their chart.
  std::vector<std::vector<std::pair<std::int32_t, octahedral::Label>>> arc_blocks;
};

/// The other node of an arc.
inline std::int32_t other_node(const BlockComplex& complex, std::int32_t arc, std::int32_t node) {
  const auto& ends = complex.arcs[static_cast<std::size_t>(arc)].nodes;
  return ends[0] == node ? ends[1] : ends[0];
}

/// The block across a patch and the rotation from here to there; -1 on the boundary or where the patch is elsewhere.
struct PatchStep {
  std::int32_t block = -1;
  octahedral::Rotation rotation = octahedral::identity;
};
PatchStep across(const BlockComplex& complex, std::int32_t patch, std::int32_t block);

}  // namespace hexfield::quantize
