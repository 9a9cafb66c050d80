#pragma once

#include <functional>
#include <span>
#include <vector>

#include "hexfield/mesh/surface.hpp"
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

/// Length wished at every vertex for the final mesh (spec-lmff section 6): the target length of the state divided by
/// (S + 1)^2, S the 8-norm of the angles (radians) between matched frames over the faces at the vertex, angles up to
/// 20 degrees counting nothing; at least 0.3 times the smallest one of the state; three times averaged with the
/// neighbours (vertices of singular edges keep 0.8 of theirs); scaled to the largest one of the state.
std::vector<double> field_adapted_lengths(const RepairState& state);

struct PostRemeshOptions {
  int rounds = 3;
  double split_above = 5.0 / 6;     ///< as in RemeshOptions, in units of field_adapted_lengths()
  double collapse_below = 3.0 / 5;  ///< the same
  int vertex_sweeps = 2;            ///< of optimise_vertices() in every round
};
struct PostRemeshReport {
  int splits = 0, collapses = 0, swaps = 0, refused = 0;
  double worst_before = 0, worst_after = 0;  ///< log energy
  double mean_before = 0, mean_after = 0;    ///< log energy
};

/// The final pass over all edges: rounds of splits, collapses and swaps, each only where the worst tet around does not
/// get worse, with field-adapted target lengths, and of moving vertices. Vertices of features end on the surfaces and
/// curves of the input where that is possible. Tombstones and vertices without tets are removed at the end: ids change.
/// `state.target_length` becomes that of the last round. Codes are as the edits carry them. Not collective.
PostRemeshReport post_remesh(RepairState& state, const ClosestSurface& original_surface,
                             const ClosestCurve& original_curves, const PostRemeshOptions& options = {});

/// Moves vertices, each in its star, to lower sum exp(w (tr / det^{2/3} - 3)) over its tets, w such that the worst term
/// is 1e5: in space; on the surface or curve of the input for vertices of features. Feature points stay, and vertices
/// of singular edges unless a tet there is worse than 12 in tr / det^{2/3}. Vertices of one colour of a greedy
/// colouring move at the same time: the same bytes for any number of threads. Returns the number of moves. Not
/// collective.
int optimise_vertices(RepairState& state, const ClosestSurface& original_surface, const ClosestCurve& original_curves,
                      int sweeps);

/// Renumbers the vertices so that each has a tet, keeping their order, and removes tombstones. Not collective.
void remove_unused(RepairState& state);

}  // namespace hexfield
