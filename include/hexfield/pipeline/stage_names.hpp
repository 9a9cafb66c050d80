#pragma once

#include <string>
#include <vector>

namespace hexfield {

/// Names of the stages in their order, as --from and --to take them.
const std::vector<std::string>& stage_names();

/// `name` when it is that of a stage; throws Error(usage) naming the stages when it is none.
std::string resolve_stage(const std::string& name);

}  // namespace hexfield
