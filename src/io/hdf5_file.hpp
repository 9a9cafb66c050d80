#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "hexfield/io/named_arrays.hpp"

namespace hexfield::hdf5 {

/// Bytes before the HDF5 superblock that belong to us.
inline constexpr std::uint64_t user_block_size = 512;

/// An open HDF5 file with a user block; groups of arrays with text attributes. Every failure is an
/// Error(bad_input) that names the file. HDF5 handles stay inside.
class File {
 public:
  /// A new file in memory: HDF5 cannot go on after a write to the disk that failed, so the disk is left to us.
  /// `path` is for sentences only.
  static File create(const std::filesystem::path& path);
  static File open(const std::filesystem::path& path);
  File(File&& other) noexcept;
  File(const File&) = delete;
  ~File();

  void set_text(const std::string& group, const std::string& attribute, const std::string& text);
  std::string get_text(const std::string& group, const std::string& attribute) const;
  bool has_attribute(const std::string& group, const std::string& attribute) const;
  void make_group(const std::string& group);
  std::vector<std::string> groups() const;
  void write(const std::string& group, const std::string& name, const NamedArray& array);
  NamedArrays read(const std::string& group) const;
  /// Copies a group of another file with all it holds.
  void copy_group(const File& from, const std::string& group);
  /// All bytes of a file in memory, user block included; valid until the next call.
  std::span<std::byte> image();

 private:
  File(std::filesystem::path path, std::int64_t id) : path_(std::move(path)), id_(id) {}
  [[noreturn]] void fail(const std::string& what) const;

  std::filesystem::path path_;
  std::int64_t id_ = -1;
};

}  // namespace hexfield::hdf5
