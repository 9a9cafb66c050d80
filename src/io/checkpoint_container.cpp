#include "checkpoint_container.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>

#include "hexfield/base/error.hpp"
#include "hexfield/base/hash.hpp"
#include "hexfield/io/checkpoint.hpp"
#include "hexfield/io/whole_file.hpp"

namespace hexfield {
namespace fs = std::filesystem;
namespace {

constexpr const char* magic = "hexfield checkpoint\n";

std::string user_block(std::uint64_t bytes, const std::string& digest) {
  std::string block = fmt::format("{}schema {}\nbytes {}\nsha256 {}\n", magic, checkpoint_schema, bytes, digest);
  block.resize(hdf5::user_block_size, '\0');
  return block;
}

void write_user_block(std::span<std::byte> image) {
  Sha256 hash;
  hash.add(image.subspan(hdf5::user_block_size));
  const std::string block = user_block(image.size(), hash.finish());
  std::memcpy(image.data(), block.data(), block.size());
}

std::string first_bytes(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || fs::is_directory(file)) {
    throw Error(ExitCode::bad_input, fmt::format("Cannot read the checkpoint {}: {}.", file.string(),
                                                 fs::is_directory(file) ? "it is a directory" : std::strerror(errno)));
  }
  std::array<char, hdf5::user_block_size> block{};
  stream.read(block.data(), block.size());
  return {block.data(), static_cast<std::size_t>(stream.gcount())};
}

Error refused(const fs::path& file, const std::string& why) {
  return Error(ExitCode::bad_input, fmt::format("The checkpoint {} {}.", file.string(), why));
}

}  // namespace

bool looks_like_checkpoint(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string block(std::strlen(magic), '\0');
  stream.read(block.data(), static_cast<std::streamsize>(block.size()));
  return stream && block == magic;
}

void write_container(const fs::path& file, const std::function<void(hdf5::File&)>& fill) {
  hdf5::File made = hdf5::File::create(file);
  fill(made);
  const std::span<std::byte> image = made.image();
  write_user_block(image);
  write_whole_file(file, [&](const fs::path& fresh) { write_bytes(fresh, image); });
}

hdf5::File open_container(const fs::path& file) {
  const std::string block = first_bytes(file);
  if (!block.starts_with(magic)) {
    throw refused(file, block.empty() ? "is empty" : "was not written by hexfield");
  }
  std::istringstream text(block.substr(std::strlen(magic)));
  std::string word_schema;
  std::string word_bytes;
  std::string word_digest;
  std::string digest;
  long schema = 0;
  std::uint64_t bytes = 0;
  text >> word_schema >> schema;
  if (!text || word_schema != "schema") throw refused(file, "is torn: its first lines are not readable");
  if (schema > checkpoint_schema) {
    throw refused(file, fmt::format("has schema {}, written by a newer hexfield; this one reads up to schema {}",
                                    schema, checkpoint_schema));
  }
  text >> word_bytes >> bytes >> word_digest >> digest;
  if (!text || word_bytes != "bytes" || word_digest != "sha256") {
    throw refused(file, "is torn: its first lines are not readable");
  }
  if (const auto size = fs::file_size(file); size != bytes) {
    throw refused(file, fmt::format("is torn: it has {} bytes instead of {}", size, bytes));
  }
  if (sha256_of_file(file, hdf5::user_block_size) != digest) {
    throw refused(file, "is damaged: its bytes do not match its SHA-256");
  }
  return hdf5::File::open(file);
}

}  // namespace hexfield
