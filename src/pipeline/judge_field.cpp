#include <fmt/format.h>

#include "hexfield/base/error.hpp"
#include "stages.hpp"

namespace hexfield {
namespace {

using Json = nlohmann::ordered_json;

std::string code_name(EdgeCode code) {
  if (code == compound_code) return "compound";
  if (code == undetermined_code) return "undetermined";
  return std::to_string(code);
}

}  // namespace

void judge_field(RunState& state) {
  std::map<std::string, std::size_t> counts;
  for (const auto& entry : state.field.codes) ++counts[code_name(entry.second)];
  state.report["field"] = {{"singular_edges", counts}, {"zipper_nodes", nullptr}};
  const std::size_t bad = counts["compound"] + counts["undetermined"];
  state.report["meshability"]["before"] = {{"edges", bad}, {"vertices", nullptr}};
  state.report["meshability"]["after"] = state.report["meshability"]["before"];
  std::vector<Vec3> places;
  for (const auto& [edge, code] : state.field.codes) {
    if (code != compound_code && code != undetermined_code) continue;
    state.culprits.edges.emplace_back(edge, Culprits::compound_edge);
    places.push_back((state.field.mesh.point(edge[0]) + state.field.mesh.point(edge[1])) / 2);
  }
  if (bad == 0) return;
  throw Error(ExitCode::not_meshable,
              fmt::format("The field is not locally meshable: {} edges have no single axis, first at {}.", bad,
                          place_text(places.front())),
              {}, places);
}

}  // namespace hexfield
