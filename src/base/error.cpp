#include "hexfield/base/error.hpp"

#include <utility>

namespace hexfield {

Error::Error(ExitCode code, std::string sentence, std::vector<std::int64_t> ids, std::vector<Vec3> places)
    : code_(code), sentence_(std::move(sentence)), ids_(std::move(ids)), places_(std::move(places)) {}

void require(bool holds, const char* sentence) {
  if (!holds) throw Error(ExitCode::bug, sentence);
}

}  // namespace hexfield
