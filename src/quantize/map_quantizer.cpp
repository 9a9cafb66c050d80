#include "hexfield/quantize/map_quantizer.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "hexfield/quantize/quantization.hpp"
#include "integer_frames.hpp"
#include "stretches.hpp"
#include "wall_cells.hpp"

namespace hexfield {

using namespace quantize;

struct MapQuantizer::Impl {
  ChartMesh walls;
  WallCells cells;
  std::size_t num_tets;

  Impl(const TetMesh& mesh, const Features& features, const EdgeCodes& codes, const SeamlessMap& map)
      : walls(mesh, features, codes, map), cells(walls), num_tets(mesh.num_tets()) {
    trace_and_reduce(walls, cells, true);
  }
};

MapQuantizer::MapQuantizer(const TetMesh& mesh, const Features& features, const EdgeCodes& codes,
                           const SeamlessMap& map)
    : impl_(std::make_unique<Impl>(mesh, features, codes, map)) {}
MapQuantizer::~MapQuantizer() = default;
MapQuantizer::MapQuantizer(MapQuantizer&&) noexcept = default;
MapQuantizer& MapQuantizer::operator=(MapQuantizer&&) noexcept = default;

const BlockComplex& MapQuantizer::complex() const { return impl_->cells.complex; }

std::vector<double> MapQuantizer::integer_unknowns(const ConformingSpace& space,
                                                   const std::vector<std::int64_t>& lengths) const {
  const std::vector<Violation> wrong = check(complex(), lengths);
  if (!wrong.empty())
    throw Error(ExitCode::no_integer_grid_map, "The integer lengths are not valid. " + wrong[0].sentence, wrong[0].ids,
                wrong[0].places);
  return IntegerFrames(impl_->walls, impl_->cells, space, lengths).unknowns();
}

std::vector<Vec3> MapQuantizer::stretches(const std::vector<std::int64_t>& lengths) const {
  return quantize::stretches(impl_->walls, impl_->cells, impl_->num_tets, lengths);
}

}  // namespace hexfield
