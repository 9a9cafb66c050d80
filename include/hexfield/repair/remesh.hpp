#pragma once

#include <functional>
#include <span>
#include <vector>

#include "hexfield/repair/repair_state.hpp"

namespace hexfield {

/// How remeshing of the neighbourhood of singularities works (spec-lmff section 6).
struct RemeshOptions {
  double split_above = 5.0 / 3;     ///< edges at least this long in units of the mean target length of their ends
  double collapse_below = 3.0 / 5;  ///< edges shorter than this in the same unit
  bool split = true, collapse = true, swap = true;
  /// Collapses must not make the worst tet around worse.
  bool collapse_needs_quality = false;
  /// Says which tets may change; empty: all. New tets may always.
  std::function<bool(TetId)> editable;
};

struct RemeshReport {
  int splits = 0, collapses = 0, swaps = 0;
  int refused = 0;             ///< collapses and swaps undone because they would have changed other codes
  std::vector<TetId> touched;  ///< alive tets that are new or have other vertices, ascending
};

/// One pass each of splits (longest first, where the worst tet improves), collapses (shortest first) and swaps
/// (longest first, where the worst tet improves) on the edges within two rings of the singular edges that are no
/// feature edges. Quality is the log energy of mesh/quality.hpp. Legal is what keeps: the topology of the mesh and its
/// features; positive tets; directions of feature faces and classes of dihedral angles at the boundary; no new edge
/// inside between two vertices of feature faces; the nodes of the singular graph; and the code of every edge that an
/// edit neither makes nor merges. Matchings, codes, pairs, kept edges and target lengths follow.
/// Leaves tombstones and vertices without tets. Costs what the named edges cost, and the marking of the vertices of
/// features. The same result for any number of threads. Not collective.
RemeshReport remesh_near_singularities(RepairState& state, const RemeshOptions& options = {});

/// The same on the edges of given tets and of those made from them.
RemeshReport remesh(RepairState& state, std::span<const TetId> region, const RemeshOptions& options);

}  // namespace hexfield
