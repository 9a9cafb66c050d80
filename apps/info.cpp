#include <fmt/format.h>
#include <mpi.h>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <memory>

#include "commands.hpp"
#include "hex_graph.hpp"
#include "hexfield/io/checkpoint.hpp"
#include "read_any.hpp"

namespace hexfield::apps {
namespace {

void print_box(const std::vector<Vec3>& points) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : points) box.extend(p);
  if (box.isEmpty()) return;
  const Vec3 a = box.min();
  const Vec3 b = box.max();
  fmt::print("  box       ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g})\n", a.x(), a.y(), a.z(), b.x(), b.y(),
             b.z());
}

template <class Names>
void print_names(const Names& names) {
  for (const auto& [key, name] : names)
    fmt::print("  name      dimension {}, colour {}: {}\n", key.first, key.second, name);
}

/// Number of entities per colour.
template <class Features>
void print_colours(const char* what, const Features& features) {
  std::map<int, std::size_t> counts;
  for (const auto& entry : features) {
    if constexpr (requires { entry.colour; }) {
      ++counts[entry.colour];
    } else {
      ++counts[entry.second];
    }
  }
  fmt::print("  {:<9} {} in {} colours\n", what, features.size(), counts.size());
}

void print_info(const std::string&, const TetInput& input) {
  fmt::print("tet mesh\n  tets      {}\n  vertices  {}\n", input.mesh.num_tets(), input.mesh.num_vertices());
  print_box(input.mesh.points);
  print_colours("points", input.features.points);
  print_colours("lines", input.features.edges);
  print_colours("triangles", input.features.faces);
  print_names(input.features.names);
}

void print_info(const std::string& file, const HexMesh& mesh) {
  fmt::print("hex mesh\n  hexes     {}\n  vertices  {}\n", mesh.hexes.size(), mesh.points.size());
  print_box(mesh.points);
  print_colours("points", mesh.feature_points);
  print_colours("lines", mesh.feature_lines);
  print_colours("quads", mesh.feature_quads);
  print_names(mesh.names);
  require_good_hexes(file, mesh);
  print_graph(hex_singular_graph(mesh, build_hex_complex(mesh)));
}

void print_info(const Checkpoint& checkpoint) {
  fmt::print("checkpoint of schema {}\n  input     SHA-256 {}\n", checkpoint_schema, checkpoint.input_hash());
  for (const StageEntry& stage : checkpoint.stages()) {
    fmt::print("  stage     {} (options and input {:.12})\n", stage.name, stage.basis);
    const NamedArrays arrays = checkpoint.load(stage.name);
    for (const auto& [name, array] : arrays.all()) {
      fmt::print("    {:<20} {} x {}\n", name, array.rows, array.columns);
    }
  }
}

ExitCode info_command(const std::string& file) {
  return on_rank_zero([&] {
    if (looks_like_checkpoint(file)) {
      print_info(Checkpoint::open(file));
    } else {
      std::visit([&](const auto& mesh) { print_info(file, mesh); }, read_any_mesh(file));
    }
    return ExitCode::success;
  });
}

}  // namespace

void add_info(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("info", "What is in a tet mesh, a hex mesh or a checkpoint");
  auto file = std::make_shared<std::string>();
  command->add_option("FILE", *file, "Mesh or run.h5")->required();
  command->callback([file, &action] { action = [file] { return info_command(*file); }; });
}

}  // namespace hexfield::apps
