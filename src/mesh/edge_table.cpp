#include "hexfield/mesh/edge_table.hpp"

#include <algorithm>

namespace hexfield {
namespace {

template <class Visit>
void for_each_edge(const TetMesh& mesh, const Visit& visit) {
  for (const auto& tet : mesh.tets) {
    if (!tet[0].valid()) continue;
    for (const auto& [i, j] : tet_edge_vertices)
      visit(edge_key(tet[static_cast<std::size_t>(i)], tet[static_cast<std::size_t>(j)]));
  }
}

}  // namespace

EdgeTable::EdgeTable(const TetMesh& mesh) : offsets_(mesh.num_vertices() + 2, 0) {
  // While filling, offsets_[v + 1] is the next free place of bucket v; afterwards it is the end of it.
  for_each_edge(mesh, [&](const EdgeKey& e) { ++offsets_[e[0].index() + 2]; });
  for (std::size_t v = 2; v < offsets_.size(); ++v) offsets_[v] += offsets_[v - 1];
  higher_.resize(offsets_.back());
  for_each_edge(mesh, [&](const EdgeKey& e) { higher_[offsets_[e[0].index() + 1]++] = e[1]; });
  offsets_.pop_back();
  auto end = higher_.begin();
  for (std::size_t v = 0, begin = 0; v + 1 < offsets_.size(); ++v) {
    const auto first = higher_.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = higher_.begin() + static_cast<std::ptrdiff_t>(offsets_[v + 1]);
    std::sort(first, last);
    begin = offsets_[v + 1];
    end = std::unique_copy(first, last, end);
    offsets_[v + 1] = static_cast<std::size_t>(end - higher_.begin());
  }
  higher_.erase(end, higher_.end());
  higher_.shrink_to_fit();
}

std::int64_t EdgeTable::find(VertexId a, VertexId b) const {
  const auto [low, high] = edge_key(a, b);
  if (!low.valid() || low.index() + 1 >= offsets_.size()) return -1;
  const auto first = higher_.begin() + static_cast<std::ptrdiff_t>(offsets_[low.index()]);
  const auto last = higher_.begin() + static_cast<std::ptrdiff_t>(offsets_[low.index() + 1]);
  const auto found = std::lower_bound(first, last, high);
  return found != last && *found == high ? found - higher_.begin() : -1;
}

}  // namespace hexfield
