#pragma once

#include <vector>

#include "hexfield/mesh/tet_mesh.hpp"

namespace hexfield {

/// The edges of a mesh, sorted; an edge id is its place in the table.
class MapEdges {
 public:
  explicit MapEdges(const TetMesh& mesh);

  std::size_t size() const { return edges_.size(); }
  const EdgeKey& key(std::size_t e) const { return edges_[e]; }
  /// The edge must exist.
  std::size_t id(VertexId a, VertexId b) const;
  /// The edge may be missing: returns size() then.
  std::size_t find(const EdgeKey& key) const;
  /// A tet that contains the edge (the lowest id).
  TetId tet(std::size_t e) const { return tets_[e]; }
  bool on_boundary(std::size_t e) const { return boundary_[e] != 0; }

 private:
  std::vector<EdgeKey> edges_;
  std::vector<TetId> tets_;
  std::vector<char> boundary_;
};

}  // namespace hexfield
