#include <algorithm>
#include <cmath>

#include "hexfield/base/parallel.hpp"
#include "hexfield/field/vertex_field.hpp"

namespace hexfield {
namespace {

struct EdgeWeight {
  std::int32_t from, to;
  double cotangent, volume;
};

// Finite-element stiffness -grad_i . grad_j V and the volume weight of the six edges of a tet.
void add_tet(const TetMesh& mesh, TetId t, std::vector<EdgeWeight>& weights) {
  const auto& v = mesh.vertices(t);
  const double volume = signed_volume6(mesh, t) / 6;
  std::array<Vec3, 4> area;  // outward, twice the area: gradient of vertex i is -area_i / (6 V)
  for (int i = 0; i < 4; ++i) {
    const auto f = mesh.face_vertices(HalfFaceId(t, i));
    area[static_cast<std::size_t>(i)] =
        (mesh.point(f[1]) - mesh.point(f[0])).cross(mesh.point(f[2]) - mesh.point(f[0]));
  }
  for (const auto& e : tet_edge_vertices) {
    const auto i = static_cast<std::size_t>(e[0]), j = static_cast<std::size_t>(e[1]);
    const double cotangent = -area[i].dot(area[j]) / (36 * volume);
    const double spread = volume / (mesh.point(v[i]) - mesh.point(v[j])).squaredNorm();
    weights.push_back({v[i].value, v[j].value, cotangent, spread});
    weights.push_back({v[j].value, v[i].value, cotangent, spread});
  }
}

}  // namespace

RootGraph vertex_graph(const TetMesh& mesh) {
  // Counting sort by row, then each row by column: no sort of the whole list.
  std::vector<std::int64_t> starts(mesh.num_vertices() + 1, 0);
  std::vector<EdgeWeight> weights;
  std::vector<EdgeWeight> one;
  for (std::size_t i = 0; i < mesh.num_tets(); ++i)
    if (mesh.alive(TetId(static_cast<std::int64_t>(i))))
      for (VertexId v : mesh.tets[i]) starts[v.index() + 1] += 3;
  for (std::size_t v = 0; v < mesh.num_vertices(); ++v) starts[v + 1] += starts[v];
  weights.resize(static_cast<std::size_t>(starts.back()));
  std::vector<std::int64_t> next(starts.begin(), starts.end() - 1);
  for (std::size_t i = 0; i < mesh.num_tets(); ++i) {
    const TetId t(static_cast<std::int64_t>(i));
    if (!mesh.alive(t)) continue;
    one.clear();
    add_tet(mesh, t, one);
    for (const EdgeWeight& w : one) weights[static_cast<std::size_t>(next[static_cast<std::size_t>(w.from)]++)] = w;
  }
  RootGraph graph;
  graph.offsets.reserve(mesh.num_vertices() + 1);
  for (std::size_t v = 0; v < mesh.num_vertices(); ++v) {
    const auto begin = weights.begin() + starts[v];
    const auto end = weights.begin() + starts[v + 1];
    std::stable_sort(begin, end, [](const EdgeWeight& a, const EdgeWeight& b) { return a.to < b.to; });
    for (auto w = begin; w != end;) {
      double cotangent = 0, volume = 0;
      const std::int32_t to = w->to;
      for (; w != end && w->to == to; ++w) cotangent += w->cotangent, volume += w->volume;
      graph.neighbours.push_back(to);
      graph.weights.push_back(std::max(cotangent, 0.1 * volume));
    }
    graph.offsets.push_back(static_cast<std::int64_t>(graph.neighbours.size()));
  }
  return graph;
}

}  // namespace hexfield
