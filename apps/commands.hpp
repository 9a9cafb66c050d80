#pragma once

#include <CLI/App.hpp>

#include <functional>

#include "hexfield/base/error.hpp"

/// The subcommands of the program, one file each.
namespace hexfield::apps {

/// Runs the subcommand that was chosen; the same exit code on all ranks. Collective.
using Action = std::function<ExitCode()>;

void add_run(CLI::App& app, Action& action);
void add_check(CLI::App& app, Action& action);
void add_info(CLI::App& app, Action& action);
void add_convert(CLI::App& app, Action& action);
void add_decompose(CLI::App& app, Action& action);

/// Version of the program and of its libraries, for --version.
std::string version_text();

/// Says the sentence and ends the process with ExitCode::stopped, whatever its other threads do.
[[noreturn]] void end_stopped(const std::string& sentence);

/// Runs `work` on rank 0 and gives its exit code to all; exceptions become the same Error on all. `patience` seconds
/// after a stop signal the process ends, whether `work` has heard it or not. Collective.
ExitCode on_rank_zero(const std::function<ExitCode()>& work, double patience = 3);

}  // namespace hexfield::apps
