#include "hexfield/map/alignments.hpp"

#include <map>

namespace hexfield {
namespace {

const Vec3& corner(const TetMesh& mesh, const CornerMap& map, TetId t, VertexId v) {
  return map.uvw[t.index()][static_cast<std::size_t>(mesh.local_index(t, v))];
}

int least_spread_axis(const TetMesh& mesh, const CornerMap& map, HalfFaceId h) {
  const auto v = mesh.face_vertices(h);
  const Vec3& a = corner(mesh, map, h.tet(), v[0]);
  const Vec3& b = corner(mesh, map, h.tet(), v[1]);
  const Vec3& c = corner(mesh, map, h.tet(), v[2]);
  int axis = 0;
  (a.cwiseMax(b).cwiseMax(c) - a.cwiseMin(b).cwiseMin(c)).minCoeff(&axis);
  return axis;
}

void align_edge(const TetMesh& mesh, const CornerMap& map, const EdgeKey& edge, Alignments& found) {
  // A non-manifold edge has several fans: every tet at the edge that no ring has met starts one.
  std::set<TetId> seen;
  for (TetId seed : vertex_star(mesh, edge[0])) {
    if (!mesh.has_vertex(seed, edge[1]) || seen.contains(seed)) continue;
    for (TetId t : edge_ring(mesh, seed, edge[0], edge[1]).tets) {
      seen.insert(t);
      int axis = 0;
      (corner(mesh, map, t, edge[1]) - corner(mesh, map, t, edge[0])).cwiseAbs().maxCoeff(&axis);
      found.edges.push_back({t, edge, axis});
    }
  }
}

}  // namespace

std::set<EdgeKey> singular_edges(const EdgeCodes& codes) {
  std::set<EdgeKey> edges;
  for (const auto& [edge, code] : codes)
    if (code != 0) edges.insert(edge);
  return edges;
}

std::vector<VertexId> critical_points(const Features& features, const EdgeCodes& codes) {
  std::set<VertexId> points;
  for (const auto& point : features.points) points.insert(point.first);
  std::map<VertexId, int> singular;
  std::map<VertexId, int> feature;
  for (const EdgeKey& edge : singular_edges(codes))
    for (VertexId v : edge) ++singular[v];
  for (const auto& edge : features.edges)
    for (VertexId v : edge.first) ++feature[v];
  for (const auto* counts : {&singular, &feature})
    for (const auto& [v, count] : *counts)
      if (count != 2) points.insert(v);
  return {points.begin(), points.end()};
}

Alignments alignments_of_field(const std::vector<AxisConstraint>& constraints, const Features& features,
                               const EdgeCodes& codes) {
  Alignments found;
  for (const AxisConstraint& c : constraints) {
    if (c.kind == AxisConstraint::Kind::feature_face)
      found.faces.push_back({c.face, octahedral::axis(c.label)});
    else
      found.edges.push_back({c.tet, c.edge, octahedral::axis(c.label)});
  }
  found.points = critical_points(features, codes);
  return found;
}

Alignments alignments_of_map(const TetMesh& mesh, const Features& features, const EdgeCodes& codes,
                             const CornerMap& map) {
  Alignments found;
  for (std::size_t i = 0; i < mesh.num_tets(); ++i)
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(TetId(i), f);
      if (mesh.is_boundary(h) || features.faces.contains(mesh.key(h)))
        found.faces.push_back({h, least_spread_axis(mesh, map, h)});
    }
  std::set<EdgeKey> edges = singular_edges(codes);
  for (const auto& edge : features.edges) edges.insert(edge.first);
  for (const EdgeKey& edge : edges) align_edge(mesh, map, edge, found);
  found.points = critical_points(features, codes);
  return found;
}

}  // namespace hexfield
