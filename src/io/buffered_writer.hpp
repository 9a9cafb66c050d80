#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <functional>
#include <iterator>
#include <string_view>
#include <utility>

namespace hexfield::io {

/// Writes text and binary numbers into a new file. Every failure is Error(bad_input) that names `shown` and the
/// reason of the system.
class BufferedWriter {
 public:
  BufferedWriter(const std::filesystem::path& file, std::filesystem::path shown);
  ~BufferedWriter();
  BufferedWriter(const BufferedWriter&) = delete;
  BufferedWriter& operator=(const BufferedWriter&) = delete;

  void write(std::string_view data) {
    buffer_.append(data.data(), data.data() + data.size());
    if (buffer_.size() > flush_size) flush();
  }
  template <class... Args>
  void print(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(buffer_), format, std::forward<Args>(args)...);
    if (buffer_.size() > flush_size) flush();
  }
  /// The bytes of a number in this machine's order.
  template <class T>
  void binary(T value) {
    write({reinterpret_cast<const char*>(&value), sizeof(T)});
  }
  void close();

 private:
  static constexpr std::size_t flush_size = std::size_t{1} << 20;
  void flush();
  [[noreturn]] void fail(int error) const;

  std::filesystem::path shown_;
  int descriptor_ = -1;
  fmt::memory_buffer buffer_;
};

/// A file that `fill` writes and that appears complete or not at all (write_whole_file).
void write_file(const std::filesystem::path& file, const std::function<void(BufferedWriter&)>& fill);

}  // namespace hexfield::io
