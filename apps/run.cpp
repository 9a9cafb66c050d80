#include "hexfield/pipeline/run.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "commands.hpp"
#include "hexfield/base/parallel.hpp"
#include "hexfield/io/format.hpp"
#include "hexfield/pipeline/option_table.hpp"
#include "hexfield/pipeline/stage_names.hpp"

namespace hexfield::apps {
namespace {

/// The command line of `run` as it was typed: an option that was not given is empty.
struct RunLine {
  std::string input;
  std::string output;
  std::string config;
  std::vector<std::string> assignments;
  std::vector<std::pair<std::string, std::shared_ptr<std::string>>> explicit_values;  ///< key, text
  std::string from;
  std::string to;
  bool resume = false;
  bool check = false;
  bool decompose = false;
  bool verbose = false;
  bool quiet = false;
};

/// Option `name` of the command line sets the key `key` of the option table.
void add_keyed(CLI::App& command, RunLine& line, const std::string& name, const std::string& key,
               const std::string& what, const std::string& type) {
  auto text = std::make_shared<std::string>();
  line.explicit_values.emplace_back(key, text);
  command.add_option(name, *text, what)->type_name(type);
}

void require_formats(const std::vector<std::string>& formats) {
  for (const std::string& name : formats) {
    if (!format_of_name(name)) {
      throw Error(ExitCode::usage,
                  fmt::format("There is no format '{}'; the formats are {}.", name, fmt::join(format_names(), ", ")));
    }
  }
}

/// Defaults, then the configuration file, then --set, then the options of their own.
RunOptions options_of(const RunLine& line) {
  RunOptions options;
  OptionTable table(options);
  if (!line.config.empty()) table.read_file(line.config);
  for (const std::string& assignment : line.assignments) table.set_assignment(assignment);
  for (const auto& [key, text] : line.explicit_values) {
    if (!text->empty()) table.set(key, *text, ExitCode::usage, "command line");
  }
  options.input = line.input;
  options.output = line.output;
  options.from = line.from.empty() ? "" : resolve_stage(line.from);
  options.to = line.to.empty() ? "" : resolve_stage(line.to);
  options.resume = line.resume;
  options.check = options.check || line.check;
  options.decompose = options.decompose || line.decompose;
  require_formats(options.formats);
  return options;
}

ExitCode run_command(const RunLine& line) {
  const RunOptions options = options_of(line);
  if (options.threads > 0) set_threads(options.threads);
  Log log(MPI_COMM_WORLD, line.quiet ? LogLevel::warning : (line.verbose ? LogLevel::debug : LogLevel::info));
  const Outcome outcome = run(MPI_COMM_WORLD, options, log, end_stopped);
  const LogLevel level = outcome.code == ExitCode::success ? LogLevel::info : LogLevel::error;
  log.say(level, "hexfield: " + outcome.sentence);
  log.flush();
  return outcome.code;
}

}  // namespace

void add_run(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("run", "Mesh INPUT with hexahedra: the whole way, or a part of it");
  auto line = std::make_shared<RunLine>();
  command
      ->add_option("INPUT", line->input,
                   "Tet mesh with tagged features (.vtk, .msh, .mesh), or a seamless map (.hexex)")
      ->required();
  command->add_option("-o,--output", line->output, "Directory for everything that is written")->required();
  auto* hexes = command->add_option_group("size");
  add_keyed(*hexes, *line, "--target-hexes", "target_hexes", "Wanted number of hexes (10000)", "N");
  add_keyed(*hexes, *line, "--edge-length", "edge_length", "Wanted edge length in input units", "L");
  hexes->require_option(0, 1);
  add_keyed(*command, *line, "--quantizer", "quantizer", "Integers by pump, ilp or rounding (pump)", "NAME");
  add_keyed(*command, *line, "--min-layers", "min_layers", "Hexes along every feature and singular arc (1)", "K");
  command->add_option("--from", line->from,
                      "Compute this stage and all after it anew, those before from the checkpoint");
  command->add_option("--to", line->to, "End after this stage");
  command->add_flag("--resume", line->resume, "Take finished stages from the checkpoint in DIR");
  command->add_option("--config", line->config, "Options from a TOML file");
  command->add_option("--set", line->assignments, "One option as in the file, can be repeated")->type_name("KEY=VALUE");
  command->get_option("--set")->allow_extra_args(false);
  add_keyed(*command, *line, "--threads", "threads", "Threads per rank (the cores given to the rank)", "T");
  add_keyed(*command, *line, "--time-limit", "time_limit", "Stop at the next safe point after this time", "SECONDS");
  add_keyed(*command, *line, "--checkpoint-interval", "checkpoint_interval", "Between checkpoints in long solves (30)",
            "SECONDS");
  add_keyed(*command, *line, "--formats", "formats", "Formats of the hex mesh: vtk,vtu,msh,msh22,mesh,inp", "LIST");
  add_keyed(*command, *line, "--feature-angle", "feature_angle", "Sharp edges where the input has no tags (70)", "DEG");
  add_keyed(*command, *line, "--tries", "tries", "Settings of the field repair to try before giving up (4)", "K");
  add_keyed(*command, *line, "--seed", "seed", "Of anything random (0)", "S");
  command->add_flag("--decompose", line->decompose, "Singular nodes into curves, where that raises the quality");
  command->add_flag("--check", line->check, "Check every value between the stages");
  auto* verbose = command->add_flag("-v,--verbose", line->verbose, "Say more");
  command->add_flag("-q,--quiet", line->quiet, "Say nothing but warnings and errors")->excludes(verbose);
  command->callback([line, &action] { action = [line] { return run_command(*line); }; });
}

}  // namespace hexfield::apps
