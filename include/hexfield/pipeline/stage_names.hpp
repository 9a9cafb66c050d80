#pragma once

#include <string>
#include <vector>

namespace hexfield {

/// Names of the stages in their order, as --from and --to take them.
const std::vector<std::string>& stage_names();

/// The name of the stage that does the work of `name`: "quantize" is done by igm, which rounds one coordinate after
/// the other. Throws Error(usage) naming the stages when there is no such stage.
std::string resolve_stage(const std::string& name);

}  // namespace hexfield
