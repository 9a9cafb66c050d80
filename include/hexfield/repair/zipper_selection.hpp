#pragma once

#include <array>
#include <vector>

#include "hexfield/repair/repair_state.hpp"

/// Which zipper nodes are worth unzipping (spec-lmff section 5.6, "Selection of free zipper nodes"). Noisy chains of
/// edges flip the sign of their codes many times; most of these zipper nodes vanish by relocation. Not collective.
namespace hexfield {

struct SelectionOptions {
  double peak = 0.1;              ///< of the mean segment: how far an extremal node must exceed both ends
  double segment = 0.4;           ///< of the mean segment: both neighbours of a kept node are longer
  double absolute_segment = 5.0;  ///< times the mean target length: or both are longer than this
  double crowded = 0.2;           ///< zipper nodes per vertex of an arc: above, the segment rules do not apply
};

/// A maximal chain of inner singular edges of codes +1 and -1 through vertices off the feature faces that have no
/// other singular edge, with the flow along it.
struct FlowChain {
  std::vector<VertexId> vertices;  ///< first = last when closed; then it starts at a zipper node if it has one
  std::vector<EdgeCode> codes;     ///< per edge
  std::vector<double> flow;        ///< per vertex: sum of axis . edge along the transported label, from 0
  /// Indices of the vertices between codes of opposite sign, and of those ends (0 or the last) where the arc meets a
  /// surface with reversed flow: zipper nodes at no distance from the surface.
  std::vector<std::size_t> zippers;
  std::array<bool, 2> on_surface{};  ///< does the end lie on a feature face?
  bool closed = false;
  double length = 0;
};

/// A zipper node and the arcs that leave it along one axis: inside two of them, edges[0] of code -1 and edges[1] of
/// code +1; on a boundary face or a reentrant curve the only one, whose flow leads out.
struct FreeZipper {
  VertexId node;
  std::vector<EdgeKey> edges;
  double arc_length = 0;  ///< of its chain
};

/// A zipper node that comes apart inside: an inner vertex with two singular edges, of codes +1 and -1, or a vertex of
/// the boundary off the feature curves with one singular edge, an inner one of code +1 or -1 whose flow leads out, or
/// one on a reentrant curve (is_zipper_on_curve).
bool is_free_zipper(const RepairState& state, VertexId v);
/// The zipper node with the edges that it has now.
FreeZipper free_zipper_at(const RepairState& state, VertexId v);

/// All chains with at least one edge, ordered by their smallest edge. Costs the singular edges.
std::vector<FlowChain> flow_chains(const RepairState& state);

/// The zipper nodes of a chain to unzip, as indices into its vertices, ascending. `mean_target` is the mean target
/// length.
std::vector<std::size_t> kept_zippers(const FlowChain& chain, double mean_target, const SelectionOptions& options);

/// The free zipper nodes to unzip, those of the longest chain first, then by vertex.
std::vector<FreeZipper> select_free_zippers(const RepairState& state, const SelectionOptions& options = {});

}  // namespace hexfield
