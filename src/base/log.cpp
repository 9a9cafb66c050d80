#include "hexfield/base/log.hpp"

#include <fmt/format.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <string_view>
#include <vector>

#include "hexfield/base/error.hpp"

namespace hexfield {
namespace {

spdlog::level::level_enum level_of(LogLevel level) {
  switch (level) {
    case LogLevel::debug:
      return spdlog::level::debug;
    case LogLevel::info:
      return spdlog::level::info;
    case LogLevel::warning:
      return spdlog::level::warn;
    case LogLevel::error:
      return spdlog::level::err;
    case LogLevel::off:
      return spdlog::level::off;
  }
  return spdlog::level::info;
}

}  // namespace

struct Log::Sinks {
  // Loggers are not registered with spdlog: nothing global, and two Logs do not meet.
  spdlog::logger out{"out", std::make_shared<spdlog::sinks::stdout_sink_mt>()};
  spdlog::logger err{"err", std::make_shared<spdlog::sinks::stderr_sink_mt>()};
  std::unique_ptr<spdlog::logger> file;
  std::vector<std::pair<LogLevel, std::string>> kept;
  LogLevel terminal = LogLevel::info;
  bool line_open = false;
};

Log::Log(MPI_Comm comm, LogLevel terminal) : sinks_(std::make_unique<Sinks>()), comm_(comm) {
  MPI_Comm_rank(comm, &rank_);
  MPI_Comm_size(comm, &size_);
  sinks_->terminal = terminal;
  sinks_->out.set_pattern("%v");
  sinks_->err.set_pattern("%v");
  sinks_->out.set_level(level_of(terminal));
  sinks_->err.set_level(level_of(terminal));
  sinks_->out.flush_on(spdlog::level::trace);
}

Log::~Log() {
  transient_line("");
  flush();
}

void Log::open_file(const std::filesystem::path& file, bool append) {
  if (rank_ != 0) return;
  try {
    auto sink = std::make_shared<spdlog::sinks::basic_file_sink_mt>(file.string(), !append);
    sinks_->file = std::make_unique<spdlog::logger>("file", sink);
  } catch (const spdlog::spdlog_ex& failure) {
    throw Error(ExitCode::bad_input, fmt::format("Cannot write the log {}: {}.", file.string(), failure.what()));
  }
  // A full disk must not end a run through its log; the result files report that.
  sinks_->file->set_error_handler([](const std::string&) {});
  sinks_->file->set_level(spdlog::level::debug);
  sinks_->file->set_pattern("%Y-%m-%d %H:%M:%S.%e %-8l %v");
  // What a killed run did last must stand in its log.
  sinks_->file->flush_on(spdlog::level::debug);
  for (const auto& [level, sentence] : sinks_->kept) sinks_->file->log(level_of(level), sentence);
  sinks_->kept.clear();
}

void Log::say(LogLevel level, const std::string& sentence) {
  if (rank_ != 0) return;
  transient_line("");
  (level >= LogLevel::warning ? sinks_->err : sinks_->out).log(level_of(level), sentence);
  if (sinks_->file) {
    sinks_->file->log(level_of(level), sentence);
  } else {
    sinks_->kept.emplace_back(level, sentence);
  }
}

void Log::say_on_all_ranks(LogLevel level, const std::string& sentence) {
  const int mine = static_cast<int>(sentence.size());
  std::vector<int> lengths(static_cast<std::size_t>(size_));
  MPI_Gather(&mine, 1, MPI_INT, lengths.data(), 1, MPI_INT, 0, comm_);
  std::vector<int> offsets(lengths.size() + 1, 0);
  for (std::size_t r = 0; r < lengths.size(); ++r) offsets[r + 1] = offsets[r] + lengths[r];
  std::string all(static_cast<std::size_t>(offsets.back()), ' ');
  MPI_Gatherv(sentence.data(), mine, MPI_CHAR, all.data(), lengths.data(), offsets.data(), MPI_CHAR, 0, comm_);
  if (rank_ != 0) return;
  for (std::size_t r = 0; r < lengths.size(); ++r) {
    if (lengths[r] == 0) continue;
    const auto text =
        std::string_view(all).substr(static_cast<std::size_t>(offsets[r]), static_cast<std::size_t>(lengths[r]));
    say(level, fmt::format("rank {}: {}", r, text));
  }
}

void Log::say_alone(LogLevel level, const std::string& sentence) {
  const std::string text = size_ > 1 ? fmt::format("rank {}: {}", rank_, sentence) : sentence;
  if (rank_ == 0) return say(level, text);
  sinks_->err.log(level_of(level), text);
  sinks_->err.flush();
}

bool Log::interactive() const { return rank_ == 0 && sinks_->terminal <= LogLevel::info && isatty(STDERR_FILENO) == 1; }

void Log::transient_line(const std::string& text) {
  if (!interactive() || (text.empty() && !sinks_->line_open)) return;
  // Carriage return and "erase to end of line", without a line break.
  const std::string bytes = "\r\x1b[K" + text;
  sinks_->line_open = !text.empty();
  [[maybe_unused]] const auto written = write(STDERR_FILENO, bytes.data(), bytes.size());
}

void Log::flush() {
  sinks_->out.flush();
  sinks_->err.flush();
  if (sinks_->file) sinks_->file->flush();
}

}  // namespace hexfield
