#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>

namespace hexfield {

/// Lets `write` fill a new file and gives it the name `file` only when it is complete and on the disk; an older
/// file of that name is whole until then. `write` gets a path with the same file name, thus the same extension, in
/// a hidden directory beside it. Not collective.
/// Throws Error(bad_input) with the reason of the system when the disk does not take it; passes on what `write` throws.
void write_whole_file(const std::filesystem::path& file,
                      const std::function<void(const std::filesystem::path&)>& write);

/// Writes a new file of these bytes. Throws Error(bad_input) when the disk does not take them.
void write_bytes(const std::filesystem::path& file, std::span<const std::byte> bytes);

/// Flushes a file (or directory) to the disk. Throws Error(bad_input) when the disk does not take it.
void flush_to_disk(const std::filesystem::path& file);

/// Makes the directory, with its parents, and checks that files can be written into it.
/// Throws Error(bad_input) with the reason of the system.
void make_output_directory(const std::filesystem::path& directory);

}  // namespace hexfield
