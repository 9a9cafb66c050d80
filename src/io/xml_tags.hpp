#pragma once

#include <map>
#include <string>
#include <string_view>

namespace hexfield::io {

/// Walks over the tags of an XML text from front to back, as far as files of data arrays need it: no entities but the
/// five predefined ones, no CDATA, no document types with contents.
class XmlTags {
 public:
  struct Tag {
    std::string name;
    std::map<std::string, std::string> attributes;
    bool closing = false;  ///< </name>
    bool empty = false;    ///< <name/>

    /// The value of an attribute, `otherwise` when there is none.
    std::string get(const std::string& key, const std::string& otherwise = "") const;
  };

  XmlTags(std::string file, std::string_view data) : file_(std::move(file)), data_(data) {}

  /// The next tag; false at the end. Skips comments and declarations.
  bool next(Tag& tag);
  /// What stands between the last tag and the next '<' or the end.
  std::string_view text() const;
  /// All that follows the last tag.
  std::string_view rest() const { return data_.substr(at_); }

  /// Throws Error(bad_input) with the line of the last tag.
  [[noreturn]] void fail(const std::string& sentence) const;

 private:
  bool skip(std::string_view opening, std::string_view closing);
  std::string word();
  std::string quoted();
  void skip_spaces();

  std::string file_;
  std::string_view data_;
  std::size_t at_ = 0;
};

}  // namespace hexfield::io
