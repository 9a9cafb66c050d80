#pragma once

#include "hexfield/base/control.hpp"
#include "hexfield/io/named_arrays.hpp"
#include "run_state.hpp"

namespace hexfield {

/// Decomposes the singular nodes of the hex mesh of the state, and takes the result when its smallest scaled Jacobian
/// is larger and it keeps the input as well as the mesh before. Rank 0 only.
void decompose_result(RunState& state, const Control& control);

/// The report in the arrays of the checkpoint, beside the hex mesh.
void pack_decomposition(const DecomposeReport& report, NamedArrays& arrays);
DecomposeReport unpack_decomposition(const NamedArrays& arrays);

nlohmann::ordered_json decomposition_json(const DecomposeReport& report);

}  // namespace hexfield
