#include "hexfield/io/whole_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "hexfield/base/error.hpp"

namespace hexfield {
namespace fs = std::filesystem;
namespace {

Error cannot(const char* what, const fs::path& file, const std::string& reason) {
  return Error(ExitCode::bad_input, fmt::format("Cannot {} {}: {}.", what, file.string(), reason));
}

fs::path parent_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

/// Removes a directory with what is left in it at the end of the scope.
struct Scratch {
  explicit Scratch(fs::path p) : path(std::move(p)) {}
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  fs::path path;
};

}  // namespace

void flush_to_disk(const fs::path& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw cannot("open", file, std::strerror(errno));
  const int failed = fsync(descriptor) == 0 ? 0 : errno;
  close(descriptor);
  // Some file systems cannot flush directories; their renames are safe or not, we cannot do more.
  if (failed != 0 && failed != EINVAL) throw cannot("write", file, std::strerror(failed));
}

void write_bytes(const fs::path& file, std::span<const std::byte> bytes) {
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) throw cannot("write", file, std::strerror(errno));
  int failed = 0;
  while (!bytes.empty() && failed == 0) {
    const ssize_t taken = write(descriptor, bytes.data(), bytes.size());
    if (taken > 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(taken));
    } else if (taken == 0 || errno != EINTR) {
      failed = taken == 0 ? ENOSPC : errno;
    }
  }
  if (close(descriptor) != 0 && failed == 0) failed = errno;
  if (failed != 0) throw cannot("write", file, std::strerror(failed));
}

void write_whole_file(const fs::path& file, const std::function<void(const fs::path&)>& write) {
  const fs::path directory = parent_of(file);
  const Scratch scratch(directory / fmt::format(".{}.writing", file.filename().string()));
  std::error_code failure;
  fs::remove_all(scratch.path, failure);
  fs::create_directory(scratch.path, failure);
  if (failure) throw cannot("write", file, failure.message());
  const fs::path fresh = scratch.path / file.filename();
  try {
    write(fresh);
    flush_to_disk(fresh);
  } catch (const Error& error) {
    // The reader knows the file by its own name.
    std::string sentence = error.sentence();
    const std::size_t at = sentence.find(fresh.string());
    if (at != std::string::npos) sentence.replace(at, fresh.string().size(), file.string());
    throw Error(error.code(), sentence, error.ids(), error.places());
  }
  fs::rename(fresh, file, failure);
  if (failure) throw cannot("write", file, failure.message());
  flush_to_disk(directory);
}

void make_output_directory(const fs::path& directory) {
  std::error_code failure;
  if (fs::exists(directory, failure) && !fs::is_directory(directory, failure)) {
    throw cannot("use", directory, "it is a file, not a directory");
  }
  fs::create_directories(directory, failure);
  if (failure) throw cannot("make the directory", directory, failure.message());
  const fs::path probe = directory / ".hexfield.probe";
  const int descriptor = open(probe.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) throw cannot("write into", directory, std::strerror(errno));
  // A full disk takes the name of a file but not its bytes.
  const std::string bytes(4096, '\n');
  const bool written =
      ::write(descriptor, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()) && fsync(descriptor) == 0;
  const int reason = errno;
  close(descriptor);
  fs::remove(probe, failure);
  if (!written) throw cannot("write into", directory, std::strerror(reason));
}

}  // namespace hexfield
