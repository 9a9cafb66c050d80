#include "config_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "hexfield/base/error.hpp"

namespace hexfield {
namespace {

bool is_key_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '.';
}

/// One line of the file and how far it is read.
class Line {
 public:
  Line(std::string_view text, const std::string& file, int number) : text_(text), file_(file), number_(number) {}

  [[noreturn]] void fail(const std::string& why) const {
    throw Error(ExitCode::bad_input, fmt::format("{}, line {}: {}.", file_, number_, why));
  }

  void skip_blanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\r')) ++at_;
  }
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  bool take(char c) {
    skip_blanks();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  bool ended() {
    skip_blanks();
    return at_ >= text_.size() || text_[at_] == '#';
  }

  std::string key() {
    skip_blanks();
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_key_character(text_[at_])) ++at_;
    if (at_ == begin) fail("a key was expected");
    return std::string(text_.substr(begin, at_ - begin));
  }

  std::string value() {
    skip_blanks();
    if (take('[')) return list();
    return scalar();
  }

 private:
  std::string list() {
    std::string items;
    while (!take(']')) {
      if (!items.empty() && !take(',')) fail("a comma or ']' was expected in the list");
      if (take(']')) break;
      if (ended()) fail("the list does not end on its line");
      if (!items.empty()) items += ',';
      items += scalar();
    }
    return items;
  }

  std::string scalar() {
    skip_blanks();
    const char quote = peek();
    if (quote == '"' || quote == '\'') return quoted(quote);
    const std::size_t begin = at_;
    while (at_ < text_.size() && (is_key_character(text_[at_]) || text_[at_] == '+')) ++at_;
    if (at_ == begin) fail("a value was expected");
    std::string word(text_.substr(begin, at_ - begin));
    const bool number = std::isdigit(static_cast<unsigned char>(word.front())) != 0 || word.front() == '-' ||
                        word.front() == '+' || word.front() == '.';
    if (!number && word != "true" && word != "false") fail(fmt::format("text must stand in quotes: \"{}\"", word));
    if (number) std::erase(word, '_');
    return word;
  }

  std::string quoted(char quote) {
    std::string text;
    for (++at_; at_ < text_.size() && text_[at_] != quote; ++at_) {
      if (quote == '"' && text_[at_] == '\\') {
        if (++at_ >= text_.size()) break;
        if (text_[at_] != '\\' && text_[at_] != '"') fail("only \\\\ and \\\" are known after a backslash");
      }
      text += text_[at_];
    }
    if (at_ >= text_.size()) fail("the string has no closing quote");
    ++at_;
    return text;
  }

  std::string_view text_;
  const std::string& file_;
  int number_;
  std::size_t at_ = 0;
};

}  // namespace

std::vector<ConfigLine> parse_config(std::string_view text, const std::string& file) {
  std::vector<ConfigLine> lines;
  std::string table;
  int number = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    Line line(text.substr(0, end), file, ++number);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.ended()) continue;
    if (line.take('[')) {
      table = line.key() + ".";
      if (!line.take(']')) line.fail("the table has no ']'");
    } else {
      ConfigLine entry{table + line.key(), "", number};
      if (!line.take('=')) line.fail("'=' was expected after the key");
      entry.text = line.value();
      const auto same = [&](const ConfigLine& other) { return other.key == entry.key; };
      if (std::any_of(lines.begin(), lines.end(), same)) line.fail(fmt::format("'{}' is set twice", entry.key));
      lines.push_back(std::move(entry));
    }
    if (!line.ended()) line.fail("there is something behind the end of the value");
  }
  return lines;
}

}  // namespace hexfield
