#pragma once

#include <functional>

#include "hexfield/repair/meshability.hpp"
#include "hexfield/repair/ring_search.hpp"

/// Repair of vertices (Liu and Bommes 2023 sections 4.3, 4.4 and 5.2, "Establishing meshable vertices"; spec-lmff
/// sections 5.3 and 5.5). Operations work in the one-ring of a vertex and change only tets that touch it. When one
/// returns false the mesh may have been refined there, the field is as it was. Nothing here is collective.
namespace hexfield {

/// Where an operation looks for the second edge.
struct RingScope {
  RingTarget target = RingTarget::free_arc;
  bool cross_surfaces = false;
  bool from_surface = false;   ///< start from singular edges in feature faces too (last resort of section 5.5)
  bool from_features = false;  ///< and from feature edges, where more than two meet
  /// Asked after each zipping; where it says no, that is undone and the next start or target tried. Empty: yes.
  std::function<bool(RepairState&)> accept{};
};

/// (DT1) Singular arc detachment: two arcs of equal code through which a streamline passes leave the vertex as one.
/// Of arcs in one region those closest to 180 degrees come first.
bool detach_arc(RepairState& state, VertexId v, const RingScope& scope = {});
/// (DT2) Zipper node detachment: two parallel arcs of opposite code leave the vertex; they meet at a zipper node.
bool detach_zipper(RepairState& state, VertexId v, const RingScope& scope = {});
/// (DT3) Arc unzipping: as DT1 with an edge of another code, which keeps the difference: a zipper node at its end.
bool unzip_arc(RepairState& state, VertexId v, const RingScope& scope = {RingTarget::any_edge});
/// (DT4) Parabolic sector reversal: as DT2 with an edge of another code, which keeps the sum.
bool reverse_sector(RepairState& state, VertexId v, const RingScope& scope = {RingTarget::any_edge});
/// DT1 of a boundary-truncated sector: an arc leaves the vertex through the boundary face where its streamline goes
/// out (through) or, with reversed flow, comes in (parallel).
bool detach_to_boundary(RepairState& state, VertexId v, Flow flow, const RingScope& scope = {RingTarget::surface});
/// (DT5) Transversal arc unzipping of a fully constrained parabolic sector: a sector of a feature surface between two
/// special edges, one of them a feature, that holds no quad gets one by quarter-turns about the surface normal on
/// both sides of the surface; then DT1 and DT2 clean up.
bool unzip_transversally(RepairState& state, VertexId v, const RingScope& scope = {});

struct VertexRepairOptions {
  int rounds = 10;         ///< operations per vertex one after the other, and in a sequence
  int search_steps = 20;   ///< states from which the search for a sequence goes on
  bool reversals = true;   ///< DT3 and DT4 with edges of other codes, which leave zipper nodes on features
  VertexMapOptions map{};  ///< of the meshability test
};

/// Is there anything to repair at a vertex?
struct VertexNeed {
  bool repair = false;
  std::optional<VerdictMemory::Key> key;  ///< of the one-ring, where its map was asked for: notes `verdict`
  VertexVerdict verdict = VertexVerdict::meshable;
};

/// Vertices with compound edges are left to edge repairs; counts of codes decide where they can, else the map of the
/// one-ring does.
VertexNeed need_of_repair(const RepairState& state, VertexId v, const VertexRepairOptions& options = {});
inline bool needs_repair(const RepairState& state, VertexId v, const VertexRepairOptions& options = {}) {
  return need_of_repair(state, v, options).repair;
}

/// Tries the operations in the order of spec-lmff section 5.5 for an inner vertex, one on an inner feature surface or
/// one on the boundary, while they succeed and the vertex is not meshable. Each must leave fewer parabolic sectors at
/// v, or as many and fewer edges, and no new vertex near it that no hex mesh has. Where three or more feature edges
/// meet and that does not do it, a sequence of operations is looked for that makes v meshable as a whole, with DT5 and
/// the detachment of feature edges through the boundary. Editable must be all tets that touch the tets at v (Place with
/// rings = 1). Returns whether the field changed; if not, neither did the mesh. Copies `local` for each try.
bool repair_vertex(RepairState& local, VertexId v, const VertexRepairOptions& options = {});

}  // namespace hexfield
