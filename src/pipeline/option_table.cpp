#include "hexfield/pipeline/option_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numeric>

#include "config_text.hpp"
#include "hexfield/base/error.hpp"

namespace hexfield {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

template <class T>
bool parse_number(const std::string& text, T& value) {
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const auto [end, failure] = std::from_chars(begin, text.data() + text.size(), value);
  return failure == std::errc() && end == text.data() + text.size();
}

std::vector<std::string> split_list(const std::string& text) {
  std::vector<std::string> items;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    if (end > begin) items.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return items;
}

std::string range_text(const OptionEntry& entry) {
  if (entry.most == infinity) return fmt::format("at least {}", entry.least);
  return fmt::format("from {} to {}", entry.least, entry.most);
}

/// Number of insertions, deletions and replacements that turn a into b.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

OptionTable::OptionTable(RunOptions& o) {
  entries_ = {
      {"feature_angle", "read", &o.feature_angle, 0, 180},
      {"target_hexes", "seamless", &o.target_hexes, 1, 1e10},
      {"edge_length", "seamless", &o.edge_length, 0},
      {"field.normal_deviation_degrees", "field", &o.field.normal_deviation_degrees, 0, 180},
      {"field.singular_face_edge_factor", "field", &o.field.singular_face_edge_factor, 0},
      {"field.max_singular_splits", "field", &o.field.max_singular_splits, 0},
      {"field.alignment_sweeps", "field", &o.field.alignment_sweeps, 0},
      {"field.max_smoothing_iterations", "field", &o.field.max_smoothing_iterations, 0},
      {"field.max_tet_smoothing_iterations", "field", &o.field.max_tet_smoothing_iterations, 0},
      {"field.smoothing_tolerance", "field", &o.field.smoothing_tolerance, 0, 1},
      {"repair.first_iterations", "repair", &o.repair.first_iterations, 0},
      {"repair.second_rounds", "repair", &o.repair.second_rounds, 0},
      {"repair.patience", "repair", &o.repair.patience, 1},
      {"repair.inner_iterations", "repair", &o.repair.inner_iterations, 1},
      {"repair.alignment_weight", "repair", &o.repair.alignment_weight, 0},
      {"repair.post_remesh_rounds", "repair", &o.repair.post_remesh_rounds, 0},
      {"repair.work_per_tet", "repair", &o.repair.work_per_tet, 0},
      {"seamless.max_misalignment_degrees", "seamless", &o.seamless.max_misalignment_degrees, 0, 180},
      {"quantizer", "quantize", &o.quantizer, 0, 0, {"pump", "ilp", "rounding"}},
      {"min_layers", "quantize", &o.min_layers, 1, 1000},
      {"quantize.ilp_time_limit", "quantize", &o.ilp_time_limit, 0},
      {"quantize.fallback", "igm", &o.fallback, 0, 0, {"none", "rounding"}},
      {"improve.max_rounds", "improve", &o.improve.max_rounds, 0},
      {"improve.max_untangle_rounds", "improve", &o.improve.max_untangle_rounds, 0},
      {"improve.smoothing_rounds", "improve", &o.improve.smoothing_rounds, 0},
      {"improve.shape_weight", "improve", &o.improve.shape_weight, 0},
      {"improve.good_enough", "improve", &o.improve.good_enough, 0, 1},
      {"improve.maximise_below", "improve", &o.improve.maximise_below, 0, 1},
      {"improve.maximise_steps", "improve", &o.improve.maximise_steps, 0},
      {"improve.maximise_sharpness", "improve", &o.improve.maximise_sharpness, 1, 4096},
      {"improve.maximise_gain", "improve", &o.improve.maximise_gain, 0, 1},
      {"decompose", "improve", &o.decompose},
      {"formats", "", &o.formats},
      {"threads", "", &o.threads, 0, 4096},
      {"time_limit", "", &o.time_limit, 0},
      {"checkpoint_interval", "", &o.checkpoint_interval, 0},
      {"tries", "", &o.tries, 1},
      {"seed", "read", &o.seed, 0},
      {"check", "", &o.check},
  };
}

void OptionTable::set(const std::string& key, const std::string& text, ExitCode code, const std::string& origin) {
  const auto entry = std::find_if(entries_.begin(), entries_.end(), [&](const auto& e) { return e.key == key; });
  if (entry == entries_.end()) {
    std::vector<std::string> keys;
    for (const OptionEntry& e : entries_) keys.push_back(e.key);
    throw Error(code,
                fmt::format("{}: there is no option '{}'; the nearest is '{}'.", origin, key, nearest_word(key, keys)));
  }
  const auto refuse = [&](const std::string& wanted) {
    throw Error(code, fmt::format("{}: '{}' is no value of {}: {}.", origin, text, key, wanted));
  };
  if (auto* flag = std::get_if<bool*>(&entry->value)) {
    if (text != "true" && text != "false") refuse("it is true or false");
    **flag = text == "true";
  } else if (auto* list = std::get_if<std::vector<std::string>*>(&entry->value)) {
    **list = split_list(text);
  } else if (auto* word = std::get_if<std::string*>(&entry->value)) {
    const auto& words = entry->words;
    if (std::find(words.begin(), words.end(), text) == words.end())
      refuse(fmt::format("it is {}", fmt::join(words, " or ")));
    **word = text;
  } else if (auto* whole = std::get_if<int*>(&entry->value)) {
    int value = 0;
    if (!parse_number(text, value)) refuse("it is a whole number");
    if (value < entry->least || value > entry->most) refuse("it is " + range_text(*entry));
    **whole = value;
  } else {
    double value = 0;
    if (!parse_number(text, value) || !std::isfinite(value)) refuse("it is a number");
    if (value < entry->least || value > entry->most) refuse("it is " + range_text(*entry));
    *std::get<double*>(entry->value) = value;
  }
}

void OptionTable::set_assignment(const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw Error(ExitCode::usage, fmt::format("--set {}: it must look like key=value.", assignment));
  }
  set(assignment.substr(0, equals), assignment.substr(equals + 1), ExitCode::usage, "--set " + assignment);
}

void OptionTable::read_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file)) {
    throw Error(ExitCode::bad_input, fmt::format("Cannot read the configuration {}.", file.string()));
  }
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  for (const ConfigLine& line : parse_config(text, file.string())) {
    set(line.key, line.text, ExitCode::bad_input, fmt::format("{}, line {}", file.string(), line.line));
  }
}

std::string value_text(const OptionEntry& entry) {
  if (auto* flag = std::get_if<bool*>(&entry.value)) return **flag ? "true" : "false";
  if (auto* whole = std::get_if<int*>(&entry.value)) return fmt::format("{}", **whole);
  if (auto* list = std::get_if<std::vector<std::string>*>(&entry.value))
    return fmt::format("{}", fmt::join(**list, ","));
  if (auto* word = std::get_if<std::string*>(&entry.value)) return **word;
  return fmt::format("{}", *std::get<double*>(entry.value));
}

std::string nearest_word(const std::string& word, const std::vector<std::string>& words) {
  std::string best;
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (const std::string& candidate : words) {
    // A key without the name of its table is a frequent slip: compare the last parts, too.
    const std::size_t dot = candidate.rfind('.');
    const std::string last = dot == std::string::npos ? candidate : candidate.substr(dot + 1);
    const std::size_t distance = std::min(edit_distance(word, candidate), edit_distance(word, last) + 1);
    if (distance < least) {
      least = distance;
      best = candidate;
    }
  }
  return best;
}

}  // namespace hexfield
