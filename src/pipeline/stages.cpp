#include "stages.hpp"

#include <cmath>
#include <iterator>

#include "decompose_result.hpp"
#include "hexfield/base/error.hpp"
#include "hexfield/field/matchings.hpp"
#include "hexfield/field/singularity_graph.hpp"
#include "hexfield/hex/extract.hpp"
#include "hexfield/hex/improve.hpp"
#include "hexfield/io/checkpoint_values.hpp"
#include "hexfield/map/verify.hpp"
#include "hexfield/mesh/features.hpp"
#include "hexfield/mesh/input_check.hpp"
#include "hexfield/mesh/manifold.hpp"
#include "hexfield/mesh/quality.hpp"
#include "hexfield/mesh/refine.hpp"
#include "repair_values.hpp"
#include "tries.hpp"

namespace hexfield {

double wanted_hexes(const RunState& state) {
  double wanted = state.options.target_hexes;
  if (state.options.edge_length > 0) {
    wanted = std::max(1.0, total_volume(state.field.mesh) / std::pow(state.options.edge_length, 3));
  }
  MPI_Bcast(&wanted, 1, MPI_DOUBLE, 0, state.team.comm());
  return wanted;
}

namespace {

std::vector<Violation> joined(std::vector<Violation> a, std::vector<Violation> b) {
  a.insert(a.end(), std::make_move_iterator(b.begin()), std::make_move_iterator(b.end()));
  return a;
}

Stage read_stage() {
  Stage stage;
  stage.name = "read";
  stage.compute = [](RunState& state, const std::string&, Progress& progress) {
    state.team.on_root([&] {
      progress.report("reading " + state.options.input.string(), -1);
      state.input = read_tet_mesh(state.options.input);
      for (const std::string& note : state.input.notes) state.log.warning(note);
      // Splits and walks see one fan of a non-manifold edge only, so nothing after this stage could be right.
      require_valid_input(state.options.input.string(), find_non_manifold(state.input.mesh));
      complete_features(state.input.mesh, state.input.features, state.options.feature_angle);
    });
  };
  stage.pack = [](const RunState& state) { return pack(state.input); };
  stage.unpack = [](RunState& state, const NamedArrays& arrays) { state.input = unpack_tet_input(arrays); };
  stage.judge = [](RunState& state) {
    state.input_tets = state.input.mesh.num_tets();
    state.report["input"]["tets"] = state.input_tets;
    state.report["input"]["vertices"] = state.input.mesh.num_vertices();
    state.report["input"]["features"] = {{"points", state.input.features.points.size()},
                                         {"edges", state.input.features.edges.size()},
                                         {"faces", state.input.features.faces.size()}};
  };
  stage.check = [](const RunState& state) {
    return joined(check(state.input.mesh), check(state.input.mesh, state.input.features));
  };
  return stage;
}

TrySetting setting_of(const RunState& state) {
  return try_setting(state.options.repair, state.attempt, state.input_tets);
}

Stage field_stage() {
  Stage stage;
  stage.name = "field";
  stage.compute = [](RunState& state, const std::string& basis, Progress& progress) {
    std::string name = basis;
    state.team.on_root([&] {
      if (setting_of(state).refined_input) refine_uniform(state.input.mesh, state.input.features);
    });
    if (state.attempt > 0) name += " try " + std::to_string(state.attempt);
    state.team.together([&] {
      state.field = compute_field(state.team.comm(), std::move(state.input.mesh), std::move(state.input.features),
                                  state.options.field, state.safe_points.control(name, progress));
    });
    state.input = {};
  };
  stage.pack = [](const RunState& state) { return pack(state.field); };
  stage.unpack = [](RunState& state, const NamedArrays& arrays) {
    state.field = unpack_field(arrays);
    state.input = {};
  };
  stage.judge = judge_field;
  stage.check = [](const RunState& state) {
    const FieldResult& f = state.field;
    const SingularityGraph graph = singularity_graph(f.mesh, f.features, f.field, f.codes);
    return joined(joined(check(f.mesh), check(f.mesh, f.features)),
                  joined(check(f.mesh, f.field), check(f.mesh, f.field, f.codes, graph)));
  };
  return stage;
}

// Safe points of the repair, and where it goes on after an interruption.
RepairControl repair_control(RunState& state, const std::string& basis, Progress& progress) {
  const Control on_root = state.safe_points.control_on_root(progress);
  RepairControl control;
  control.progress = on_root.progress;
  control.stop_requested = on_root.stop_requested;
  control.checkpoint = [&state, basis](const RepairIterate& iterate) {
    state.safe_points.offer_on_root("repair", basis, [&] { return pack(iterate); });
  };
  return control;
}

Stage repair_stage() {
  Stage stage = field_stage();
  stage.name = "repair";
  stage.compute = [](RunState& state, const std::string& basis, Progress& progress) {
    state.team.on_root([&] {
      const std::string name = basis + " try " + std::to_string(state.attempt);
      const auto found = state.safe_points.restore_on_root("repair", name);
      const RepairControl control = repair_control(state, name, progress);
      RepairIterate start = found ? unpack_repair_iterate(*found) : start_repair(state.field, control);
      RepairResult result = repair_field(std::move(start), state.field, setting_of(state).repair, control);
      state.field = std::move(result.field);
      state.repair = std::move(result.report);
    });
  };
  stage.pack = [](const RunState& state) { return pack_repair(state.field, state.repair); };
  stage.unpack = [](RunState& state, const NamedArrays& arrays) {
    RepairResult result = unpack_repair(arrays);
    state.field = std::move(result.field);
    state.repair = std::move(result.report);
  };
  stage.judge = judge_repair;
  stage.iterations = [](const RunState& state) { return state.repair.iterations; };
  return stage;
}

Stage seamless_stage() {
  Stage stage;
  stage.name = "seamless";
  stage.compute = [](RunState& state, const std::string& basis, Progress& progress) {
    SeamlessOptions options = state.options.seamless;
    options.target_hexes = wanted_hexes(state);
    state.team.together([&] {
      const FieldResult& f = state.field;
      state.seamless = compute_seamless_map(state.team.comm(), f.mesh, f.features, f.field, f.codes, options,
                                            state.safe_points.control(basis, progress));
    });
  };
  stage.pack = [](const RunState& state) { return pack(state.seamless); };
  stage.unpack = [](RunState& state, const NamedArrays& arrays) {
    state.seamless = unpack_seamless(arrays, state.field.mesh.num_tets());
  };
  stage.judge = judge_seamless;
  stage.check = [](const RunState&) { return std::vector<Violation>(); };
  stage.iterations = [](const RunState& state) { return state.seamless.newton_steps; };
  return stage;
}

Stage extract_stage() {
  Stage stage;
  stage.name = "extract";
  stage.compute = [](RunState& state, const std::string&, Progress&) {
    state.team.on_root([&] { state.hexes = extract_hex_mesh(state.field.mesh, state.field.features, state.igm.map); });
  };
  stage.pack = [](const RunState& state) { return pack(state.hexes); };
  stage.unpack = [](RunState& state, const NamedArrays& arrays) { state.hexes = unpack_hex_mesh(arrays); };
  // Extraction may give hexes that only smoothing makes positive: the verdict comes after stage 8.
  stage.judge = describe_hexes;
  stage.check = [](const RunState&) { return std::vector<Violation>(); };
  return stage;
}

Stage improve_stage() {
  Stage stage = extract_stage();
  stage.name = "improve";
  stage.compute = [](RunState& state, const std::string&, Progress& progress) {
    state.team.on_root([&] {
      const Control control = state.safe_points.control_on_root(progress);
      improve_hex_mesh(state.hexes, state.field.mesh, state.field.features, state.options.improve, control);
      if (state.options.decompose) decompose_result(state, control);
    });
  };
  stage.pack = [](const RunState& state) {
    NamedArrays arrays = pack(state.hexes);
    pack_decomposition(state.decomposition, arrays);
    return arrays;
  };
  stage.unpack = [](RunState& state, const NamedArrays& arrays) {
    state.hexes = unpack_hex_mesh(arrays);
    state.decomposition = unpack_decomposition(arrays);
  };
  stage.judge = [](RunState& state) {
    state.report["decomposition"] = decomposition_json(state.decomposition);
    judge_hexes(state);
  };
  return stage;
}

}  // namespace

bool is_map_file(const std::filesystem::path& file) { return file.extension() == ".hexex"; }

std::vector<Stage> map_stages() {
  return {map_stage(), quantize_stage(), igm_stage(), extract_stage(), improve_stage()};
}

std::vector<Stage> all_stages() {
  return {read_stage(),     field_stage(), repair_stage(),  seamless_stage(),
          quantize_stage(), igm_stage(),   extract_stage(), improve_stage()};
}

}  // namespace hexfield
