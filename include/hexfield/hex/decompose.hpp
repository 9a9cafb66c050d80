#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "hexfield/base/control.hpp"
#include "hexfield/hex/hex_singular_graph.hpp"
#include "hexfield/mesh/features.hpp"

namespace hexfield {

/// Parameters of decompose().
struct DecomposeOptions {
  /// exact: all sheets through a seed by backtracking over classes of quads (spec-sheets 6.2), the best of many seeds,
  /// several sequences side by side; with many nodes, the best sheets of the mesh by an integer program. greedy:
  /// Algorithms 1 and 2 of the paper, one sheet per seed.
  enum class Search { exact, greedy } search = Search::exact;
  int final_valence = 5;             ///< curves up to this valence (5 or 6) may remain
  int max_valence = 6;               ///< of edges on the way, unless the mesh has higher ones
  int width = 0;                     ///< sequences followed side by side; 0: by the size of the mesh
  std::int64_t budget = 5000000;     ///< classes tried in all before the search ends
  std::int64_t seed_budget = 20000;  ///< classes tried for one seed
  int branches = 500;                ///< of the integer program for all sheets at once
  double work = 5e8;                 ///< of that program: steps of its linear programs times its rows
};

struct DecomposeStep {
  std::vector<int> quads;  ///< of the sheet, by the numbers of build_hex_complex() of the mesh before
  int measure = 0;         ///< sum of f over the vertices afterwards
};

struct Decomposition {
  HexMesh mesh;
  std::vector<DecomposeStep> steps;
  int measure_before = 0;  ///< sum over the interior vertices of f, the splits that each needs on its own
  int measure = 0;         ///< 0: no node is left, and no curve above the final valence
  std::vector<HexSingularGraph::Node> nodes_left;
  int sheets_refused = 0;  ///< by `settle`
  /// With a measure left: the search in the mesh that is returned was exhaustive, so that no sheet lowers the measure
  /// that is straight at every regular edge, holds no feature quad, tears no feature apart and leaves no edge above
  /// max_valence. False whenever a limit was met (then of `limits`), `settle` refused a sheet or the search was
  /// stopped, and always with the greedy search.
  bool proven = false;
  std::set<std::string> limits;  ///< what ended the last search before it was exhaustive
  bool stopped = false;          ///< the control asked for the end; the mesh is the one reached so far
};

/// Pulls the singular nodes of a hex mesh apart into singular curves by sheet inflations, as few as it finds.
/// `settle` is called after each inflation of the chosen sequence to place vertices; may be empty. Where it returns
/// false (a hex could not be made positive) the sheet is taken back, and the search goes on without it. The mesh must
/// pass check_for_sheets(). Depends on the connectivity, the options and what `settle` returns only. Ends with what was
/// settled so far when the control, or `settle` by Error(stopped), asks for it. Not collective.
Decomposition decompose(const HexMesh& mesh, const DecomposeOptions& options,
                        const std::function<bool(HexMesh&)>& settle, const Control& control);

/// The shape that boundary and feature vertices slide on, as improve_hex_mesh() has it; none: they may go anywhere.
struct HexShape {
  const TetMesh* mesh = nullptr;
  const Features* features = nullptr;
};

/// Raises the smallest scaled Jacobian as far as it goes: untangling, sweeps, then maximise_minimum(). Not collective.
void improve_thoroughly(HexMesh& mesh, const HexShape& shape, const Control& control);

/// decompose() with the vertices placed on the shape after each sheet, and improve_thoroughly() at the end. All hexes
/// of the result are positive if those of the mesh are, also when it is stopped. Not collective.
Decomposition decompose_on_shape(const HexMesh& mesh, const HexShape& shape, const DecomposeOptions& options,
                                 const Control& control);

}  // namespace hexfield
