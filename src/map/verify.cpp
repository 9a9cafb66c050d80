#include "hexfield/map/verify.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "edge_table.hpp"
#include "hexfield/base/parallel.hpp"
#include "hexfield/map/alignments.hpp"
#include "hexfield/map/orientation.hpp"

namespace hexfield {
namespace {

constexpr double quarter_turn = std::numbers::pi / 2;

Vec3 corner(const TetMesh& mesh, const CornerMap& map, TetId t, VertexId v) {
  return map.uvw[t.index()][static_cast<std::size_t>(mesh.local_index(t, v))];
}

/// Image dihedral angle of a tet at its local edge e.
double image_angle(const std::array<Vec3, 4>& f, std::size_t e) {
  const auto a = static_cast<std::size_t>(tet_edge_vertices[e][0]);
  const auto b = static_cast<std::size_t>(tet_edge_vertices[e][1]);
  const auto c = static_cast<std::size_t>(tet_edge_vertices[5 - e][0]);
  const auto d = static_cast<std::size_t>(tet_edge_vertices[5 - e][1]);
  const Vec3 axis = f[b] - f[a];
  const Vec3 n1 = axis.cross(f[c] - f[a]);
  const Vec3 n2 = axis.cross(f[d] - f[a]);
  return std::atan2(n1.cross(n2).norm(), n1.dot(n2));
}

struct EdgeAngles {
  std::vector<double> sum;     // radians
  std::vector<char> doubtful;  // at an inverted tet
};

EdgeAngles edge_angles(const TetMesh& mesh, const CornerMap& map, const MapEdges& edges,
                       const std::vector<char>& inverted) {
  EdgeAngles angles{std::vector<double>(edges.size(), 0), std::vector<char>(edges.size(), 0)};
  for (std::size_t i = 0; i < mesh.num_tets(); ++i)
    for (std::size_t e = 0; e < 6; ++e) {
      const std::size_t id = edges.id(mesh.tets[i][static_cast<std::size_t>(tet_edge_vertices[e][0])],
                                      mesh.tets[i][static_cast<std::size_t>(tet_edge_vertices[e][1])]);
      if (inverted[i] != 0)
        angles.doubtful[id] = 1;
      else
        angles.sum[id] += image_angle(map.uvw[i], e);
    }
  return angles;
}

std::vector<char> inverted_tets(const CornerMap& map) {
  std::vector<char> inverted(map.uvw.size(), 0);
  parallel_for(map.uvw.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& f = map.uvw[i];
      inverted[i] = orientation(f[0], f[1], f[2], f[3]) <= 0;
    }
  });
  return inverted;
}

double transition_residual(const TetMesh& mesh, const CornerMap& map, HalfFaceId h) {
  const Vec3 t = transition_translation(mesh, map, h);
  const HalfFaceId o = mesh.opposite_half_face(h);
  double worst = 0;
  for (VertexId v : mesh.face_vertices(h))
    worst = std::max(
        worst, (corner(mesh, map, o.tet(), v) - octahedral::apply(map.rotation(h), corner(mesh, map, h.tet(), v)) - t)
                   .cwiseAbs()
                   .maxCoeff());
  return worst;
}

double alignment_residual(const TetMesh& mesh, const CornerMap& map, const Alignments& alignments) {
  double worst = 0;
  for (const FaceAlignment& a : alignments.faces) {
    const auto v = mesh.face_vertices(a.face);
    for (std::size_t k = 1; k < 3; ++k)
      worst = std::max(worst, std::abs(corner(mesh, map, a.face.tet(), v[k])[a.axis] -
                                       corner(mesh, map, a.face.tet(), v[0])[a.axis]));
  }
  for (const EdgeAlignment& a : alignments.edges) {
    Vec3 difference = corner(mesh, map, a.tet, a.edge[1]) - corner(mesh, map, a.tet, a.edge[0]);
    difference[a.axis] = 0;
    worst = std::max(worst, difference.cwiseAbs().maxCoeff());
  }
  return worst;
}

bool is_integer(double x) { return std::nearbyint(x) == x; }

}  // namespace

