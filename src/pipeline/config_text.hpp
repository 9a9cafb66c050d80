#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hexfield {

/// One assignment of a configuration file.
struct ConfigLine {
  std::string key;   ///< with the names of its tables before it, joined by dots
  std::string text;  ///< value without quotes; the items of a list are joined by commas
  int line = 0;
};

/// Reads the part of TOML that options need: comments, [tables], dotted keys, strings in either quotes, numbers,
/// booleans and one-line lists of them. `file` is only for the sentences.
/// Throws Error(bad_input) with file and line for anything else, and for a key that is set twice.
std::vector<ConfigLine> parse_config(std::string_view text, const std::string& file);

}  // namespace hexfield
