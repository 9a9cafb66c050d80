#pragma once

#include <string>
#include <utility>
#include <vector>

namespace hexfield {

/// Version of the program, "0.1.0".
std::string program_version();
/// Commit that it was built from, with "-dirty" when files were changed; "unknown" outside a repository.
std::string program_git();
/// Name and version of each library that it runs with; MPI must be initialised.
std::vector<std::pair<std::string, std::string>> library_versions();

}  // namespace hexfield
