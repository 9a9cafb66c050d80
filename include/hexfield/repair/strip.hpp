#pragma once

#include <optional>
#include <span>
#include <vector>

#include "hexfield/repair/repair_state.hpp"

/// From a path to a triangle strip Z that arc zipping works on (paper section 5.2; spec-lmff sections 5.2 and 5.6,
/// "Zip"). Instead of cutting handles and special simplices out of a tube of tets, the strip is spanned by new
/// vertices only: one on every crossed face, one on every spoke from the path to the mesh beside it. So it is
/// embedded, touches nothing special and has one layer of tets between its two sides. Nothing here is collective.
namespace hexfield {

/// Splits the faces, which consecutive tets of a dual path share, in their order, and returns the new vertices. They
/// lie on a taut string through the faces from `from` on, or from `from` to `to`. Costs the path.
std::vector<VertexId> insert_path(RepairState& state, std::span<const FaceKey> faces, const Vec3& from,
                                  const std::optional<Vec3>& to = {});

/// A strip along an edge path. Spokes are edges from the path to the side; the strip turns from spoke to spoke,
/// by triangles (path vertex, side, next side) and (path vertex, next path vertex, side), through no feature
/// face, and its second side runs through the middles of the spokes.
struct StripRequest {
  std::vector<VertexId> path;  ///< first side: consecutive vertices are edges of the mesh
  VertexId start;              ///< the strip starts with the edge (path.front(), start)
  bool split_start = false;    ///< the start, a boundary edge, is split; otherwise it stays whole and Z has all of it
  VertexId end;                ///< it ends with (path.back(), end), or, if invalid, with a boundary edge
  std::vector<VertexId> exits{};  ///< if not empty: the boundary edges (path.back(), exit) it may end with
  std::vector<Vec3> side;         ///< per path vertex: where the second side should lie; zero: anywhere
  /// So many first path vertices lie on features: their spokes, but the first and last, stay off feature faces. Others
  /// may lie in a face that the path crosses.
  std::size_t held = 0;
  std::size_t held_last = 0;  ///< and so many last ones
};

struct Strip {
  std::vector<FaceKey> faces;    ///< Z
  std::vector<VertexId> first;   ///< the path
  std::vector<VertexId> second;  ///< from `start` to `end` or the boundary
  EdgeKey start;                 ///< (first.front(), second.front())
  bool from_boundary = false;    ///< starts with a boundary edge
  bool at_boundary = false;      ///< ends with a boundary edge
  /// Edges that bound Z: both sides, start and end unless these lie on the boundary.
  std::vector<EdgeKey> boundary() const;
};

/// Splits the inner faces at v, a vertex on features, between two edges that are special or lie in feature faces:
/// spokes get past everywhere.
void free_spokes(RepairState& state, VertexId v);

/// Finds the spokes whose directions deviate least from `side` and splits them. Nothing when there are none; then
/// nothing has changed.
std::optional<Strip> build_strip(RepairState& state, const StripRequest& request);

}  // namespace hexfield
