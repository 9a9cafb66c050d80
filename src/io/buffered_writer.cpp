#include "buffered_writer.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "hexfield/base/error.hpp"
#include "hexfield/io/whole_file.hpp"

namespace hexfield::io {

BufferedWriter::BufferedWriter(const std::filesystem::path& file, std::filesystem::path shown)
    : shown_(std::move(shown)) {
  descriptor_ = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail(errno);
}

BufferedWriter::~BufferedWriter() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void BufferedWriter::close() {
  flush();
  if (::close(std::exchange(descriptor_, -1)) != 0) fail(errno);
}

void BufferedWriter::flush() {
  const char* data = buffer_.data();
  std::size_t left = buffer_.size();
  while (left > 0) {
    const ssize_t n = ::write(descriptor_, data, left);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail(n < 0 ? errno : ENOSPC);
    data += n;
    left -= static_cast<std::size_t>(n);
  }
  buffer_.clear();
}

void BufferedWriter::fail(int error) const {
  throw Error(ExitCode::bad_input,
              fmt::format("Cannot write {}: {}.", shown_.string(), std::generic_category().message(error)));
}

void write_file(const std::filesystem::path& file, const std::function<void(BufferedWriter&)>& fill) {
  write_whole_file(file, [&](const std::filesystem::path& fresh) {
    BufferedWriter out(fresh, file);
    fill(out);
    out.close();
  });
}

}  // namespace hexfield::io
