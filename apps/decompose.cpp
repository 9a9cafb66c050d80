#include "hexfield/hex/decompose.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "commands.hpp"
#include "hex_graph.hpp"
#include "hexfield/base/parallel.hpp"
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
};

/// Refuses a mesh that sheets cannot be put into, with the first defect and its place.
void require_good(const std::string& file, const HexMesh& mesh) {
  std::vector<Violation> found = check(mesh);
  if (found.empty()) found = check_for_sheets(mesh, build_hex_complex(mesh));
  if (found.empty()) return;
  std::string place;
  if (!found[0].places.empty()) {
    const Vec3& p = found[0].places[0];
    place = fmt::format(" Place: ({:.6g}, {:.6g}, {:.6g}).", p.x(), p.y(), p.z());
  }
  throw Error(ExitCode::bad_input,
              fmt::format("{}: {} defects, the first: {}{}", file, found.size(), found[0].sentence, place),
              found[0].ids, found[0].places);
}

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

/// Moves vertices: boundary sliding on the shape of the input, or free.
class Mover {
 public:
  Mover(HexMesh& mesh, const DecomposeLine& line) : free_(line.free_boundary) {
    if (!free_) surface_ = complete_hex_features(mesh, line.feature_angle);
  }
  void settle(HexMesh& mesh) const {
    ImproveOptions quick;
    quick.max_rounds = 5;
    improve(mesh, quick);
  }
  void finish(HexMesh& mesh) const {
    ImproveOptions thorough;
    thorough.good_enough = 0.95;
    thorough.max_rounds = 100;
    improve(mesh, thorough);
    MaximiseOptions last;
    last.free_boundary = free_;
    maximise_minimum(mesh, last, {});
  }

 private:
  void improve(HexMesh& mesh, const ImproveOptions& options) const {
    if (free_)
      improve_free_hex_mesh(mesh, options, {});
    else
      improve_hex_mesh(mesh, surface_.mesh, surface_.features, options, {});
  }
  bool free_;
  HexSurface surface_;
};

ExitCode decompose_command(const DecomposeLine& line) {
  if (line.threads > 0) set_threads(line.threads);
  return on_rank_zero([&] {
    const auto [file, picture] = outputs(line.output);
    HexMesh mesh = read_hex_mesh(line.input);
    require_good(line.input, mesh);
    for (int k = 0; k < line.pad; ++k) mesh = pad(mesh, build_hex_complex(mesh));
    const Mover mover(mesh, line);
    fmt::print("before: {} hexes, smallest scaled Jacobian {:.4f}\n", mesh.hexes.size(), quality(mesh).min);
    print_graph(hex_singular_graph(mesh, build_hex_complex(mesh)));
    DecomposeOptions options = line.options;
    if (line.search == "greedy") options.search = DecomposeOptions::Search::greedy;
    const Decomposition done = decompose(mesh, options, [&](HexMesh& now) { mover.settle(now); }, {});
    for (std::size_t k = 0; k < done.steps.size(); ++k)
      fmt::print("sheet {}: {} quads, measure {}\n", k + 1, done.steps[k].quads.size(), done.steps[k].measure);
    HexMesh result = done.mesh;
    mover.finish(result);
    const HexSingularGraph graph = hex_singular_graph(result, build_hex_complex(result));
    fmt::print("after {} sheets: {} hexes, smallest scaled Jacobian {:.4f}\n", done.steps.size(), result.hexes.size(),
               quality(result).min);
    print_graph(graph);
    if (!done.nodes_left.empty()) {
      fmt::print("{} nodes are left; {}\n", done.nodes_left.size(),
                 done.proven ? "the search was complete: no sheet without bends through them lowers the measure"
                             : "the budget ended the search");
      for (const auto& node : done.nodes_left) {
        const Vec3& p = result.points[static_cast<std::size_t>(node.vertex)];
        fmt::print("  {} at ({:.6g}, {:.6g}, {:.6g})\n", node.signature, p.x(), p.y(), p.z());
      }
    }
    write_hex_mesh(file, result);
    write_graph(picture, result, graph);
    return check(result).empty() ? ExitCode::success : ExitCode::bad_hex_mesh;
  });
}

}  // namespace

void add_decompose(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("decompose", "Pull the singular nodes of a hex mesh apart into singular curves");
  auto line = std::make_shared<DecomposeLine>();
  command->add_option("IN", line->input, "Hex mesh (.vtk, .msh, .mesh)")->required();
  command->add_option("-o,--output", line->output, "Mesh file to write, or a directory for it")->required();
  command->add_option("--search", line->search, "exact, or greedy as in the paper (exact)")
      ->check(CLI::IsMember({"exact", "greedy"}));
  command->add_option("--budget", line->options.budget, "Patches tried in all; 0 only improves the mesh (20000000)");
  command->add_option("--width", line->options.width, "Sequences followed side by side (by size)");
  command->add_option("--final-valence", line->options.final_valence, "Highest valence of curves that may stay (5)")
      ->check(CLI::Range(5, 6));
  command->add_option("--pad", line->pad, "Layers of hexes to put along the boundary first (0)")
      ->check(CLI::Range(0, 10));
  command->add_flag("--free-boundary", line->free_boundary, "Let the boundary go anywhere: the shape is not kept");
  command->add_option("--feature-angle", line->feature_angle, "Sharp edges where the input has no tags (70)");
  command->add_option("--threads", line->threads, "Threads (the cores given to the process)");
  command->callback([line, &action] { action = [line] { return decompose_command(*line); }; });
}

}  // namespace hexfield::apps
