#include <fmt/format.h>

#include "hexfield/base/error.hpp"
#include "hexfield/field/singularity_graph.hpp"
#include "hexfield/repair/meshability.hpp"
#include "stages.hpp"

namespace hexfield {
namespace {

using Json = nlohmann::ordered_json;

std::string code_name(EdgeCode code) {
  if (code == compound_code) return "compound";
  if (code == undetermined_code) return "undetermined";
  return std::to_string(code);
}

/// Notes where the defects are and returns their numbers at edges and vertices.
std::pair<std::size_t, std::size_t> note_defects(RunState& state, const std::vector<Defect>& defects,
                                                 std::vector<Vec3>& places) {
  std::size_t edges = 0;
  std::size_t vertices = 0;
  for (const Defect& defect : defects) {
    places.insert(places.end(), defect.places.begin(), defect.places.end());
    if (defect.vertices.size() == 2) {
      ++edges;
      state.culprits.edges.emplace_back(edge_key(defect.vertices[0], defect.vertices[1]), Culprits::bad_edge);
    } else {
      ++vertices;
      for (VertexId v : defect.vertices) state.culprits.nodes.emplace_back(v, Culprits::bad_node);
    }
  }
  return {edges, vertices};
}

}  // namespace

namespace {

void describe_field(RunState& state) {
  const FieldResult& f = state.field;
  const SingularityGraph graph = singularity_graph(f.mesh, f.features, f.field, f.codes);
  Json counts = Json::object();
  for (const auto& [code, count] : graph.edges) counts[code_name(code)] = count;
  std::map<std::string, std::size_t> kinds;
  for (const SingularNode& node : graph.nodes) ++kinds[name(node.kind)];
  state.report["field"] = {{"singular_edges", counts},
                           {"zipper_nodes", kinds[name(NodeKind::zipper)]},
                           {"nodes", kinds},
                           {"arcs", graph.arcs.size()},
                           {"tets", f.mesh.num_tets()},
                           {"vertices", f.mesh.num_vertices()}};
}

Json counts_json(const DefectCounts& counts) {
  return {{"edges", counts.edges}, {"vertices", counts.vertices}, {"kinds", counts.kinds}};
}

}  // namespace

void judge_field(RunState& state) { describe_field(state); }

void judge_repair(RunState& state) {
  state.report["field_before_repair"] = state.report["field"];
  describe_field(state);
  const RepairReport& repair = state.repair;
  state.report["meshability"] = {{"before", counts_json(repair.before)}, {"after", counts_json(repair.after)}};
  state.report["repair"] = {{"iterations", repair.iterations},
                            {"work", repair.work},
                            {"operations", repair.operations},
                            {"seconds", repair.seconds}};
  const FieldResult& f = state.field;
  const std::vector<Defect> defects = unrefuted_defects(FieldView(f.mesh, f.features, f.field, f.codes));
  if (defects.empty()) return;
  std::vector<Vec3> places;
  const auto [edges, vertices] = note_defects(state, defects, places);
  throw Error(ExitCode::not_meshable,
              fmt::format("The field is not locally meshable at {} edges and {} vertices: {}", edges, vertices,
                          defects.front().sentence),
              {}, places);
}

}  // namespace hexfield
