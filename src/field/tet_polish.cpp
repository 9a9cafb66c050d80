#include "hexfield/field/tet_polish.hpp"

#include <algorithm>
#include <cmath>

#include "hexfield/base/error.hpp"

namespace hexfield {

RootGraph tet_graph(const TetMesh& mesh) {
  RootGraph graph;
  graph.offsets.reserve(mesh.num_tets() + 1);
  std::vector<std::pair<std::int32_t, double>> row;
  for (std::size_t i = 0; i < mesh.num_tets(); ++i) {
    const TetId t(static_cast<std::int64_t>(i));
    require(mesh.alive(t), "The graph of tets needs a mesh without tombstones.");
    row.clear();
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(t, f);
      const HalfFaceId o = mesh.opposite_half_face(h);
      if (!o.valid()) continue;
      const auto v = mesh.face_vertices(h);
      const double area = (mesh.point(v[1]) - mesh.point(v[0])).cross(mesh.point(v[2]) - mesh.point(v[0])).norm() / 2;
      row.emplace_back(o.tet().value, area / (centroid(mesh, t) - centroid(mesh, o.tet())).norm());
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

std::vector<NodeConstraint> tet_constraints(const TetMesh& mesh, const Features& features) {
  using Kind = NodeConstraint::Kind;
  std::vector<NodeConstraint> constraints(mesh.num_tets());
  for (std::size_t i = 0; i < mesh.num_tets(); ++i) {
    const TetId t(static_cast<std::int64_t>(i));
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
    NodeConstraint& c = constraints[i];
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
