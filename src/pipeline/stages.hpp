#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "hexfield/io/named_arrays.hpp"
#include "run_state.hpp"

namespace hexfield {

/// One stage of DESIGN section 1 as the runner sees it.
struct Stage {
  std::string name;
  /// Computes the value of the stage from those before it. Collective.
  std::function<void(RunState&, const std::string& basis, Progress&)> compute;
  /// The value as checkpoint arrays, and back. Rank 0.
  std::function<NamedArrays(const RunState&)> pack;
  std::function<void(RunState&, const NamedArrays&)> unpack;
  /// Adds the section of the report, and throws Error with a code from 4 to 7 and fills `culprits` when the value
  /// does not allow the next stage. Rank 0.
  std::function<void(RunState&)> judge;
  /// Invariants of the value, for --check. Rank 0.
  std::function<std::vector<Violation>(const RunState&)> check;
  /// Iterations that computing took, for the report; empty when the stage has none.
  std::function<std::int64_t(const RunState&)> iterations;
};

/// All stages in their order.
std::vector<Stage> all_stages();
/// Those of an input that is a seamless map: map (reads it), then quantize and all after it.
std::vector<Stage> map_stages();
/// Whether the input is a .hexex file, which holds a seamless map.
bool is_map_file(const std::filesystem::path& file);

/// Stage 5, and stage 6 with further integers where the first cannot be reached: quantize_stages.cpp.
Stage quantize_stage();
Stage igm_stage();
/// In the place of stages 1 to 4: map_stage.cpp.
Stage map_stage();

/// The wanted number of hexes; an edge length gives it through the volume. Collective.
double wanted_hexes(const RunState& state);

void judge_field(RunState& state);
void judge_repair(RunState& state);
void judge_seamless(RunState& state);
/// The same where transitions and alignments may miss by `residual`, in parameter units.
void judge_seamless_within(RunState& state, double residual);
void judge_quantization(RunState& state);
void judge_igm(RunState& state);
void judge_hexes(RunState& state);
/// The section of the report that judge_hexes() makes, without its verdict.
void describe_hexes(RunState& state);

/// "(x, y, z)" for sentences.
std::string place_text(const Vec3& p);

}  // namespace hexfield
