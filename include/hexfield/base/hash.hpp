#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace hexfield {

/// SHA-256 (FIPS 180-4) of a stream of bytes; agrees with the command sha256sum.
class Sha256 {
 public:
  void add(std::span<const std::byte> bytes);
  void add(std::string_view text);
  /// 64 lower-case hexadecimal digits of everything added. The object cannot be used afterwards.
  std::string finish();

 private:
  void block(const std::byte* data);

  std::array<std::uint32_t, 8> state_ = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                         0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<std::byte, 64> tail_{};
  std::uint64_t length_ = 0;
};

std::string sha256(std::string_view text);
/// Hash of the bytes of a file from `offset` on. Throws Error(bad_input) when it cannot be read.
std::string sha256_of_file(const std::filesystem::path& file, std::uint64_t offset = 0);

}  // namespace hexfield
