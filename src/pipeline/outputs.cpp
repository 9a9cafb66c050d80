#include "outputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <system_error>

#include "hexfield/base/error.hpp"
#include "hexfield/field/singularity_graph.hpp"
#include "hexfield/io/debug_vtk.hpp"
#include "hexfield/io/format.hpp"
#include "hexfield/io/hex_io.hpp"
#include "hexfield/io/hexex_io.hpp"
#include "hexfield/io/tet_io.hpp"
#include "hexfield/io/whole_file.hpp"
#include "stages.hpp"

namespace hexfield {
namespace fs = std::filesystem;
namespace {

/// Collects cells of a picture file by vertex ids of a mesh and numbers their points anew.
class Picture {
 public:
  explicit Picture(const std::vector<Vec3>& points) : all_(points) {}

  template <class Vertices>
  void add(const Vertices& vertices, std::initializer_list<int> scalars) {
    DebugCell cell;
    for (const auto v : vertices) cell.push_back(point(static_cast<std::int64_t>(v)));
    cells_.push_back(std::move(cell));
    rows_.emplace_back(scalars);
  }
  void add_place(const Vec3& p, std::initializer_list<int> scalars) {
    points_.push_back(p);
    cells_.push_back({static_cast<std::int32_t>(points_.size() - 1)});
    rows_.emplace_back(scalars);
  }
  void write(const fs::path& file, const std::vector<std::string>& names) const {
    std::vector<DebugScalar> scalars;
    for (std::size_t k = 0; k < names.size(); ++k) {
      scalars.push_back({names[k], {}});
      for (const auto& row : rows_) scalars.back().values.push_back(row[k]);
    }
    write_vtk_debug(file, points_, cells_, scalars);
  }

 private:
  std::int32_t point(std::int64_t v) {
    const auto [entry, fresh] = index_.try_emplace(v, static_cast<std::int32_t>(points_.size()));
    if (fresh) points_.push_back(all_[static_cast<std::size_t>(v)]);
    return entry->second;
  }

  const std::vector<Vec3>& all_;
  std::vector<Vec3> points_;
  std::map<std::int64_t, std::int32_t> index_;
  std::vector<DebugCell> cells_;
  std::vector<std::vector<int>> rows_;
};

template <std::size_t N>
std::array<std::int32_t, N> numbers(const std::array<VertexId, N>& vertices) {
  std::array<std::int32_t, N> values;
  for (std::size_t k = 0; k < N; ++k) values[k] = vertices[k].value;
  return values;
}

/// Lines of the arcs and points of the nodes; `code` of a node is 0, `kind` of an arc is -1, `arc` of a node is -1.
void write_singularities(const RunState& state) {
  const FieldResult& f = state.field;
  const SingularityGraph graph = singularity_graph(f.mesh, f.features, f.field, f.codes);
  Picture picture(f.mesh.points);
  for (std::size_t a = 0; a < graph.arcs.size(); ++a) {
    const std::vector<VertexId>& chain = graph.arcs[a].vertices;
    for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
      picture.add(std::array{chain[k].value, chain[k + 1].value},
                  {graph.arcs[a].code, graph.arcs[a].boundary ? 1 : 0, -1, static_cast<int>(a)});
    }
  }
  for (const SingularNode& node : graph.nodes) {
    picture.add(std::array{node.vertex.value}, {0, 0, static_cast<int>(node.kind), -1});
  }
  picture.write(state.options.output / "singularities.vtk", {"code", "boundary", "kind", "arc"});
}

void write_why(const RunState& state) {
  const Culprits& c = state.culprits;
  // Quads of the hex mesh stand for its hexes, which picture files do not hold.
  Picture picture(c.hexes.empty() ? state.field.mesh.points : state.hexes.points);
  for (const auto& [tet, kind] : c.tets) picture.add(numbers(state.field.mesh.vertices(tet)), {kind, tet.value});
  for (const auto& [edge, kind] : c.edges) picture.add(numbers(edge), {kind, edge[0].value});
  for (const auto& [node, kind] : c.nodes) picture.add(std::array{node.value}, {kind, node.value});
  for (std::size_t h : c.hexes) {
    const auto& v = state.hexes.hexes[h];
    for (const auto& tet :
         {std::array{v[0], v[1], v[3], v[4]}, std::array{v[2], v[3], v[1], v[6]}, std::array{v[5], v[4], v[6], v[1]},
          std::array{v[7], v[6], v[4], v[3]}, std::array{v[1], v[3], v[4], v[6]}}) {
      picture.add(tet, {Culprits::bad_hex, static_cast<int>(h)});
    }
  }
  for (const Vec3& p : c.places) picture.add_place(p, {Culprits::place, -1});
  picture.write(state.options.output / "why.vtk", {"kind", "id"});
}

/// Triangles of the walls, once for each block beside them, and lines of the arcs. `length` is that of an arc in hexes.
void write_blocks(const RunState& state) {
  const BlockPicture& blocks = state.quantization.picture;
  Picture picture(blocks.points);
  for (std::size_t i = 0; i < blocks.triangles.size(); ++i) {
    const auto& [patch, block, other, boundary] = blocks.walls[i];
    for (const std::int32_t b : {block, other})
      if (b >= 0) picture.add(blocks.triangles[i], {b, patch, -1, boundary, 0, 0, 0});
  }
  for (std::size_t i = 0; i < blocks.lines.size(); ++i) {
    const auto& [arc, code, feature, length] = blocks.arcs[i];
    picture.add(blocks.lines[i], {-1, -1, arc, 0, code, feature, length});
  }
  picture.write(state.options.output / "blocks.vtk",
                {"block", "patch", "arc", "boundary", "code", "feature", "length"});
}

/// The map of the stage that the run ended with, for other tools.
std::optional<std::string> write_map(const RunState& state) {
  const FieldResult& f = state.field;
  const std::string& last = state.options.to;
  const bool integer = last == "igm";
  const CornerMap& map = integer ? state.igm.map : state.seamless.map;
  if (map.uvw.empty() || (!integer && last != "seamless" && last != "quantize")) return std::nullopt;
  const std::string name = integer ? "igm.hexex" : "seamless.hexex";
  write_hexex(state.options.output / name, f.mesh, map, f.features);
  return name;
}

}  // namespace

