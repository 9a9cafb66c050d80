#pragma once

#include <filesystem>

#include "hexfield/pipeline/run.hpp"
#include "run_state.hpp"

namespace hexfield {

/// Writes every result file that the state has the values for, and removes those of an earlier run that it does
/// not replace. Rank 0. Throws Error(bad_input) when the disk does not take them.
void write_results(const RunState& state, const Outcome& outcome);
/// Writes a text file that appears whole or not at all.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace hexfield
