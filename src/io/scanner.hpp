#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "hexfield/base/error.hpp"

namespace hexfield::io {

/// The whole content of a file. Throws Error(bad_input) naming the path and the reason of the system.
std::string load_file(const std::filesystem::path& file);

/// The token with unprintable bytes as '?', cut to a length that fits into a sentence.
std::string printable(std::string_view token);

/// Walks over a file that lies in memory, as text (tokens, numbers, lines) or as binary values. Every failure is
/// Error(bad_input) with the file's name and the line (text) or byte (binary) where it was met.
class Scanner {
 public:
  Scanner(std::string file, std::string_view data) : file_(std::move(file)), data_(data) {}

  const std::string& file() const { return file_; }
  /// Places are named by byte instead of by line.
  void name_places_by_byte() { by_byte_ = true; }
  /// Numbers of binary() are stored in the other byte order than this machine's.
  void swap_bytes(bool swap) { swap_ = swap; }

  std::size_t remaining() const { return data_.size() - at_; }
  /// Skips white space; true when nothing else is left.
  bool at_end();
  /// Next token that is delimited by white space, without moving on; empty at the end.
  std::string_view peek();
  std::string_view token(const char* what);
  std::int64_t integer(const char* what);
  /// Any double, also NaN or infinite: judged where its meaning is known.
  double real(const char* what);
  /// A number of things that take at least `bytes_each` of what is left of the file; refuses negative and
  /// impossible numbers, so that memory can be reserved for it.
  std::size_t count(const char* what, std::size_t bytes_each);
  void check_count(std::int64_t n, const char* what, std::size_t bytes_each) const;
  /// True when something other than white space follows in this line.
  bool more_in_line() const;
  /// The rest of the line without its end; moves behind the end.
  std::string_view line();
  /// Skips lines up to and including the next one that is `text`; false when there is none.
  bool skip_to_line(std::string_view text);

  template <class T>
  T binary(const char* what) {
    T value;
    std::memcpy(&value, take(sizeof(T), what), sizeof(T));
    if (swap_) value = swapped(value);
    return value;
  }
  void skip_bytes(std::size_t n, const char* what) { take(n, what); }

  [[noreturn]] void fail(const std::string& sentence) const;

 private:
  template <class T>
  static T swapped(T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    for (std::size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(bytes[i], bytes[sizeof(T) - 1 - i]);
    std::memcpy(&value, bytes, sizeof(T));
    return value;
  }
  const char* take(std::size_t n, const char* what);

  std::string file_;
  std::string_view data_;
  std::size_t at_ = 0;
  bool by_byte_ = false;
  bool swap_ = false;
};

/// Lower-case copy (ASCII).
std::string lower(std::string_view text);

inline constexpr bool big_endian_machine = std::endian::native == std::endian::big;

}  // namespace hexfield::io
