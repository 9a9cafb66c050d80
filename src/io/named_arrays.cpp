#include "hexfield/io/named_arrays.hpp"

#include <fmt/format.h>

#include "hexfield/base/error.hpp"

namespace hexfield {

void NamedArrays::own_text(const std::string& name, const std::string& text) {
  own(name, std::vector<std::uint8_t>(text.begin(), text.end()), 1);
}

std::string NamedArrays::text(const std::string& name) const {
  const auto bytes = get<std::uint8_t>(name, 1);
  return {bytes.begin(), bytes.end()};
}

const NamedArray& NamedArrays::find(const std::string& name, ElementType type, std::size_t columns) const {
  const auto found = arrays_.find(name);
  if (found == arrays_.end()) {
    throw Error(ExitCode::bad_input, fmt::format("The checkpoint has no array '{}' where one belongs.", name));
  }
  if (found->second.type != type || found->second.columns != columns) {
    throw Error(ExitCode::bad_input, fmt::format("Array '{}' of the checkpoint has another type or shape.", name));
  }
  return found->second;
}

}  // namespace hexfield
