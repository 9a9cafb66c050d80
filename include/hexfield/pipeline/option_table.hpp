#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "hexfield/pipeline/options.hpp"

namespace hexfield {

/// One option: its key in configuration files and --set, where its value lives, and what values it may have.
struct OptionEntry {
  std::string key;    ///< "target_hexes", or "<stage>.<field of the stage's options>"
  std::string stage;  ///< the first stage whose result depends on it; empty when none does
  std::variant<double*, int*, bool*, std::vector<std::string>*, std::string*> value;
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  std::vector<std::string> words{};  ///< of a text: those that it may be
};

/// All options of `options` by key; refers to it.
class OptionTable {
 public:
  explicit OptionTable(RunOptions& options);

  const std::vector<OptionEntry>& entries() const { return entries_; }
  /// Sets an option from text. Throws Error with this code when there is no such key (the sentence names the nearest
  /// one) or the text is no value of it; `origin` says where the text stands.
  void set(const std::string& key, const std::string& text, ExitCode code, const std::string& origin);
  /// "key=value" from a command line. Throws Error(usage).
  void set_assignment(const std::string& assignment);
  /// Sets what a configuration file says. Throws Error(bad_input) naming file and line.
  void read_file(const std::filesystem::path& file);

 private:
  std::vector<OptionEntry> entries_;
};

/// The value as text that set() takes; doubles read back to the same bits.
std::string value_text(const OptionEntry& entry);
/// Of `words` the one with the fewest edits from `word`.
std::string nearest_word(const std::string& word, const std::vector<std::string>& words);

}  // namespace hexfield
