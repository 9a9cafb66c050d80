#include "hexfield/mesh/tet_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "face_table.hpp"

namespace hexfield {
namespace {

[[noreturn]] void refuse_face(const TetMesh& mesh, const FaceKey& f, std::span<const FaceTable::Entry> sides) {
  std::vector<std::int64_t> ids;
  for (const auto& side : sides) ids.push_back(side.half_face().tet().value);
  const Vec3 centre = (mesh.point(f[0]) + mesh.point(f[1]) + mesh.point(f[2])) / 3;
  const bool doubled = sides.size() == 2;
  throw Error(ExitCode::bad_input,
              fmt::format("The face of vertices {}, {}, {} at ({:.6g}, {:.6g}, {:.6g}) {} tets {}.", f[0].value,
                          f[1].value, f[2].value, centre.x(), centre.y(), centre.z(),
                          doubled ? "has the same side in the overlapping" : "belongs to more than two tets:",
                          fmt::join(ids, ", ")),
              ids, {centre});
}

}  // namespace

EdgeKey edge_key(VertexId a, VertexId b) { return a < b ? EdgeKey{a, b} : EdgeKey{b, a}; }

FaceKey face_key(VertexId a, VertexId b, VertexId c) {
  FaceKey f{a, b, c};
  std::sort(f.begin(), f.end());
  return f;
}

std::array<VertexId, 3> TetMesh::face_vertices(HalfFaceId h) const {
  const auto& v = tets[h.tet().index()];
  const auto& f = tet_face_vertices[static_cast<std::size_t>(h.local())];
  return {v[static_cast<std::size_t>(f[0])], v[static_cast<std::size_t>(f[1])], v[static_cast<std::size_t>(f[2])]};
}

FaceKey TetMesh::key(HalfFaceId h) const {
  const auto f = face_vertices(h);
  return face_key(f[0], f[1], f[2]);
}

int TetMesh::local_index(TetId t, VertexId v) const {
  const auto& tet = tets[t.index()];
  for (int i = 0; i < 4; ++i)
    if (tet[static_cast<std::size_t>(i)] == v) return i;
  throw Error(ExitCode::bug, fmt::format("Tet {} does not have vertex {}.", t.value, v.value), {t.value, v.value});
}

bool TetMesh::has_vertex(TetId t, VertexId v) const {
  const auto& tet = tets[t.index()];
  return std::find(tet.begin(), tet.end(), v) != tet.end();
}

TetMesh build_tet_mesh(std::vector<Vec3> points, std::vector<std::array<VertexId, 4>> tets) {
  TetMesh mesh;
  mesh.points = std::move(points);
  mesh.tets = std::move(tets);
  mesh.opposite.assign(mesh.tets.size(), {});
  mesh.vertex_tet.assign(mesh.points.size(), TetId());
  FaceTable(mesh.points.size(), mesh.tets)
      .for_each_face([&](const FaceKey& key, std::span<const FaceTable::Entry> sides) {
        if (sides.size() > 2 || (sides.size() == 2 && sides[0].even() == sides[1].even()))
          refuse_face(mesh, key, sides);
        if (sides.size() < 2) return;
        const HalfFaceId a = sides[0].half_face();
        const HalfFaceId b = sides[1].half_face();
        mesh.opposite[a.tet().index()][static_cast<std::size_t>(a.local())] = b;
        mesh.opposite[b.tet().index()][static_cast<std::size_t>(b.local())] = a;
      });
  for (std::size_t t = mesh.tets.size(); t-- > 0;)
    for (VertexId v : mesh.tets[t]) mesh.vertex_tet[v.index()] = TetId(static_cast<std::int64_t>(t));
  return mesh;
}

double signed_volume6(const TetMesh& mesh, TetId t) {
  const auto& v = mesh.vertices(t);
  const Vec3& o = mesh.point(v[0]);
  return (mesh.point(v[1]) - o).cross(mesh.point(v[2]) - o).dot(mesh.point(v[3]) - o);
}

Vec3 centroid(const TetMesh& mesh, TetId t) {
  const auto& v = mesh.vertices(t);
  return (mesh.point(v[0]) + mesh.point(v[1]) + mesh.point(v[2]) + mesh.point(v[3])) / 4;
}

Vec3 outward_normal(const TetMesh& mesh, HalfFaceId h) {
  const auto f = mesh.face_vertices(h);
  const Vec3& o = mesh.point(f[0]);
  return (mesh.point(f[1]) - o).cross(mesh.point(f[2]) - o).normalized();
}

double dihedral_angle(const TetMesh& mesh, TetId t, VertexId a, VertexId b) {
  std::array<Vec3, 2> arms;
  std::size_t n = 0;
  const Vec3 axis = (mesh.point(b) - mesh.point(a)).normalized();
  for (VertexId v : mesh.vertices(t)) {
    if (v == a || v == b) continue;
    const Vec3 d = mesh.point(v) - mesh.point(a);
    arms[n++] = d - d.dot(axis) * axis;
  }
  return std::atan2(arms[0].cross(arms[1]).norm(), arms[0].dot(arms[1]));
}

std::vector<Violation> check(const TetMesh& mesh) {
  std::vector<Violation> found;
  for (std::size_t i = 0; i < mesh.num_tets(); ++i) {
    const TetId t(static_cast<std::int64_t>(i));
    if (!mesh.alive(t)) continue;
    if (!(signed_volume6(mesh, t) > 0))
      found.push_back({fmt::format("Tet {} is not positive.", t.value), {t.value}, {centroid(mesh, t)}});
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(t, f);
      const HalfFaceId o = mesh.opposite_half_face(h);
      if (o.valid() && (!mesh.alive(o.tet()) || mesh.opposite_half_face(o) != h || mesh.key(o) != mesh.key(h)))
        found.push_back({fmt::format("Half-face {} has a wrong opposite.", h.value), {h.value}, {centroid(mesh, t)}});
    }
  }
  for (std::size_t i = 0; i < mesh.num_vertices(); ++i) {
    const VertexId v(static_cast<std::int64_t>(i));
    const TetId t = mesh.vertex_tet[i];
    if (t.valid() && (!mesh.alive(t) || !mesh.has_vertex(t, v)))
      found.push_back(
          {fmt::format("Vertex {} names a tet that does not have it.", v.value), {v.value}, {mesh.point(v)}});
  }
  return found;
}

}  // namespace hexfield