void write_results(const RunState& state, const Outcome& outcome) {
  const bool failed = outcome.code != ExitCode::success && outcome.code != ExitCode::stopped;
  const fs::path& directory = state.options.output;
  std::set<std::string> written;
  if (!state.hexes.hexes.empty()) {
    std::vector<std::string> formats = {"vtk"};
    formats.insert(formats.end(), state.options.formats.begin(), state.options.formats.end());
    for (const std::string& name : formats) {
      WriteOptions how;
      how.format = format_of_name(name);
      std::string file = "hex" + extension_of(*how.format);
      // Two formats share the extension .msh; the older one then tells its version.
      if (written.count(file) != 0 && name != "vtk") file = fmt::format("hex.{}{}", name, extension_of(*how.format));
      if (name == "vtk" && written.count(file) != 0) continue;
      write_hex_mesh(directory / file, state.hexes, how);
      written.insert(file);
    }
  }
  if (state.field.mesh.num_tets() > 0) {
    write_singularities(state);
    written.insert("singularities.vtk");
  }
  // What a judge of the hex mesh compares it with: a map comes without such a file.
  if (is_map_file(state.options.input) && state.field.mesh.num_tets() > 0) {
    write_tet_mesh(directory / "tets.vtk", state.field.mesh, state.field.features);
    written.insert("tets.vtk");
  }
  if (!state.quantization.picture.triangles.empty()) {
    write_blocks(state);
    written.insert("blocks.vtk");
  }
  if (const auto name = outcome.code == ExitCode::success ? write_map(state) : std::nullopt) written.insert(*name);
  if (failed && !state.culprits.empty()) {
    write_why(state);
    written.insert("why.vtk");
  }
  const auto names = {"singularities.vtk", "blocks.vtk", "tets.vtk", "seamless.hexex", "igm.hexex", "why.vtk"};
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(directory, ignored)) {
    const std::string name = entry.path().filename().string();
    const bool mesh = name.starts_with("hex.") && format_of_name(entry.path().extension().string()).has_value();
    const bool ours = mesh || std::find(names.begin(), names.end(), name) != names.end();
    if (ours && written.count(name) == 0) fs::remove(entry.path(), ignored);
  }
}

void write_text(const fs::path& file, const std::string& text) {
  write_whole_file(file, [&](const fs::path& fresh) { write_bytes(fresh, std::as_bytes(std::span(text))); });
}

}  // namespace hexfield
