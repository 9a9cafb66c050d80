#include "hexfield/pipeline/stage_names.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hexfield/base/error.hpp"

namespace hexfield {

const std::vector<std::string>& stage_names() {
  static const std::vector<std::string> names = {"read",     "field", "repair",  "seamless",
                                                 "quantize", "igm",   "extract", "improve"};
  return names;
}

std::string resolve_stage(const std::string& name) {
  const auto& names = stage_names();
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    throw Error(ExitCode::usage,
                fmt::format("There is no stage '{}'; the stages are {}.", name, fmt::join(names, ", ")));
  }
  return name;
}

}  // namespace hexfield
