#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "hexfield/io/hexex_io.hpp"
#include "support/scratch.hpp"

namespace hexfield::testing {

inline std::filesystem::path shared_data() {
  const char* other = std::getenv("HEXFIELD_SHARED_DATA");
  return other != nullptr ? std::filesystem::path(other)
                          : std::filesystem::path(HEXFIELD_SOURCE_DIR) / ".." / "shared" / "data";
}

/// All files of the shared data that hold a seamless map, sorted; empty where there are none.
inline std::vector<std::filesystem::path> seamless_models() {
  std::vector<std::filesystem::path> files;
  for (const char* folder : {"seamless-maps", "igm-maps"}) {
    if (!std::filesystem::exists(shared_data() / folder)) continue;
    for (const auto& entry : std::filesystem::directory_iterator(shared_data() / folder)) {
      const std::string name = entry.path().filename().string();
      if (name.ends_with("_MC.hexex.zst") || name.ends_with(".seamless.hexex.zst")) files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

inline HexexInput read_packed(const std::filesystem::path& packed) {
  const ScratchDirectory scratch;
  const std::filesystem::path file = scratch / "map.hexex";
  const std::string command = "zstd -qdc '" + packed.string() + "' > '" + file.string() + "'";
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  return read_hexex(file);
}

}  // namespace hexfield::testing
