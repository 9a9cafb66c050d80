#pragma once

#include <filesystem>
#include <functional>

#include "hdf5_file.hpp"

namespace hexfield {

/// Writes a whole file of the checkpoint layout (io/checkpoint.hpp) and puts it in the place of `file`;
/// `fill` adds groups and attributes to it.
void write_container(const std::filesystem::path& file, const std::function<void(hdf5::File&)>& fill);

/// Checks the user block, the size and the hash of the file and opens it.
/// Throws Error(bad_input) saying whether it is missing, foreign, newer or torn.
hdf5::File open_container(const std::filesystem::path& file);

}  // namespace hexfield
