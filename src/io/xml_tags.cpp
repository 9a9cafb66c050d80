#include "xml_tags.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "scanner.hpp"

namespace hexfield::io {
namespace {

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

bool ends_word(char c) { return is_space(c) || c == '=' || c == '>' || c == '/' || c == '<' || c == '"' || c == '\''; }

std::string unescaped(std::string_view text) {
  static constexpr std::pair<std::string_view, char> entities[] = {
      {"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}};
  std::string out;
  while (!text.empty()) {
    std::size_t used = 1;
    char c = text[0];
    for (const auto& [name, meant] : entities)
      if (text.starts_with(name)) {
        used = name.size();
        c = meant;
      }
    out.push_back(c);
    text.remove_prefix(used);
  }
  return out;
}

}  // namespace

std::string XmlTags::Tag::get(const std::string& key, const std::string& otherwise) const {
  const auto found = attributes.find(key);
  return found == attributes.end() ? otherwise : found->second;
}

void XmlTags::fail(const std::string& sentence) const {
  const auto lines = std::count(data_.begin(), data_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
  throw Error(ExitCode::bad_input, fmt::format("{}, line {}: {}.", file_, lines + 1, sentence));
}

void XmlTags::skip_spaces() {
  while (at_ < data_.size() && is_space(data_[at_])) ++at_;
}

bool XmlTags::skip(std::string_view opening, std::string_view closing) {
  if (!data_.substr(at_).starts_with(opening)) return false;
  const std::size_t end = data_.find(closing, at_ + opening.size());
  if (end == std::string_view::npos) fail(fmt::format("there is no end of what begins with {}", opening));
  at_ = end + closing.size();
  return true;
}

std::string XmlTags::word() {
  const std::size_t begin = at_;
  while (at_ < data_.size() && !ends_word(data_[at_])) ++at_;
  if (at_ == begin) fail("a name is expected in a tag");
  return std::string(data_.substr(begin, at_ - begin));
}

std::string XmlTags::quoted() {
  skip_spaces();
  if (at_ >= data_.size() || data_[at_] != '=') fail("\"=\" is expected behind the name of an attribute");
  ++at_;
  skip_spaces();
  if (at_ >= data_.size() || (data_[at_] != '"' && data_[at_] != '\'')) fail("the value of an attribute has no quotes");
  const std::size_t end = data_.find(data_[at_], at_ + 1);
  if (end == std::string_view::npos) fail("the value of an attribute has no end");
  const std::string_view value = data_.substr(at_ + 1, end - at_ - 1);
  at_ = end + 1;
  return unescaped(value);
}

bool XmlTags::next(Tag& tag) {
  do {
    at_ = std::min(data_.find('<', at_), data_.size());
    if (at_ == data_.size()) return false;
  } while (skip("<?", "?>") || skip("<!--", "-->") || skip("<!", ">"));
  tag = {};
  ++at_;
  if (at_ < data_.size() && data_[at_] == '/') {
    tag.closing = true;
    ++at_;
  }
  tag.name = word();
  for (;;) {
    skip_spaces();
    if (at_ >= data_.size()) fail(fmt::format("the file ends inside the tag {}", printable(tag.name)));
    if (data_[at_] == '>') break;
    if (data_[at_] == '/') {
      tag.empty = true;
      ++at_;
      continue;
    }
    std::string key = word();
    tag.attributes[std::move(key)] = quoted();
  }
  ++at_;
  return true;
}

std::string_view XmlTags::text() const { return data_.substr(at_, data_.find('<', at_) - at_); }

}  // namespace hexfield::io
