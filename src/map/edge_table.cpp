#include "edge_table.hpp"

#include <algorithm>

namespace hexfield {

MapEdges::MapEdges(const TetMesh& mesh) {
  struct Entry {
    EdgeKey key;
    TetId tet;
    auto operator<=>(const Entry&) const = default;
  };
  std::vector<Entry> entries;
  entries.reserve(6 * mesh.num_tets());
  for (std::size_t i = 0; i < mesh.num_tets(); ++i) {
    const auto& v = mesh.tets[i];
    for (const auto& e : tet_edge_vertices)
      entries.push_back({edge_key(v[static_cast<std::size_t>(e[0])], v[static_cast<std::size_t>(e[1])]), TetId(i)});
  }
  std::sort(entries.begin(), entries.end());
  for (const Entry& entry : entries) {
    if (!edges_.empty() && edges_.back() == entry.key) continue;
    edges_.push_back(entry.key);
    tets_.push_back(entry.tet);
  }
  boundary_.assign(edges_.size(), 0);
  for (std::size_t i = 0; i < mesh.num_tets(); ++i)
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(TetId(i), f);
      if (!mesh.is_boundary(h)) continue;
      const auto v = mesh.face_vertices(h);
      for (std::size_t k = 0; k < 3; ++k) boundary_[id(v[k], v[(k + 1) % 3])] = 1;
    }
}

std::size_t MapEdges::find(const EdgeKey& wanted) const {
  const auto place = std::lower_bound(edges_.begin(), edges_.end(), wanted);
  if (place == edges_.end() || *place != wanted) return edges_.size();
  return static_cast<std::size_t>(place - edges_.begin());
}

std::size_t MapEdges::id(VertexId a, VertexId b) const { return find(edge_key(a, b)); }

}  // namespace hexfield
