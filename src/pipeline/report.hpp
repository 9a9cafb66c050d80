#pragma once

#include <nlohmann/json.hpp>

#include <string>

#include "hexfield/base/ledger.hpp"
#include "hexfield/pipeline/options.hpp"
#include "hexfield/pipeline/run.hpp"
#include "run_state.hpp"

namespace hexfield {

inline constexpr int report_schema = 1;

/// report.json with all keys of DESIGN section 6; sections of stages that were not reached are null.
nlohmann::ordered_json empty_report(const RunOptions& options, int ranks, int threads);
/// Every option in force by its key, numbers and words as such.
nlohmann::ordered_json options_json(const RunOptions& options);
/// The lines of one computed stage.
nlohmann::ordered_json stage_json(const StageCost& cost);
/// One line of `tries`: a setting of the repair and what came of it.
nlohmann::ordered_json try_json(const std::string& setting, ExitCode verdict, const std::string& sentence);
/// Adds tries and verdict.
void close_report(nlohmann::ordered_json& report, const nlohmann::ordered_json& tries, const Outcome& outcome,
                  const std::string& stage, const std::vector<Vec3>& where);

}  // namespace hexfield
