#include "face_table.hpp"

#include <algorithm>
#include <utility>

#include "hexfield/base/parallel.hpp"

namespace hexfield {

FaceTable::FaceTable(std::size_t num_vertices, std::span<const std::array<VertexId, 4>> tets)
    : offsets_(num_vertices + 2, 0), entries_(4 * tets.size()) {
  auto corner = [&](std::size_t t, std::size_t face, std::size_t k) {
    return tets[t][static_cast<std::size_t>(tet_face_vertices[face][k])];
  };
  auto lowest = [&](std::size_t t, std::size_t face) {
    return std::min({corner(t, face, 0), corner(t, face, 1), corner(t, face, 2)});
  };
  // While filling, offsets_[v + 1] is the next free place of bucket v; afterwards it is the end of it.
  for (std::size_t t = 0; t < tets.size(); ++t)
    for (std::size_t face = 0; face < 4; ++face) ++offsets_[lowest(t, face).index() + 2];
  for (std::size_t v = 2; v < offsets_.size(); ++v) offsets_[v] += offsets_[v - 1];
  for (std::size_t t = 0; t < tets.size(); ++t)
    for (std::size_t face = 0; face < 4; ++face) {
      std::array<VertexId, 3> f{corner(t, face, 0), corner(t, face, 1), corner(t, face, 2)};
      std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
      const bool even = f[1] < f[2];
      if (!even) std::swap(f[1], f[2]);
      const auto id = static_cast<std::uint32_t>(4 * t + face);
      entries_[offsets_[f[0].index() + 1]++] = {f[1], f[2], 2 * id + (even ? 1 : 0)};
    }
  offsets_.pop_back();
  parallel_for(num_vertices, 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v)
      std::sort(entries_.begin() + static_cast<std::ptrdiff_t>(offsets_[v]),
                entries_.begin() + static_cast<std::ptrdiff_t>(offsets_[v + 1]));
  });
}

}  // namespace hexfield
