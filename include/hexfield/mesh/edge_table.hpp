#pragma once

#include <cstdint>
#include <vector>

#include "hexfield/mesh/tet_mesh.hpp"

namespace hexfield {

/// Numbers the edges of a mesh, ascending by EdgeKey: a list for a while, the mesh itself keeps no edges.
/// About 4 bytes per edge and 8 per vertex (24 per tet while it is built).
class EdgeTable {
 public:
  /// Edges of the alive tets.
  explicit EdgeTable(const TetMesh& mesh);

  std::size_t num_edges() const { return higher_.size(); }
  /// Number of the edge (a, b), in any order; -1 when there is none.
  std::int64_t find(VertexId a, VertexId b) const;
  /// Calls visit(number, key) for every edge, ascending.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (std::size_t v = 0; v + 1 < offsets_.size(); ++v)
      for (std::size_t i = offsets_[v]; i < offsets_[v + 1]; ++i)
        visit(i, EdgeKey{VertexId(static_cast<std::int64_t>(v)), higher_[i]});
  }

 private:
  std::vector<std::size_t> offsets_;  // per lower vertex
  std::vector<VertexId> higher_;      // ascending per lower vertex
};

}  // namespace hexfield
