#include <fmt/format.h>

#include "hexfield/base/error.hpp"
#include "stages.hpp"

namespace hexfield {

void judge_hexes(RunState& state) {
  state.report["hex"] = {{"count", state.hexes.hexes.size()}};
  state.sentence = fmt::format("Complete: {} hexes.", state.hexes.hexes.size());
}

}  // namespace hexfield
