#pragma once

#include <vector>

#include "hexfield/field/compute_field.hpp"
#include "hexfield/map/corner_map.hpp"
#include "hexfield/mesh/edit.hpp"

namespace hexfield {

/// Lets a CornerMap follow splits: it stays the same piecewise linear map. Children inherit the chart of their tet.
/// Collapses and swaps are no matter of a map: Error(bug).
class MapAttribute : public MeshAttribute {
 public:
  explicit MapAttribute(CornerMap& map) : map_(map) {}
  void on_split(const TetMesh& mesh, const SplitRecord& record) override;
  void on_compact(const std::vector<TetId>& new_tet) override;

 private:
  CornerMap& map_;
};

/// Splits every bridge: an edge between two vertices that lie on features, singular edges or the boundary, which is no
/// edge of such a line or face. Its ends can only move with what they lie on, so a bridge ties two constraints to each
/// other; the new vertex is free. `field` is the mesh with all that belongs to it, `maps` are maps of it; all follow.
/// No tombstones before or after. Returns the number of splits. Not collective.
int split_bridges(FieldResult& field, const std::vector<CornerMap*>& maps);

/// Splits where a map could not be deformed as its constraints ask (spec-quantization 6, "refining tets that block"):
/// all bridges of the tets that share a vertex with a tet in `blocking`, and of every tet in it that has none the
/// longest edge in the first map, of whatever kind. Otherwise as split_bridges().
int refine_at_blocking_tets(FieldResult& field, const std::vector<CornerMap*>& maps,
                            const std::vector<TetId>& blocking);

}  // namespace hexfield
