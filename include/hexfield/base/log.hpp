#pragma once

#include <mpi.h>

#include <filesystem>
#include <memory>
#include <string>

namespace hexfield {

enum class LogLevel { debug, info, warning, error, off };

/// What a run says: to the terminal of rank 0 (warnings and errors to stderr, the rest to stdout) and to a
/// log file. Lines said before open_file() are kept and written to it when it opens.
class Log {
 public:
  /// `terminal` is the lowest level shown on the terminal; the file gets everything.
  Log(MPI_Comm comm, LogLevel terminal);
  ~Log();
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;

  /// Starts the file (rank 0 writes it; an older file is kept and appended to when `append`).
  /// Throws Error(bad_input) on rank 0 when it cannot be written. Not collective.
  void open_file(const std::filesystem::path& file, bool append);

  /// Rank 0 says `sentence`; the others are silent. Not collective.
  void say(LogLevel level, const std::string& sentence);
  void debug(const std::string& sentence) { say(LogLevel::debug, sentence); }
  void info(const std::string& sentence) { say(LogLevel::info, sentence); }
  void warning(const std::string& sentence) { say(LogLevel::warning, sentence); }
  void error(const std::string& sentence) { say(LogLevel::error, sentence); }

  /// Rank 0 says the sentences of all ranks in rank order, each with its rank; empty ones are left out. Collective.
  void say_on_all_ranks(LogLevel level, const std::string& sentence);

  /// This process says `sentence` at once, whatever its rank, with its rank; for a rank that fails alone.
  void say_alone(LogLevel level, const std::string& sentence);

  /// Replaces the transient last line of an interactive terminal (empty: removes it); nothing elsewhere.
  void transient_line(const std::string& text);
  /// True on rank 0 when its stderr is an interactive terminal and info lines are shown.
  bool interactive() const;

  void flush();

 private:
  struct Sinks;
  std::unique_ptr<Sinks> sinks_;
  MPI_Comm comm_;
  int rank_ = 0;
  int size_ = 1;
};

}  // namespace hexfield
