#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <functional>

#include "hexfield/io/debug_vtk.hpp"
#include "hexfield/io/hex_io.hpp"
#include "hexfield/io/hexex_io.hpp"
#include "hexfield/io/tet_io.hpp"
#include "io/samples.hpp"

using namespace hexfield;

namespace {

/// A disk that takes no more than `bytes` per file, for the lifetime of the object.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &old_);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, old_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SmallDisk() {
    setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, handler_);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

 private:
  rlimit old_{};
  void (*handler_)(int) = SIG_DFL;
};

void expect_refused(const std::filesystem::path& file, const std::function<void()>& write, const std::string& reason) {
  try {
    write();
    FAIL() << "written: " << file;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    EXPECT_NE(error.sentence().find(file.filename().string()), std::string::npos) << error.sentence();
    EXPECT_NE(error.sentence().find(reason), std::string::npos) << error.sentence();
  }
}

const char* const endings[] = {".vtk", ".vtu", ".msh", ".msh2", ".mesh", ".inp"};

}  // namespace

TEST(BadOutput, AMissingDirectoryIsNamed) {
  const HexMesh mesh = samples::tagged_hexes();
  for (const char* ending : endings) {
    const auto file = samples::scratch_file("nowhere") / (std::string("hex") + ending);
    expect_refused(
        file, [&] { write_hex_mesh(file, mesh); }, "No such file or directory");
  }
  const auto file = samples::scratch_file("nowhere") / "why.vtk";
  expect_refused(
      file, [&] { write_vtk_debug(file, {}, {}, {}); }, "No such file or directory");
}

TEST(BadOutput, AFullDiskLeavesTheOldFileAndNothingElse) {
  const hexfield::testing::ScratchDirectory folder;
  const HexMesh mesh = samples::tagged_hexes();
  for (const char* ending : endings) {
    const auto file = folder / (std::string("hex") + ending);
    hexfield::testing::write_bytes(file, "old");
    {
      const SmallDisk disk(100);
      expect_refused(
          file, [&] { write_hex_mesh(file, mesh); }, "File too large");
    }
    EXPECT_EQ(hexfield::testing::bytes_of(file), "old");
  }
  std::size_t entries = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) ++entries;
  EXPECT_EQ(entries, std::size(endings));
}
