#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "commands.hpp"
#include "hexfield/io/format.hpp"
#include "hexfield/io/hex_io.hpp"
#include "hexfield/mesh/refine.hpp"
#include "read_any.hpp"

namespace hexfield::apps {
namespace {

struct ConvertLine {
  std::string input;
  std::string output;
  std::string formats;
  int refine = 0;
  bool binary = false;
};

/// Files to write: OUT, and OUT with the extension of each further format.
std::vector<std::pair<std::filesystem::path, WriteOptions>> targets(const ConvertLine& line) {
  std::vector<std::pair<std::filesystem::path, WriteOptions>> files;
  WriteOptions how;
  how.binary = line.binary;
  how.format = choose_format(line.output, how);
  files.emplace_back(line.output, how);
  for (const std::string& name : CLI::detail::split(line.formats, ',')) {
    if (name.empty()) continue;
    how.format = format_of_name(name);
    if (!how.format) {
      throw Error(ExitCode::usage,
                  fmt::format("There is no format '{}'; the formats are {}.", name, fmt::join(format_names(), ", ")));
    }
    const std::filesystem::path file = std::filesystem::path(line.output).replace_extension(extension_of(*how.format));
    if (file != line.output) files.emplace_back(file, how);
  }
  return files;
}

ExitCode convert_command(const ConvertLine& line) {
  return on_rank_zero([&] {
    const auto files = targets(line);
    auto mesh = read_any_mesh(line.input);
    if (auto* tets = std::get_if<TetInput>(&mesh)) {
      for (int k = 0; k < line.refine; ++k) refine_uniform(tets->mesh, tets->features);
      for (const auto& [file, how] : files) write_tet_mesh(file, tets->mesh, tets->features, how);
    } else {
      if (line.refine > 0) throw Error(ExitCode::usage, "--refine is for tet meshes; this is a hex mesh.");
      for (const auto& [file, how] : files) write_hex_mesh(file, std::get<HexMesh>(mesh), how);
    }
    return ExitCode::success;
  });
}

}  // namespace

void add_convert(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("convert", "From one mesh format to another; the extension of OUT decides");
  auto line = std::make_shared<ConvertLine>();
  command->add_option("IN", line->input, "Tet or hex mesh")->required();
  command->add_option("OUT", line->output, "File to write (.vtk, .vtu, .msh, .mesh, .inp)")->required();
  command->add_option("--refine", line->refine, "Split every tet into eight, K times")->check(CLI::Range(0, 10));
  command->add_option("--formats", line->formats, "Further formats beside OUT: vtk,vtu,msh,msh22,mesh,inp");
  command->add_flag("--binary", line->binary, "The binary variant of the format, where it has one");
  command->callback([line, &action] { action = [line] { return convert_command(*line); }; });
}

}  // namespace hexfield::apps
