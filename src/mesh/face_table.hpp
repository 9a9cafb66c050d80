#pragma once

#include <span>
#include <vector>

#include "hexfield/mesh/tet_mesh.hpp"

namespace hexfield {

/// All half-faces of raw tets, grouped by their vertices: 12 bytes per half-face.
/// Vertex ids must be in range and distinct in a tet.
class FaceTable {
 public:
  struct Entry {
    VertexId second, third;     ///< the lowest vertex is that of the bucket
    std::uint32_t side_and_id;  ///< 2 * half-face + 1 when its cycle is that of the sorted key

    HalfFaceId half_face() const { return HalfFaceId(side_and_id / 2); }
    bool even() const { return side_and_id % 2 != 0; }
    auto operator<=>(const Entry&) const = default;
  };

  FaceTable(std::size_t num_vertices, std::span<const std::array<VertexId, 4>> tets);

  /// Calls visit(key, entries) for every face, ascending by key; entries ascend by half-face.
  template <class Visit>
  void for_each_face(const Visit& visit) const {
    for (std::size_t v = 0; v + 1 < offsets_.size(); ++v)
      for (std::size_t i = offsets_[v], j = i; i < offsets_[v + 1]; i = j) {
        const Entry& first = entries_[i];
        while (j < offsets_[v + 1] && entries_[j].second == first.second && entries_[j].third == first.third) ++j;
        visit(FaceKey{VertexId(static_cast<std::int64_t>(v)), first.second, first.third},
              std::span<const Entry>(entries_.data() + i, j - i));
      }
  }

 private:
  std::vector<std::size_t> offsets_;  // per lowest vertex
  std::vector<Entry> entries_;
};

}  // namespace hexfield
