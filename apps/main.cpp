#include <fmt/format.h>
#include <mpi.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "commands.hpp"
#include "hexfield/base/agree.hpp"
#include "hexfield/base/session.hpp"
#include "hexfield/base/signals.hpp"
#include "hexfield/base/watchdog.hpp"
#include "hexfield/pipeline/version.hpp"

namespace hexfield::apps {

namespace {}  // namespace

std::string version_text() {
  std::string text = fmt::format("hexfield {} ({})\n", program_version(), program_git());
  for (const auto& [name, version] : library_versions()) text += fmt::format("  {:<20} {}\n", name, version);
  return text + fmt::format("  {:<20} {}", "CLI11", CLI11_VERSION);
}

void end_stopped(const std::string& sentence) {
  fmt::print(stderr, "hexfield: {}\n", sentence);
  std::fflush(stderr);
  std::_Exit(static_cast<int>(ExitCode::stopped));
}

ExitCode on_rank_zero(const std::function<ExitCode()>& work, double patience) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  ExitCode code = ExitCode::success;
  {
    const Watchdog dog([] { return stop_signal() != 0; }, patience, [] { end_stopped("Stopped by a signal."); });
    agree(MPI_COMM_WORLD, [&] {
      if (rank == 0) code = work();
    });
  }
  int number = static_cast<int>(code);
  MPI_Bcast(&number, 1, MPI_INT, 0, MPI_COMM_WORLD);
  return static_cast<ExitCode>(number);
}

namespace {

/// A sentence without its end when the first word is no subcommand; else empty.
std::string unknown_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return "";
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), argv[1]) != names.end()) return "";
  return fmt::format("There is no command '{}'; the commands are {}", argv[1], fmt::join(names, ", "));
}

/// Parses the command line and runs the chosen subcommand.
ExitCode serve(int argc, char** argv, bool speaks) {
  CLI::App app("All-hexahedral meshes from tagged tetrahedral meshes.", "hexfield");
  app.require_subcommand(1);
  app.set_version_flag("--version", version_text, "Versions of the program and its libraries");
  Action action;
  add_run(app, action);
  add_check(app, action);
  add_info(app, action);
  add_convert(app, action);
  add_decompose(app, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    if (speaks) fmt::print("{}", app.help());
    return ExitCode::success;
  } catch (const CLI::CallForAllHelp&) {
    if (speaks) fmt::print("{}", app.help("", CLI::AppFormatMode::All));
    return ExitCode::success;
  } catch (const CLI::CallForVersion& version) {
    if (speaks) fmt::print("{}\n", version.what());
    return ExitCode::success;
  } catch (const CLI::ParseError& error) {
    const std::string unknown = unknown_command(app, argc, argv);
    if (speaks) {
      fmt::print(stderr, "hexfield: {}; --help tells the options.\n", unknown.empty() ? error.what() : unknown);
    }
    return ExitCode::usage;
  }
  return action();
}

}  // namespace
}  // namespace hexfield::apps

int main(int argc, char** argv) {
  using namespace hexfield;
  catch_stop_signals();
  Session session(argc, argv);
  catch_stop_signals();
  const bool speaks = session.rank() == 0;
  ExitCode code = ExitCode::bug;
  try {
    code = apps::serve(argc, argv, speaks);
  } catch (const Error& error) {
    code = error.code();
    if (speaks) fmt::print(stderr, "hexfield: {}\n", error.sentence());
  } catch (const std::exception& error) {
    if (speaks) fmt::print(stderr, "hexfield: unexpected failure: {}.\n", error.what());
  }
  // The launcher ends all ranks when the first leaves with a code other than 0: everything is said before.
  std::fflush(nullptr);
  MPI_Barrier(MPI_COMM_WORLD);
  return static_cast<int>(code);
}
