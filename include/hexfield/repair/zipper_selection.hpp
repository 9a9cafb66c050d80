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
  std::vector<VertexId> vertices;    ///< first = last when closed; then it starts at a zipper node if it has one
  std::vector<EdgeCode> codes;       ///< per edge
  std::vector<double> flow;          ///< per vertex: sum of axis . edge along the transported label, from 0
  std::vector<std::size_t> zippers;  ///< indices of vertices between codes of opposite sign
  bool closed = false;
  double length = 0;
};

/// A zipper node and the two arcs that leave it side by side: edges[0] has code -1, edges[1] code +1.
struct FreeZipper {
  VertexId node;
  std::array<EdgeKey, 2> edges;
  double arc_length = 0;  ///< of its chain
};

/// All chains with at least one edge, ordered by their smallest edge. Costs the singular edges.
std::vector<FlowChain> flow_chains(const RepairState& state);

/// The zipper nodes of a chain to unzip, as indices into its vertices, ascending. `mean_target` is the mean target
/// length, `surface_zipper` says for both ends whether the arc meets a surface with reversed flow there, `on_surface`
/// whether it ends on a feature face.
std::vector<std::size_t> kept_zippers(const FlowChain& chain, double mean_target, std::array<bool, 2> on_surface,
                                      std::array<bool, 2> surface_zipper, const SelectionOptions& options);

/// The free zipper nodes to unzip, those of the longest chain first, then by vertex.
std::vector<FreeZipper> select_free_zippers(const RepairState& state, const SelectionOptions& options = {});

}  // namespace hexfield
