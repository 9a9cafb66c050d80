#include <algorithm>

#include "hexfield/mesh/edit_legality.hpp"

namespace hexfield {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

template <class T>
void sort_unique(std::vector<T>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

template <class T>
std::size_t num_common(const std::vector<T>& a, const std::vector<T>& b) {
  std::size_t n = 0;
  for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end();)
    if (*i < *j)
      ++i;
    else if (*j < *i)
      ++j;
    else
      ++n, ++i, ++j;
  return n;
}

// Vertices and edges of the link of a vertex in a complex of faces, ascending.
struct FaceLink {
  std::vector<VertexId> vertices;
  std::vector<EdgeKey> edges;

  void add(const EdgeKey& e) {
    vertices.insert(vertices.end(), e.begin(), e.end());
    edges.push_back(e);
  }
  void finish() {
    sort_unique(vertices);
    sort_unique(edges);
  }
  bool empty() const { return edges.empty(); }
  bool has_vertex(VertexId v) const { return std::binary_search(vertices.begin(), vertices.end(), v); }
  // Number of faces with the edge to v.
  std::size_t num_at(VertexId v) const {
    return static_cast<std::size_t>(
        std::count_if(edges.begin(), edges.end(), [&](const EdgeKey& e) { return e[0] == v || e[1] == v; }));
  }
};

// Links of a vertex in the mesh, its boundary, the feature faces and the feature edges.
struct Links {
  FaceLink all, boundary, surface;
  std::vector<VertexId> curve;  // ascending

  Links(const TetMesh& mesh, const Features& features, VertexId v) {
    for (TetId t : vertex_star(mesh, v)) {
      const int i = mesh.local_index(t, v);
      for (int f = 0; f < 4; ++f) {
        if (f == i) continue;
        std::array<VertexId, 2> e;
        std::size_t n = 0;
        for (int g = 0; g < 4; ++g)
          if (g != i && g != f) e[n++] = mesh.vertices(t)[at(g)];
        all.add(edge_key(e[0], e[1]));
        if (mesh.is_boundary(HalfFaceId(t, f))) boundary.add(edge_key(e[0], e[1]));
      }
    }
    all.finish();
    boundary.finish();
    for (const EdgeKey& e : all.edges)
      if (features.faces.count(face_key(v, e[0], e[1])) != 0) surface.add(e);
    surface.finish();
    for (VertexId x : all.vertices)
      if (features.edges.count(edge_key(v, x)) != 0) curve.push_back(x);
  }
};

// Link condition in a complex of faces (no tets): common neighbours span faces with the edge, and nothing more.
bool faces_allow(const FaceLink& from, const FaceLink& to, VertexId v) {
  return num_common(from.vertices, to.vertices) == from.num_at(v) && num_common(from.edges, to.edges) == 0;
}

bool curve_allows(const Features& features, const Links& from, const Links& to, VertexId f, VertexId t) {
  if (from.curve.empty()) return true;
  if (from.curve.size() != 2 || features.edges.count(edge_key(f, t)) == 0) return false;
  const int colour = features.edges.at(edge_key(f, from.curve[0]));
  return features.edges.at(edge_key(f, from.curve[1])) == colour && num_common(from.curve, to.curve) == 0;
}

}  // namespace

bool collapse_keeps_topology(const TetMesh& mesh, const Features& features, VertexId from, VertexId to) {
  if (features.points.count(from) != 0) return false;
  const Links f(mesh, features, from);
  const Links t(mesh, features, to);
  std::size_t ring_tets = 0, ring_faces = 0;
  for (TetId tet : vertex_star(mesh, from)) {
    if (!mesh.has_vertex(tet, to)) continue;
    ++ring_tets;
    if (mesh.is_boundary(HalfFaceId(tet, mesh.local_index(tet, from))) &&
        mesh.is_boundary(HalfFaceId(tet, mesh.local_index(tet, to))))
      return false;
  }
  ring_faces = f.all.num_at(to);
  if (ring_tets == 0 || num_common(f.all.vertices, t.all.vertices) != ring_faces ||
      num_common(f.all.edges, t.all.edges) != ring_tets)
    return false;
  if (!f.boundary.empty() && !t.boundary.empty() &&
      (f.boundary.num_at(to) == 0 || num_common(f.boundary.vertices, t.boundary.vertices) != f.boundary.num_at(to)))
    return false;
  if (!f.boundary.empty() && t.boundary.empty()) return false;
  if (!f.surface.empty() && (!f.surface.has_vertex(to) || !faces_allow(f.surface, t.surface, to))) return false;
  return curve_allows(features, f, t, from, to);
}

bool collapse_keeps_positive(const TetMesh& mesh, VertexId from, VertexId to) {
  for (TetId t : vertex_star(mesh, from)) {
    if (mesh.has_vertex(t, to)) continue;
    std::array<Vec3, 4> p;
    for (std::size_t k = 0; k < 4; ++k) {
      const VertexId v = mesh.vertices(t)[k];
      p[k] = mesh.point(v == from ? to : v);
    }
    if (!((p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]) > 0)) return false;
  }
  return true;
}

}  // namespace hexfield
