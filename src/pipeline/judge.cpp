#include <fmt/format.h>

#include <cmath>

#include "hexfield/base/error.hpp"
#include "stages.hpp"

namespace hexfield {
namespace {

using Json = nlohmann::ordered_json;

Vec3 middle(const TetMesh& mesh, const EdgeKey& edge) { return (mesh.point(edge[0]) + mesh.point(edge[1])) / 2; }

/// Notes what a map report names, and returns its first places.
std::vector<Vec3> note_map_culprits(RunState& state, const MapReport& report) {
  std::vector<Vec3> places;
  for (TetId t : report.inverted) {
    state.culprits.tets.emplace_back(t, Culprits::inverted_tet);
    places.push_back(centroid(state.field.mesh, t));
  }
  for (const EdgeKey& edge : report.wrong_edges) {
    state.culprits.edges.emplace_back(edge, Culprits::wrong_angle);
    places.push_back(middle(state.field.mesh, edge));
  }
  return places;
}

std::string map_sentence(const RunState& state, const MapReport& report) {
  std::string text = fmt::format("{} tets are inverted and {} edges have the wrong angle", report.inverted.size(),
                                 report.wrong_edges.size());
  if (!report.inverted.empty()) {
    const TetId t = report.inverted.front();
    text += fmt::format(", first tet {} at {}", t.value, place_text(centroid(state.field.mesh, t)));
  } else if (!report.wrong_edges.empty()) {
    const EdgeKey& e = report.wrong_edges.front();
    text += fmt::format(", first edge ({}, {}) at {}", e[0].value, e[1].value, place_text(middle(state.field.mesh, e)));
  }
  return text;
}

Json map_json(const MapReport& report) {
  return {{"valid", report.valid()},
          {"inverted", report.inverted.size()},
          {"wrong_index", report.wrong_edges.size()},
          {"max_residual", report.max_residual}};
}

Json solves_json(const std::vector<SolveRecord>& solves) {
  Json lines = Json::array();
  for (const SolveRecord& s : solves)
    lines.push_back({{"what", s.what},
                     {"newton_steps", s.newton_steps},
                     {"linear_iterations", s.linear_iterations},
                     {"seconds", s.seconds},
                     {"inverted", s.inverted},
                     {"wrong_index", s.wrong_edges}});
  return lines;
}

Json quantization_json(const QuantizeResult& result) {
  const bool integers = result.kind != "rounding";
  const auto only = [&](auto value) { return integers ? Json(value) : Json(); };
  const Quantization& q = result.integers;
  return {{"valid", integers},
          {"kind", result.kind},
          {"arcs", only(result.arcs)},
          {"blocks", only(result.blocks)},
          {"hexes", only(q.hexes)},
          {"nodes", only(result.nodes)},
          {"patches", only(result.patches)},
          {"euler", only(result.euler)},
          {"objective", only(q.objective)},
          {"scale", only(q.scale)},
          {"rounds", only(q.rounds)},
          {"separations", only(q.separations)},
          {"sheets", only(q.sheets)},
          {"proven_optimal", only(q.proven_optimal)},
          {"largest_move", result.largest_move},
          {"seconds", result.seconds},
          {"notes", result.notes}};
}

}  // namespace

std::string place_text(const Vec3& p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x(), p.y(), p.z()); }

void judge_seamless(RunState& state) { judge_seamless_within(state, MapReport::residual_tolerance); }

void judge_seamless_within(RunState& state, double residual) {
  const MapReport& report = state.seamless.report;
  state.report["seamless"] = map_json(report);
  state.report["seamless"]["newton_steps"] = state.seamless.newton_steps;
  state.report["seamless"]["linear_iterations"] = state.seamless.linear_iterations;
  state.report["seamless"]["solves"] = solves_json(state.seamless.solves);
  if (report.inverted.empty() && report.wrong_edges.empty() && report.max_residual <= residual) return;
  const std::vector<Vec3> places = note_map_culprits(state, report);
  throw Error(ExitCode::no_seamless_map,
              fmt::format("There is no valid seamless map for this field: {}.", map_sentence(state, report)), {},
              places);
}

void judge_quantization(RunState& state) { state.report["quantization"] = quantization_json(state.quantization); }

void judge_igm(RunState& state) {
  const IgmResult& igm = state.igm;
  double volume = 0;
  for (const auto& corners : igm.map.uvw) {
    volume += (corners[1] - corners[0]).cross(corners[2] - corners[0]).dot(corners[3] - corners[0]) / 6;
  }
  state.report["igm"] = map_json(igm.report);
  state.report["igm"]["newton_steps"] = igm.newton_steps;
  state.report["igm"]["linear_iterations"] = igm.linear_iterations;
  state.report["igm"]["solves"] = solves_json(igm.solves);
  const bool valid = igm.report.valid() && igm.quantization_valid;
  state.report["quantization"] = quantization_json(state.quantization);
  state.report["quantization"]["valid"] = igm.quantization_valid;
  if (valid || state.quantization.kind == "rounding")
    state.report["quantization"]["hexes"] = valid ? Json(std::llround(volume)) : Json();
  if (valid) return;
  std::vector<Vec3> places = igm.where;
  for (const Vec3& p : note_map_culprits(state, igm.report)) places.push_back(p);
  state.culprits.places = igm.where;
  std::string why = igm.reason.empty() ? map_sentence(state, igm.report) : igm.reason;
  const std::string spacing = spacing_near(state.quantization, igm.where);
  if (state.quantization.kind != "rounding" && !spacing.empty()) {
    if (why.ends_with('.')) why.pop_back();
    why += ": t" + spacing.substr(1);
  }
  throw Error(ExitCode::no_integer_grid_map,
              fmt::format("There is no valid {}: {}{}", igm.quantization_valid ? "integer-grid map" : "quantization",
                          why, why.ends_with('.') ? "" : "."),
              {}, places);
}

}  // namespace hexfield
