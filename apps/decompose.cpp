#include "hexfield/hex/decompose.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "commands.hpp"
#include "hex_graph.hpp"
#include "hexfield/base/parallel.hpp"
#include "hexfield/base/signals.hpp"
#include "hexfield/base/stopwatch.hpp"
#include "hexfield/hex/check.hpp"
#include "hexfield/hex/hex_surface.hpp"
#include "hexfield/hex/improve.hpp"
#include "hexfield/hex/sheet.hpp"
#include "hexfield/io/hex_io.hpp"

namespace hexfield::apps {
namespace {

struct DecomposeLine {
  std::string input;
  std::string output;
  std::string search = "exact";
  DecomposeOptions options;
  double feature_angle = default_feature_angle_degrees;
  bool free_boundary = false;
  int pad = 0;
  int threads = 0;
  double time_limit = 0;  ///< seconds, 0: none
};

/// The mesh file and the picture of the singular graph that OUT stands for.
std::pair<std::filesystem::path, std::filesystem::path> outputs(const std::string& output) {
  const std::filesystem::path path(output);
  if (format_of_name(path.extension().string())) {
    if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
    return {path, std::filesystem::path(path).replace_extension(".singularities.vtk")};
  }
  std::filesystem::create_directories(path);
  return {path / "hex.vtk", path / "singularities.vtk"};
}

/// Why nodes are left, to follow "N nodes are left; ".
std::string reason(const Decomposition& done) {
  if (done.stopped) return "the search was stopped";
  if (done.proven) return "the search was exhaustive: no straight sheet lowers the measure";
  if (done.sheets_refused > 0) return "sheets were found, but a hex of theirs could not be made positive";
  return fmt::format("the search was not exhaustive: it met its limit of {}", fmt::join(done.limits, " and of "));
}

void print_rest(const Decomposition& done) {
  if (done.nodes_left.empty()) return;
  fmt::print("{} nodes are left; {}\n", done.nodes_left.size(), reason(done));
  for (const auto& node : done.nodes_left) {
    const Vec3& p = done.mesh.points[static_cast<std::size_t>(node.vertex)];
    fmt::print("  {} at ({:.6g}, {:.6g}, {:.6g})\n", node.signature, p.x(), p.y(), p.z());
  }
}

constexpr double winding_up = 60;  // seconds to write what was reached

ExitCode decompose_command(const DecomposeLine& line) {
  const Clock::time_point start = Clock::now();
  if (line.threads > 0) set_threads(line.threads);
  return on_rank_zero(
      [&] {
        const auto [file, picture] = outputs(line.output);
        HexMesh mesh = read_hex_mesh(line.input);
        require_good_hexes(line.input, mesh);
        for (int k = 0; k < line.pad; ++k) mesh = pad(mesh, build_hex_complex(mesh));
        HexSurface surface;
        if (!line.free_boundary) surface = complete_hex_features(mesh, line.feature_angle);
        const HexShape shape = line.free_boundary ? HexShape{} : HexShape{&surface.mesh, &surface.features};
        fmt::print("before: {} hexes, smallest scaled Jacobian {:.4f}\n", mesh.hexes.size(), quality(mesh).min);
        print_graph(hex_singular_graph(mesh, build_hex_complex(mesh)));
        DecomposeOptions options = line.options;
        if (line.search == "greedy") options.search = DecomposeOptions::Search::greedy;
        Control control;
        control.stop_requested = [&] {
          return stop_signal() != 0 || (line.time_limit > 0 && seconds_since(start) > line.time_limit);
        };
        const Decomposition done = decompose_on_shape(mesh, shape, options, control);
        for (std::size_t k = 0; k < done.steps.size(); ++k)
          fmt::print("sheet {}: {} quads, measure {}\n", k + 1, done.steps[k].quads.size(), done.steps[k].measure);
        const HexMesh& result = done.mesh;
        const HexSingularGraph graph = hex_singular_graph(result, build_hex_complex(result));
        fmt::print("after {} sheets: {} hexes, smallest scaled Jacobian {:.4f}\n", done.steps.size(),
                   result.hexes.size(), quality(result).min);
        print_graph(graph);
        print_rest(done);
        write_hex_mesh(file, result);
        write_graph(picture, result, graph);
        if (!check(result).empty()) return ExitCode::bad_hex_mesh;
        if (!done.stopped) return ExitCode::success;
        throw Error(ExitCode::stopped,
                    fmt::format("Stopped by {}; {} holds what was reached, and can be decomposed further.",
                                stop_signal() != 0 ? "a signal" : "the time limit", file.string()));
      },
      winding_up);
}

}  // namespace

void add_decompose(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("decompose", "Pull the singular nodes of a hex mesh apart into singular curves");
  auto line = std::make_shared<DecomposeLine>();
  command->add_option("IN", line->input, "Hex mesh (.vtk, .vtu, .msh, .mesh)")->required();
  command->add_option("-o,--output", line->output, "Mesh file to write, or a directory for it")->required();
  command->add_option("--search", line->search, "exact, or greedy as in the paper (exact)")
      ->check(CLI::IsMember({"exact", "greedy"}));
  command->add_option("--budget", line->options.budget, "Patches tried in all; 0 only improves the mesh (5000000)");
  command->add_option("--width", line->options.width, "Sequences followed side by side (by size)");
  command->add_option("--final-valence", line->options.final_valence, "Highest valence of curves that may stay (5)")
      ->check(CLI::Range(5, 6));
  command->add_option("--pad", line->pad, "Layers of hexes to put along the boundary first (0)")
      ->check(CLI::Range(0, 10));
  command->add_flag("--free-boundary", line->free_boundary, "Let the boundary go anywhere: the shape is not kept");
  command->add_option("--feature-angle", line->feature_angle, "Sharp edges where the input has no tags (70)");
  command->add_option("--threads", line->threads, "Threads (the cores given to the process)");
  command->add_option("--time-limit", line->time_limit, "Stop after this time, with what was reached (none)")
      ->check(CLI::NonNegativeNumber);
  command->callback([line, &action] { action = [line] { return decompose_command(*line); }; });
}

}  // namespace hexfield::apps
