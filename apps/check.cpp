#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "commands.hpp"
#include "hexfield/field/matchings.hpp"
#include "hexfield/field/singularity_graph.hpp"
#include "hexfield/hex/check.hpp"
#include "hexfield/io/checkpoint.hpp"
#include "hexfield/io/checkpoint_values.hpp"
#include "hexfield/io/hex_io.hpp"
#include "hexfield/io/tet_io.hpp"
#include "hexfield/map/verify.hpp"
#include "hexfield/mesh/features.hpp"
#include "hexfield/repair/meshability.hpp"

namespace hexfield::apps {
namespace {

struct CheckLine {
  std::string file;
  std::string against;
  bool meshability = false;
};

/// Prints every violation and returns their number.
std::size_t print_all(const std::vector<Violation>& violations) {
  for (const Violation& violation : violations) fmt::print("{}\n", violation.sentence);
  return violations.size();
}

/// What keeps a field from being locally meshable, edge by edge and vertex by vertex. Returns the number of places.
std::size_t print_meshability(const FieldResult& result) {
  const FieldView view(result.mesh, result.features, result.field, result.codes);
  const Meshability found = check_meshability(view);
  for (const EdgeKey& e : found.bad_edges) {
    const Vec3 middle = (result.mesh.point(e[0]) + result.mesh.point(e[1])) / 2;
    fmt::print("The edge of vertices {} and {} at ({:.6g}, {:.6g}, {:.6g}) is not locally meshable.\n", e[0].value,
               e[1].value, middle.x(), middle.y(), middle.z());
  }
  for (VertexId v : found.bad_vertices) {
    const Vec3& p = result.mesh.point(v);
    fmt::print("Vertex {} at ({:.6g}, {:.6g}, {:.6g}) is not locally meshable.\n", v.value, p.x(), p.y(), p.z());
  }
  fmt::print("{} of {} edges and {} of {} vertices are not locally meshable; {} more are once edges are split\n",
             found.bad_edges.size(), found.edges, found.bad_vertices.size(), found.vertices, found.split_first.size());
  return found.bad_edges.size() + found.bad_vertices.size();
}

/// Reads every stage back and checks its value.
std::size_t check_checkpoint(const Checkpoint& checkpoint, bool meshability) {
  std::size_t defects = 0;
  FieldResult field;
  for (const StageEntry& stage : checkpoint.stages()) {
    const NamedArrays arrays = checkpoint.load(stage.name);
    if (stage.name == "read") {
      const TetInput input = unpack_tet_input(arrays);
      defects += print_all(check(input.mesh)) + print_all(check(input.mesh, input.features));
    } else if (stage.name == "field" || stage.name == "repair" || stage.name == "map") {
      field = unpack_field(arrays);
      defects += print_all(check(field.mesh)) + print_all(check(field.mesh, field.features));
      const auto graph = singularity_graph(field.mesh, field.features, field.field, field.codes);
      defects +=
          print_all(check(field.mesh, field.field)) + print_all(check(field.mesh, field.field, field.codes, graph));
      if (meshability) defects += print_meshability(field);
    } else if (stage.name == "seamless" || stage.name == "quantize") {
      unpack_seamless(arrays, field.mesh.num_tets());
    } else if (stage.name == "igm") {
      // The stage may have refined the mesh.
      if (arrays.contains("points")) field = unpack_field(arrays);
      const IgmResult igm = unpack_igm(arrays, field.mesh.num_tets());
      if (igm.report.valid() && igm.quantization_valid) {
        defects += print_all(check_integer_grid(field.mesh, field.features, field.codes, igm.map));
      }
    } else {
      const HexMesh hexes = unpack_hex_mesh(arrays);
      if (stage.name == "improve") defects += print_all(check(hexes));
    }
    fmt::print("stage {}: read back\n", stage.name);
  }
  return defects;
}

/// Quality, and the defects of the mesh alone and against the tet mesh that it was made from.
std::size_t check_hexes(const HexMesh& mesh, const std::string& against) {
  const HexQuality measured = quality(mesh);
  fmt::print("{} hexes, scaled Jacobian from {:.4f}, mean {:.4f}\n", mesh.hexes.size(), measured.min, measured.mean);
  std::size_t defects = print_all(check(mesh));
  if (!against.empty()) {
    TetInput tets = read_tet_mesh(against);
    complete_features(tets.mesh, tets.features);
    const HexAgainstTets compared = check_against(mesh, tets.mesh, tets.features);
    fmt::print("volume ratio {:.6f}; {} points, {} curves and {} surfaces wanted\n", compared.volume_ratio,
               compared.points.wanted, compared.curves.wanted, compared.surfaces.wanted);
    defects += print_all(compared.violations);
  }
  return defects;
}

ExitCode verdict(std::size_t defects, ExitCode bad) {
  fmt::print("{} defects\n", defects);
  return defects == 0 ? ExitCode::success : bad;
}

/// The hex mesh of a file; nothing when it holds no hexes or cannot be read as such.
std::optional<HexMesh> as_hex_mesh(const std::string& file) {
  try {
    HexMesh mesh = read_hex_mesh(file);
    if (!mesh.hexes.empty()) return mesh;
  } catch (const Error&) {
    // The check as a tet mesh tells what is wrong with it.
  }
  return std::nullopt;
}

ExitCode check_command(const CheckLine& line) {
  return on_rank_zero([&] {
    if (looks_like_checkpoint(line.file)) {
      return verdict(check_checkpoint(Checkpoint::open(line.file), line.meshability), ExitCode::bad_input);
    }
    if (const auto hexes = as_hex_mesh(line.file))
      return verdict(check_hexes(*hexes, line.against), ExitCode::bad_hex_mesh);
    return verdict(print_all(check_tet_file(line.file)), ExitCode::bad_input);
  });
}

}  // namespace

void add_check(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("check", "Every defect of a tet mesh, a checkpoint or a hex mesh");
  auto line = std::make_shared<CheckLine>();
  command->add_option("FILE", line->file, "Mesh or run.h5")->required();
  command->add_option("--against", line->against, "Tet mesh that the hex mesh was made from")->type_name("TETS");
  command->add_flag("--meshability", line->meshability,
                    "Also look for a local map around every edge and vertex of the field of a checkpoint");
  command->callback([line, &action] { action = [line] { return check_command(*line); }; });
}

}  // namespace hexfield::apps
