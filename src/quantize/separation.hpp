#pragma once

#include "arc_system.hpp"
#include "complex_stars.hpp"

namespace hexfield::quantize {

/// Critical entities that integer lengths put in one place though the map keeps them apart, found by walking from
/// every critical node and link (spec-quantization 4.4).
struct Separation {
  ArcSum cut;            ///< must be at least the number of layers
  ArcSum positive_only;  ///< the part over axes walked one way; also positive in the map
  std::int32_t node;     ///< where the walk ended
};

class SeparationSearch {
 public:
  SeparationSearch(const BlockComplex& complex, const CriticalSet& critical);

  /// First coincidence of every sector of every source; lengths satisfy the equations of all patches. With more than
  /// one layer also the first entity that is closer than so many. Sectors are searched in parallel; the result is in
  /// their order.
  std::vector<Separation> run(const std::vector<std::int64_t>& lengths, std::int64_t layers = 1) const;

 private:
  const BlockComplex& complex_;
  const CriticalSet& critical_;
  ComplexStars stars_;
};

}  // namespace hexfield::quantize
