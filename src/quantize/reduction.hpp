#pragma once

#include "hexfield/quantize/block_complex.hpp"

namespace hexfield::quantize {

/// Patches that can be removed at once such that all blocks stay cuboids (spec-quantization 3.5): the only ones on
/// both their sides, with no feature, singular arc or critical node, and between blocks that meet nowhere else. No
/// two touch the same block. Those that the fire reached last come first.
std::vector<std::int32_t> removable_patches(const BlockComplex& complex);

/// Per node: feature points, and where the number of incident singular, or feature, arcs is neither 0 nor 2, or
/// both kinds meet without being the same arcs (spec-quantization 4.3).
std::vector<char> critical_nodes(const BlockComplex& complex);

}  // namespace hexfield::quantize
