#pragma once

#include "hexfield/field/frame_field.hpp"
#include "hexfield/map/corner_map.hpp"
#include "hexfield/mesh/features.hpp"
#include "hexfield/quantize/block_complex.hpp"

namespace hexfield {

struct ComplexOptions {
  bool reduce = true;  ///< remove walls that no block needs to stay a cuboid (spec-quantization 3.5)
};

/// The motorcycle complex of an exactly seamless map (spec-quantization 3): walls from singular edges, concave
/// boundary edges, feature edges and points, traced exactly; blocks that are solid tori or meet themselves are cut
/// further; then walls are removed, those furthest from their source first. `map` and `codes` are those of
/// make_exactly_seamless(). Throws Error(no_integer_grid_map) with a place where the walls do not bound cuboids.
/// Not collective, serial.
BlockComplex motorcycle_complex(const TetMesh& mesh, const Features& features, const EdgeCodes& codes,
                                const SeamlessMap& map, const ComplexOptions& options = {});

}  // namespace hexfield
