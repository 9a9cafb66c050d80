#include "hexfield/field/tet_polish.hpp"

#include <algorithm>
#include <cmath>

#include "hexfield/base/error.hpp"
#include "hexfield/base/parallel.hpp"
#include "hexfield/field/edge_codes.hpp"

namespace hexfield {

std::vector<TetId> tets_near_singularities(const TetMesh& mesh, const FrameField& field, int layers) {
  const auto edges = all_edges(mesh);
  std::vector<char> singular(edges.size(), 0);
  parallel_for(edges.size(), 2048, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& [edge, tet] = edges[i];
      singular[i] = monodromy(field, edge_ring(mesh, tet, edge[0], edge[1])) != octahedral::identity;
    }
  });
  std::vector<char> vertex_marked(mesh.num_vertices(), 0), marked(mesh.num_tets(), 0);
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (singular[i] != 0)
      for (VertexId v : edges[i].first) vertex_marked[v.index()] = 1;
  for (int layer = 0; layer < layers; ++layer) {
    for (std::size_t t = 0; t < mesh.num_tets(); ++t)
      for (VertexId v : mesh.tets[t]) marked[t] = marked[t] || vertex_marked[v.index()];
    for (std::size_t t = 0; t < mesh.num_tets(); ++t)
      if (marked[t])
        for (VertexId v : mesh.tets[t]) vertex_marked[v.index()] = 1;
  }
  std::vector<TetId> found;
  for (std::size_t t = 0; t < mesh.num_tets(); ++t)
    if (marked[t]) found.emplace_back(static_cast<std::int64_t>(t));
  return found;
}

RootGraph tet_graph(const TetMesh& mesh, std::span<const TetId> tets) {
  std::vector<std::int32_t> number(mesh.num_tets(), -1);
  for (std::size_t k = 0; k < tets.size(); ++k) number[tets[k].index()] = static_cast<std::int32_t>(k);
  RootGraph graph;
  graph.offsets.reserve(tets.size() + 1);
  std::vector<std::pair<std::int32_t, double>> row;
  for (TetId t : tets) {
    require(mesh.alive(t), "The graph of tets needs a mesh without tombstones.");
    row.clear();
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(t, f);
      const HalfFaceId o = mesh.opposite_half_face(h);
      if (!o.valid() || number[o.tet().index()] < 0) continue;
      const auto v = mesh.face_vertices(h);
      const double area = (mesh.point(v[1]) - mesh.point(v[0])).cross(mesh.point(v[2]) - mesh.point(v[0])).norm() / 2;
      row.emplace_back(number[o.tet().index()], area / (centroid(mesh, t) - centroid(mesh, o.tet())).norm());
    }
    std::sort(row.begin(), row.end());
    for (const auto& [tet, weight] : row) {
      graph.neighbours.push_back(tet);
      graph.weights.push_back(weight);
    }
    graph.offsets.push_back(static_cast<std::int64_t>(graph.neighbours.size()));
  }
  return graph;
}

std::vector<NodeConstraint> tet_constraints(const TetMesh& mesh, const Features& features, const FrameField& field,
                                            std::span<const TetId> tets) {
  using Kind = NodeConstraint::Kind;
  std::vector<char> inside(mesh.num_tets(), 0);
  for (TetId t : tets) inside[t.index()] = 1;
  std::vector<NodeConstraint> constraints(tets.size());
  for (std::size_t k = 0; k < tets.size(); ++k) {
    const TetId t = tets[k];
    const std::size_t i = t.index();
    const bool rim = std::any_of(mesh.opposite[i].begin(), mesh.opposite[i].end(),
                                 [&](HalfFaceId o) { return o.valid() && inside[o.tet().index()] == 0; });
    if (rim) {
      constraints[k].kind = Kind::fixed;
      constraints[k].frame = field.frames[i];
      continue;
    }
    std::vector<Vec3> directions;
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(t, f);
      if (mesh.is_boundary(h) || features.faces.count(mesh.key(h)) != 0) directions.push_back(outward_normal(mesh, h));
    }
    for (const auto& e : tet_edge_vertices) {
      const VertexId a = mesh.tets[i][static_cast<std::size_t>(e[0])], b = mesh.tets[i][static_cast<std::size_t>(e[1])];
      if (features.edges.count(edge_key(a, b)) != 0) directions.push_back((mesh.point(b) - mesh.point(a)).normalized());
    }
    if (directions.empty()) continue;
    NodeConstraint& c = constraints[k];
    c.kind = Kind::aligned;
    c.direction = directions[0];
    for (const Vec3& d : directions) {
      if (std::abs(d.dot(directions[0])) > 0.5) continue;
      Mat3 m;
      const Vec3 second = (d - d.dot(directions[0]) * directions[0]).normalized();
      m << directions[0], second, directions[0].cross(second);
      c.kind = Kind::fixed;
      c.frame = Quaternion(m);
      break;
    }
  }
  return constraints;
}

}  // namespace hexfield
