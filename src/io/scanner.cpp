#include "scanner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <fstream>
#include <system_error>

namespace hexfield::io {
namespace {

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

}  // namespace

std::string load_file(const std::filesystem::path& file) {
  const auto refuse = [&](const std::string& reason) {
    throw Error(ExitCode::bad_input, fmt::format("{}: cannot be read: {}.", file.string(), reason));
  };
  std::error_code code;
  const auto status = std::filesystem::status(file, code);
  if (!std::filesystem::exists(status)) refuse("there is no such file");
  if (std::filesystem::is_directory(status)) refuse("it is a directory");
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) refuse(std::generic_category().message(errno));
  std::string data;
  // One byte more than the size, so that the end is met in the first read.
  const auto size = std::filesystem::is_regular_file(status) ? std::filesystem::file_size(file, code) : 0;
  const std::size_t piece = code || size == 0 ? std::size_t{1} << 16 : static_cast<std::size_t>(size) + 1;
  while (stream) {
    const std::size_t old = data.size();
    data.resize(old + piece);
    stream.read(data.data() + old, static_cast<std::streamsize>(piece));
    data.resize(old + static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad()) refuse(std::generic_category().message(errno));
  if (data.empty()) refuse("it is empty");
  return data;
}

std::string printable(std::string_view token) {
  constexpr std::size_t longest = 40;
  std::string text(token.substr(0, longest));
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  return token.size() > longest ? text + "..." : text;
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

void Scanner::fail(const std::string& sentence) const {
  const auto newlines = std::count(data_.begin(), data_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
  throw Error(ExitCode::bad_input, by_byte_ ? fmt::format("{}, byte {}: {}.", file_, at_, sentence)
                                            : fmt::format("{}, line {}: {}.", file_, newlines + 1, sentence));
}

bool Scanner::at_end() {
  while (at_ < data_.size() && is_space(data_[at_])) ++at_;
  return at_ == data_.size();
}

std::string_view Scanner::peek() {
  at_end();
  std::size_t end = at_;
  while (end < data_.size() && !is_space(data_[end])) ++end;
  return data_.substr(at_, end - at_);
}

std::string_view Scanner::token(const char* what) {
  const std::string_view text = peek();
  if (text.empty()) fail(fmt::format("the file ends where {} is expected", what));
  at_ += text.size();
  return text;
}

std::int64_t Scanner::integer(const char* what) {
  const std::string_view text = token(what);
  std::int64_t value = 0;
  const char* begin = text.data() + (text.size() > 1 && text[0] == '+' ? 1 : 0);
  const char* end = text.data() + text.size();
  const auto [at, code] = std::from_chars(begin, end, value);
  if (code == std::errc() && at == end) return value;
  at_ -= text.size();
  fail(fmt::format("\"{}\" is no integer, where {} is expected", printable(text), what));
}

double Scanner::real(const char* what) {
  const std::string_view text = token(what);
  double value = 0;
  const char* begin = text.data() + (text.size() > 1 && text[0] == '+' ? 1 : 0);
  const char* end = text.data() + text.size();
  const auto [at, code] = std::from_chars(begin, end, value);
  if (at == end && code == std::errc()) return value;
  // Too large or too small for a double: strtod gives infinity or zero.
  if (at == end && code == std::errc::result_out_of_range) return std::strtod(std::string(text).c_str(), nullptr);
  at_ -= text.size();
  fail(fmt::format("\"{}\" is no number, where {} is expected", printable(text), what));
}

std::size_t Scanner::count(const char* what, std::size_t bytes_each) {
  const std::int64_t n = integer(what);
  check_count(n, what, bytes_each);
  return static_cast<std::size_t>(n);
}

void Scanner::check_count(std::int64_t n, const char* what, std::size_t bytes_each) const {
  if (n < 0) fail(fmt::format("{} is negative ({})", what, n));
  // One byte of grace: the last token of a text needs no white space behind it.
  if (bytes_each > 0 && static_cast<std::size_t>(n) > (remaining() + 1) / bytes_each)
    fail(
        fmt::format("{} is {}, more than the {} bytes that follow can hold; the file is cut off or the number is "
                    "wrong",
                    what, n, remaining()));
}

bool Scanner::more_in_line() const {
  const std::size_t at = data_.find_first_not_of(" \t\r", at_);
  return at != std::string_view::npos && data_[at] != '\n';
}

std::string_view Scanner::line() {
  const std::size_t end = std::min(data_.find('\n', at_), data_.size());
  std::string_view text = data_.substr(at_, end - at_);
  at_ = std::min(end + 1, data_.size());
  if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
  return text;
}

bool Scanner::skip_to_line(std::string_view text) {
  while (at_ < data_.size())
    if (line() == text) return true;
  return false;
}

const char* Scanner::take(std::size_t n, const char* what) {
  if (n > remaining()) fail(fmt::format("the file ends inside {}", what));
  const char* begin = data_.data() + at_;
  at_ += n;
  return begin;
}

}  // namespace hexfield::io
