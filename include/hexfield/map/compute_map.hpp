#pragma once

#include <mpi.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hexfield/base/control.hpp"
#include "hexfield/field/frame_field.hpp"
#include "hexfield/map/conforming_space.hpp"
#include "hexfield/map/corner_map.hpp"
#include "hexfield/mesh/features.hpp"

namespace hexfield {

/// What one solve of stage 4 or 6 cost, in the order in which they ran.
struct SolveRecord {
  std::string what;  ///< "fit", "integrable frames 1e+04 1e+04" (the weights w_S and w_I), "untangling", ...
  int newton_steps = 0;
  int linear_iterations = 0;
  double seconds = 0;  ///< of the clock, on this rank
  /// Tets and edges that make the conforming map after this solve invalid; -1 where it was not looked at.
  int inverted = -1;
  int wrong_edges = -1;
};

/// Parameters of stage 4 (spec-lmff section 8). The builder of the stage adds what it needs.
struct SeamlessOptions {
  double target_hexes = 10000;
  double max_misalignment_degrees = 1;  ///< report constraints that the field misses by more
};

struct SeamlessResult {
  SeamlessMap map;   ///< on rank 0; scaled such that its volume is about target_hexes
  MapReport report;  ///< same on all ranks
  int newton_steps = 0;
  int linear_iterations = 0;
  std::vector<SolveRecord> solves{};  ///< not kept in checkpoints
};

/// Stage 4: locally injective seamless map that is the identity transition off a cut, matches the field's
/// matchings across it, and maps features and singular arcs onto coordinate planes and lines.
/// Inputs are read on rank 0 (no tombstones); rank 0 holds the whole map, the solves are distributed.
/// An invalid outcome is not an exception: it is reported. Collective.
SeamlessResult compute_seamless_map(MPI_Comm comm, const TetMesh& mesh, const Features& features,
                                    const FrameField& field, const EdgeCodes& codes, const SeamlessOptions& options,
                                    const Control& control);

/// A seamless map of less extreme tets with the transitions, alignments and about the scale of `map`: for maps whose
/// thinnest tets do not survive being made exact. Tets inverted in the conforming map closest to `map` are untangled
/// first; then the symmetric Dirichlet energy is minimised where every tet weighs at least as much as a mean one: a
/// higher barrier for small ones. `map` and `codes` on rank 0; charts of the result are combed. An invalid outcome is
/// reported. Collective.
SeamlessResult relax_seamless_map(MPI_Comm comm, const TetMesh& mesh, const Features& features, const EdgeCodes& codes,
                                  const SeamlessMap& map, const Control& control);

/// Values for the integer unknowns of a conforming space, for a map that is `scale` times the seamless one.
struct IntegerChoice {
  double scale = 1;
  std::vector<double> integers;
  double hexes = 0;  ///< that the map will have
  /// Per tet, by how much it should grow along the axes of its chart in the seamless map, which is not scaled; or
  /// empty.
  std::vector<Vec3> stretches = {};
};

/// Parameters of the rounding quantizer and stage 6 (spec-lmff section 9, spec-quantization section 6).
struct IgmOptions {
  double target_hexes = 10000;
  double edge_length = 0;  ///< wanted hex edge length in input units; overrides target_hexes when > 0
  int tries = 4;           ///< integers to try, each time for more hexes
  /// Takes the place of rounding when set: integers for about this number of hexes; called on rank 0 with the space
  /// of the seamless map. nullopt: none found.
  std::function<std::optional<IntegerChoice>(const ConformingSpace&, double hexes)> choose_integers;
};

struct IgmResult {
  IntegerGridMap map;  ///< on rank 0
  MapReport report;    ///< same on all ranks
  bool quantization_valid = false;
  std::string reason;  ///< one sentence when something is not valid
  std::vector<Vec3> where;
  int newton_steps = 0;
  int linear_iterations = 0;
  std::vector<SolveRecord> solves{};  ///< not kept in checkpoints
};

/// Stages 5 (greedy rounding) and 6: integer-grid map from a valid seamless map; exact after sanitising:
/// transitions, features and singular arcs are bitwise integer. Collective, values on rank 0.
IgmResult compute_integer_grid_map(MPI_Comm comm, const TetMesh& mesh, const Features& features, const EdgeCodes& codes,
                                   const SeamlessMap& seamless, const IgmOptions& options, const Control& control);

}  // namespace hexfield
