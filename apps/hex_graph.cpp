#include "hex_graph.hpp"

#include <fmt/format.h>

#include "hexfield/hex/check.hpp"
#include "hexfield/io/debug_vtk.hpp"

namespace hexfield::apps {

void require_good_hexes(const std::string& file, const HexMesh& mesh) {
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

void print_graph(const HexSingularGraph& graph) {
  fmt::print("  nodes     {}", graph.nodes.size());
  for (const auto& [signature, count] : nodes_by_signature(graph)) fmt::print(" {}x{}", count, signature);
  fmt::print("\n  curves    {}", graph.curves.size());
  for (const auto& [valence, count] : curves_by_valence(graph)) fmt::print(", {} of valence {}", count, valence);
  int closed = 0;
  for (const auto& curve : graph.curves) closed += curve.closed ? 1 : 0;
  fmt::print("; {} closed\n  singular edges", closed);
  for (const auto& [valence, count] : graph.edges) fmt::print(" {} of valence {}", count, valence);
  if (graph.edges.empty()) fmt::print(" none");
  if (graph.crowded_boundary_vertices > 0)
    fmt::print("; several curves end at {} boundary vertices", graph.crowded_boundary_vertices);
  fmt::print("\n");
}

void write_graph(const std::filesystem::path& file, const HexMesh& mesh, const HexSingularGraph& graph) {
  std::vector<Vec3> points;
  std::vector<DebugCell> cells;
  DebugScalar valence{"valence", {}};
  DebugScalar number{"curve", {}};
  const auto point = [&](int v) {
    points.push_back(mesh.points[static_cast<std::size_t>(v)]);
    return static_cast<std::int32_t>(points.size() - 1);
  };
  for (std::size_t c = 0; c < graph.curves.size(); ++c) {
    const auto& curve = graph.curves[c];
    std::vector<std::int32_t> chain;
    for (int v : curve.vertices) chain.push_back(point(v));
    if (curve.closed) chain.push_back(chain.front());
    for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
      cells.push_back({chain[k], chain[k + 1]});
      valence.values.push_back(curve.valence);
      number.values.push_back(static_cast<int>(c));
    }
  }
  for (const auto& node : graph.nodes) {
    cells.push_back({point(node.vertex)});
    valence.values.push_back(0);
    number.values.push_back(-1);
  }
  const std::vector<DebugScalar> scalars{valence, number};
  write_vtk_debug(file, points, cells, scalars);
}

}  // namespace hexfield::apps
