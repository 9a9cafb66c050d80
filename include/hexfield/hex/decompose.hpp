#pragma once

#include <functional>
#include <string>
#include <vector>

#include "hexfield/base/control.hpp"
#include "hexfield/hex/hex_singular_graph.hpp"

namespace hexfield {

/// Parameters of decompose().
struct DecomposeOptions {
  /// exact: all sheets through a seed by backtracking over classes of quads (spec-sheets 6.2), the best of many seeds,
  /// several sequences side by side. greedy: Algorithms 1 and 2 of the paper, one sheet per seed.
  enum class Search { exact, greedy } search = Search::exact;
  int final_valence = 5;             ///< curves up to this valence (5 or 6) may remain
  int max_valence = 6;               ///< of edges on the way, unless the mesh has higher ones
  int width = 0;                     ///< sequences followed side by side; 0: by the size of the mesh
  std::int64_t budget = 20000000;    ///< classes tried in all before the search ends
  std::int64_t seed_budget = 20000;  ///< classes tried for one seed
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
  /// With nodes left: no sheet that lowers the measure, or keeps it and leads on to one that does within two
  /// sheets, exists through any node. False when a budget ended the search.
  bool proven = false;
};

/// Pulls the singular nodes of a hex mesh apart into singular curves by sheet inflations, as few as it finds.
/// `settle` is called after each inflation of the chosen sequence to place vertices; may be empty. The mesh must
/// pass check_for_sheets(). Depends on the connectivity and the options only. Not collective.
/// Throws Error(stopped) between sheets when the control asks for it.
Decomposition decompose(const HexMesh& mesh, const DecomposeOptions& options,
                        const std::function<void(HexMesh&)>& settle, const Control& control);

}  // namespace hexfield
