#pragma once

#include <cstddef>
#include <string>

#include "hexfield/repair/repair_field.hpp"

namespace hexfield {

/// What one try does otherwise than the first one.
struct TrySetting {
  std::string name;            ///< for the report: "default", "alignment weight 1"
  RepairOptions repair{};      ///< of stage 3
  bool refined_input = false;  ///< the field is that of the input refined once
};

/// The setting of try `attempt` (0: the options as they are) on an input of so many tets. First an input of few tets is
/// refined: a field that is not resolved winds about itself. The other changes are those by which the authors of the
/// method got further models by hand: iterations and alignment weight (Liu and Bommes 2023, section 7).
TrySetting try_setting(const RepairOptions& options, int attempt, std::size_t input_tets);

}  // namespace hexfield
