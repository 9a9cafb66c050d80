#pragma once

#include <memory>
#include <vector>

#include "hexfield/field/frame_field.hpp"
#include "hexfield/map/conforming_space.hpp"
#include "hexfield/mesh/features.hpp"
#include "hexfield/quantize/block_complex.hpp"

namespace hexfield {

/// The motorcycle complex of an exactly seamless map together with its place in the mesh: turns integer lengths of
/// arcs into what the integer-grid map needs (spec-quantization 6). Nothing is collective.
class MapQuantizer {
 public:
  /// `map` and `codes` as make_exactly_seamless() gives them; throws as motorcycle_complex() does.
  MapQuantizer(const TetMesh& mesh, const Features& features, const EdgeCodes& codes, const SeamlessMap& map);
  ~MapQuantizer();
  MapQuantizer(MapQuantizer&&) noexcept;
  MapQuantizer& operator=(MapQuantizer&&) noexcept;

  const BlockComplex& complex() const;

  /// The integer unknowns of `space` (num_integers values: coordinates of features and singular arcs, translations
  /// of the cut) of the maps whose blocks have these integer lengths. `space` belongs to the map of the constructor.
  /// The blocks are laid out in the combed charts by a walk over the cut-open mesh; every way to a value must give the
  /// same one, else Error(no_integer_grid_map) with the place; so are lengths that check() does not accept.
  std::vector<double> integer_unknowns(const ConformingSpace& space, const std::vector<std::int64_t>& lengths) const;

  /// Per tet of the mesh, how much it grows along the axes of its chart when the blocks that it lies in take these
  /// lengths: integer over real extent of the block, parameter units, the geometric mean over the parts of the tet. A
  /// block without extent counts as a quarter of a hex. Lengths as for integer_unknowns().
  std::vector<Vec3> stretches(const std::vector<std::int64_t>& lengths) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hexfield
