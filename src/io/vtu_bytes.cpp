#include "vtu_bytes.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <array>
#include <cstdint>
#include <vector>

#include "scanner.hpp"

namespace hexfield::io {
namespace {

constexpr std::size_t best_compression = 1100;  // zlib reaches 1032 : 1

std::array<int, 256> base64_values() {
  static constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<int, 256> values{};
  values.fill(-1);
  for (std::size_t k = 0; k < digits.size(); ++k) values[static_cast<unsigned char>(digits[k])] = static_cast<int>(k);
  return values;
}

/// Gives out the stored bytes one piece after the other.
class Source {
 public:
  Source(std::string_view data, bool base64, std::string what)
      : data_(data), base64_(base64), what_(std::move(what)), values_(base64_values()) {}

  std::string take(std::uint64_t n) {
    if (n > data_.size() - at_ + ready_.size()) refuse("its end is missing");
    if (!base64_) {
      at_ += n;
      return std::string(data_.substr(at_ - n, n));
    }
    while (ready_.size() < n) decode_group();
    std::string out = ready_.substr(0, n);
    ready_.erase(0, n);
    return out;
  }
  /// An upper bound.
  std::size_t remaining() const { return data_.size() - at_ + ready_.size(); }
  [[noreturn]] void refuse(const std::string& reason) const {
    throw Error(ExitCode::bad_input, fmt::format("{}: {}.", what_, reason));
  }

 private:
  // Many groups at once, so that pieces of any size cost what they hold.
  void decode_group() {
    for (int group = 0; group < 4096; ++group) {
      std::array<char, 4> four{};
      std::size_t n = 0;
      while (n < 4 && at_ < data_.size()) {
        const char c = data_[at_];
        if (c == '<') break;
        ++at_;
        if (c != ' ' && !(c >= '\t' && c <= '\r')) four[n++] = c;
      }
      if (n < 4 && group > 0) return;
      if (n < 4) refuse("its end is missing");
      const std::size_t digits = four[2] == '=' ? 2 : four[3] == '=' ? 3 : 4;
      std::uint32_t bits = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        const int value = k < digits ? values_[static_cast<unsigned char>(four[k])] : 0;
        if (value < 0) refuse(fmt::format("\"{}\" is no base64", printable({four.data(), 4})));
        bits = bits << 6 | static_cast<std::uint32_t>(value);
      }
      for (std::size_t k = 0; k + 1 < digits; ++k) ready_.push_back(static_cast<char>(bits >> (16 - 8 * k) & 255));
    }
  }

  std::string_view data_;
  bool base64_;
  std::string what_;
  std::array<int, 256> values_;
  std::size_t at_ = 0;
  std::string ready_;
};

std::uint64_t size_of(Source& source, const VtuEncoding& encoding) {
  const std::string bytes = source.take(encoding.long_header ? 8 : 4);
  Scanner in("", bytes);
  in.swap_bytes(encoding.swap);
  return encoding.long_header ? in.binary<std::uint64_t>("a size") : in.binary<std::uint32_t>("a size");
}

std::string decompressed(Source& source, const VtuEncoding& encoding) {
  const std::uint64_t blocks = size_of(source, encoding);
  if (blocks == 0) return {};
  const std::uint64_t full = size_of(source, encoding);
  const std::uint64_t last = size_of(source, encoding);
  if (blocks > source.remaining() || last > full)
    source.refuse(fmt::format("{} blocks of {} bytes, the last of {}, are impossible", blocks, full, last));
  std::vector<std::uint64_t> sizes(blocks);
  for (std::uint64_t& size : sizes) size = size_of(source, encoding);
  std::string out;
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    const std::string block = source.take(sizes[k]);
    const std::uint64_t wanted = k + 1 == sizes.size() && last > 0 ? last : full;
    if (wanted > best_compression * (block.size() + 1)) source.refuse("a block is too small for its contents");
    const std::size_t before = out.size();
    out.resize(before + wanted);
    uLongf got = wanted;
    const int code = uncompress(reinterpret_cast<Bytef*>(out.data() + before), &got,
                                reinterpret_cast<const Bytef*>(block.data()), static_cast<uLong>(block.size()));
    if (code != Z_OK || got != wanted) source.refuse(fmt::format("block {} cannot be decompressed", k));
  }
  return out;
}

}  // namespace

std::string vtu_bytes(std::string_view data, const VtuEncoding& encoding, const std::string& what) {
  Source source(data, encoding.base64, what);
  if (encoding.zlib) return decompressed(source, encoding);
  const std::uint64_t size = size_of(source, encoding);
  return source.take(size);
}

}  // namespace hexfield::io