MapReport verify_map(const TetMesh& mesh, const Features& features, const EdgeCodes& codes, const CornerMap& map) {
  MapReport report;
  const std::vector<char> inverted = inverted_tets(map);
  for (std::size_t i = 0; i < inverted.size(); ++i)
    if (inverted[i] != 0) report.inverted.push_back(TetId(i));
  const MapEdges edges(mesh);
  const EdgeAngles angles = edge_angles(mesh, map, edges, inverted);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto code = codes.find(edges.key(e));
    const int turns = (edges.on_boundary(e) ? 2 : 4) + (code == codes.end() ? 0 : code->second);
    if (angles.doubtful[e] == 0 && !(std::abs(angles.sum[e] / quarter_turn - turns) <= 0.1))
      report.wrong_edges.push_back(edges.key(e));
  }
  for (std::size_t i = 0; i < mesh.num_tets(); ++i)
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(TetId(i), f);
      if (!mesh.is_boundary(h) && h.value < mesh.opposite_half_face(h).value)
        report.max_residual = std::max(report.max_residual, transition_residual(mesh, map, h));
    }
  const Alignments alignments = alignments_of_map(mesh, features, codes, map);
  report.max_residual = std::max(report.max_residual, alignment_residual(mesh, map, alignments));
  return report;
}

EdgeCodes codes_of_map(const TetMesh& mesh, const CornerMap& map) {
  const MapEdges edges(mesh);
  const EdgeAngles angles = edge_angles(mesh, map, edges, inverted_tets(map));
  EdgeCodes codes;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const int code = static_cast<int>(std::lround(angles.sum[e] / quarter_turn)) - (edges.on_boundary(e) ? 2 : 4);
    if (code != 0) codes[edges.key(e)] = code;
  }
  return codes;
}

std::vector<Violation> check_integer_grid(const TetMesh& mesh, const Features& features, const EdgeCodes& codes,
                                          const IntegerGridMap& map) {
  std::vector<Violation> found;
  auto report = [&](const char* what, TetId t) { found.push_back({what, {t.value}, {centroid(mesh, t)}}); };
  const std::vector<char> inverted = inverted_tets(map);
  for (std::size_t i = 0; i < mesh.num_tets(); ++i) {
    const TetId t(i);
    if (inverted[i] != 0) report("A tet is not positive in parameter space.", t);
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(t, f);
      if (mesh.is_boundary(h)) continue;
      const Vec3 translation = transition_translation(mesh, map, h);
      if (!is_integer(translation[0]) || !is_integer(translation[1]) || !is_integer(translation[2]))
        report("A translation is not integer.", t);
      if (transition_residual(mesh, map, h) != 0) report("A transition is not exact.", t);
    }
  }
  const Alignments alignments = alignments_of_map(mesh, features, codes, map);
  for (const FaceAlignment& a : alignments.faces)
    for (VertexId v : mesh.face_vertices(a.face))
      if (!is_integer(corner(mesh, map, a.face.tet(), v)[a.axis]))
        report("A feature face is off the lattice.", a.face.tet());
  if (alignment_residual(mesh, map, alignments) != 0) found.push_back({"An alignment is not exact.", {}, {}});
  for (const EdgeAlignment& a : alignments.edges)
    for (VertexId v : a.edge)
      for (int k = 0; k < 3; ++k)
        if (k != a.axis && !is_integer(corner(mesh, map, a.tet, v)[k]))
          report("A feature or singular edge is off the lattice.", a.tet);
  for (VertexId v : alignments.points) {
    const TetId t = mesh.vertex_tet[v.index()];
    const Vec3 f = corner(mesh, map, t, v);
    if (!is_integer(f[0]) || !is_integer(f[1]) || !is_integer(f[2])) report("A feature point is off the lattice.", t);
  }
  return found;
}

double parametric_volume(const CornerMap& map) {
  double sum = 0;
  for (const auto& f : map.uvw) sum += (f[1] - f[0]).cross(f[2] - f[0]).dot(f[3] - f[0]) / 6;
  return sum;
}

}  // namespace hexfield
