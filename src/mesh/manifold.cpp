#include "hexfield/mesh/manifold.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "union_find.hpp"

namespace hexfield {
namespace {

// Face number k of the boundary at one of its edges, with the places 3 k + 0..2 of the two ends.
struct EdgeSide {
  EdgeKey edge;
  std::array<std::size_t, 2> corners;
};

std::vector<EdgeSide> edge_sides(const std::vector<FaceKey>& faces) {
  std::vector<EdgeSide> sides;
  for (std::size_t k = 0; k < faces.size(); ++k)
    for (const auto& [i, j] : {std::pair<std::size_t, std::size_t>{0, 1}, {0, 2}, {1, 2}})
      sides.push_back({{faces[k][i], faces[k][j]}, {3 * k + i, 3 * k + j}});
  std::sort(sides.begin(), sides.end(), [](const EdgeSide& a, const EdgeSide& b) {
    return std::tie(a.edge, a.corners) < std::tie(b.edge, b.corners);
  });
  return sides;
}

}  // namespace

std::vector<Violation> find_non_manifold(const TetMesh& mesh) {
  std::vector<FaceKey> faces;
  for (std::size_t t = 0; t < mesh.num_tets(); ++t)
    for (int i = 0; i < 4; ++i) {
      const HalfFaceId h(TetId(static_cast<std::int64_t>(t)), i);
      if (mesh.alive(h.tet()) && mesh.is_boundary(h)) faces.push_back(mesh.key(h));
    }
  const auto sides = edge_sides(faces);
  UnionFind fans(3 * faces.size());  // corners of boundary faces, joined across edges
  std::vector<Violation> found;
  for (std::size_t i = 0, j = 0; i < sides.size(); i = j) {
    for (j = i + 1; j < sides.size() && sides[j].edge == sides[i].edge; ++j)
      for (std::size_t end = 0; end < 2; ++end) fans.unite(sides[i].corners[end], sides[j].corners[end]);
    if (j - i == 2) continue;
    const auto& [a, b] = sides[i].edge;
    const Vec3 place = (mesh.point(a) + mesh.point(b)) / 2;
    found.push_back({fmt::format("Edge {}, {} at ({:.6g}, {:.6g}, {:.6g}) is in {} boundary faces.", a.value, b.value,
                                 place.x(), place.y(), place.z(), j - i),
                     {a.value, b.value},
                     {place}});
  }
  std::vector<int> count(mesh.num_vertices(), 0);
  for (std::size_t k = 0; k < 3 * faces.size(); ++k) count[faces[k / 3][k % 3].index()] += fans.find(k) == k;
  for (std::size_t i = 0; i < count.size(); ++i) {
    if (count[i] < 2) continue;
    const Vec3& p = mesh.points[i];
    found.push_back(
        {fmt::format("The boundary touches itself at vertex {} at ({:.6g}, {:.6g}, {:.6g}).", i, p.x(), p.y(), p.z()),
         {static_cast<std::int64_t>(i)},
         {p}});
  }
  return found;
}

}  // namespace hexfield
