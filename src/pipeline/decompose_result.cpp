#include "decompose_result.hpp"

#include <fmt/format.h>

#include "hexfield/hex/check.hpp"
#include "hexfield/hex/decompose.hpp"

namespace hexfield {
namespace {

int count_nodes(const HexMesh& mesh) {
  return static_cast<int>(hex_singular_graph(mesh, build_hex_complex(mesh)).nodes.size());
}

std::size_t defects(const RunState& state, const HexMesh& hexes) {
  return check(hexes).size() + check_against(hexes, state.field.mesh, state.field.features).violations.size();
}

}  // namespace

void decompose_result(RunState& state, const Control& control) {
  DecomposeReport& report = state.decomposition;
  report = {};
  const HexMesh& before = state.hexes;
  if (!check(before).empty() || !check_for_sheets(before, build_hex_complex(before)).empty()) {
    state.log.warning("The hex mesh has defects; its singular nodes were not decomposed.");
    return;
  }
  report.tried = true;
  report.min_before = quality(before).min;
  report.nodes_before = count_nodes(before);
  const Decomposition found =
      decompose_on_shape(before, {&state.field.mesh, &state.field.features}, DecomposeOptions{}, control);
  if (found.stopped) throw Error(ExitCode::stopped, "Stopped while singular nodes were being decomposed.");
  report.proven = found.proven;
  report.sheets = static_cast<int>(found.steps.size());
  report.nodes_after = static_cast<int>(found.nodes_left.size());
  report.measure_before = found.measure_before;
  report.measure_after = found.measure;
  report.min_after = quality(found.mesh).min;
  report.taken =
      report.sheets > 0 && report.min_after > report.min_before && defects(state, found.mesh) <= defects(state, before);
  state.log.info(fmt::format("{} sheets: {} of {} singular nodes left, smallest scaled Jacobian {:.4f} from {:.4f}; {}",
                             report.sheets, report.nodes_after, report.nodes_before, report.min_after,
                             report.min_before, report.taken ? "taken" : "not taken"));
  if (report.taken) state.hexes = found.mesh;
}

void pack_decomposition(const DecomposeReport& r, NamedArrays& arrays) {
  arrays.own<double>(
      "decomposition",
      {double(r.tried), double(r.taken), double(r.proven), double(r.sheets), double(r.nodes_before),
       double(r.nodes_after), double(r.measure_before), double(r.measure_after), r.min_before, r.min_after},
      10);
}

DecomposeReport unpack_decomposition(const NamedArrays& arrays) {
  if (!arrays.contains("decomposition")) return {};
  const auto v = arrays.get<double>("decomposition", 10);
  return {v[0] != 0, v[1] != 0, v[2] != 0, int(v[3]), int(v[4]), int(v[5]), int(v[6]), int(v[7]), v[8], v[9]};
}

nlohmann::ordered_json decomposition_json(const DecomposeReport& r) {
  if (!r.tried) return nullptr;
  return {{"taken", r.taken},
          {"sheets", r.sheets},
          {"nodes", {{"before", r.nodes_before}, {"after", r.nodes_after}}},
          {"measure", {{"before", r.measure_before}, {"after", r.measure_after}}},
          {"proven", r.proven},
          {"scaled_jacobian_min", {{"before", r.min_before}, {"after", r.min_after}}}};
}

}  // namespace hexfield
