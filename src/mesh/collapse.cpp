#include <algorithm>

#include "hexfield/mesh/edit.hpp"

namespace hexfield {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

template <class T>
void sort_unique(std::vector<T>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

void note_link(const TetMesh& mesh, TetId t, CollapseRecord& record) {
  const int i = mesh.local_index(t, record.from);
  for (int f = 0; f < 4; ++f) {
    if (f == i) continue;
    const VertexId x = mesh.vertices(t)[at(f)];
    if (x != record.to) record.neighbours.push_back(x);
    for (int g = f + 1; g < 4; ++g)
      if (g != i) record.link.push_back(edge_key(x, mesh.vertices(t)[at(g)]));
  }
}

// A vertex that named a removed tet names one that it still has.
void repair_vertex_tet(TetMesh& mesh, VertexId v, const CollapseRecord& record) {
  if (mesh.alive(mesh.vertex_tet[v.index()])) return;
  for (const auto& m : record.merged)
    for (HalfFaceId h : {m.beyond_from, m.beyond_to})
      if (h.valid() && mesh.has_vertex(h.tet(), v)) {
        mesh.vertex_tet[v.index()] = h.tet();
        return;
      }
  for (TetId t : record.moved)
    if (mesh.has_vertex(t, v)) {
      mesh.vertex_tet[v.index()] = t;
      return;
    }
  throw Error(ExitCode::bug, "A collapse takes a vertex its last tet.", {v.value}, {mesh.point(v)});
}

}  // namespace

void collapse_edge(TetMesh& mesh, VertexId from, VertexId to, const std::vector<MeshAttribute*>& attributes) {
  CollapseRecord record;
  record.from = from;
  record.to = to;
  for (TetId t : vertex_star(mesh, from)) {
    note_link(mesh, t, record);
    if (!mesh.has_vertex(t, to)) {
      record.moved.push_back(t);
      continue;
    }
    const HalfFaceId at_from(t, mesh.local_index(t, to));
    const HalfFaceId at_to(t, mesh.local_index(t, from));
    record.merged.push_back({at_from, mesh.opposite_half_face(at_from), at_to, mesh.opposite_half_face(at_to)});
  }
  require(from != to && !record.merged.empty(), "An edge to collapse is not in the mesh.");
  sort_unique(record.neighbours);
  sort_unique(record.link);
  for (const auto& m : record.merged)
    require(!m.beyond_from.valid() || !mesh.has_vertex(m.beyond_from.tet(), to), "A collapse makes two tets one.");

  std::vector<VertexId> touched{to};
  for (const auto& m : record.merged) {
    for (VertexId v : mesh.vertices(m.at_to.tet()))
      if (v != from) touched.push_back(v);
    if (m.beyond_from.valid()) mesh.opposite[m.beyond_from.tet().index()][at(m.beyond_from.local())] = m.beyond_to;
    if (m.beyond_to.valid()) mesh.opposite[m.beyond_to.tet().index()][at(m.beyond_to.local())] = m.beyond_from;
    mesh.tets[m.at_to.tet().index()].fill(VertexId());
    mesh.opposite[m.at_to.tet().index()].fill(HalfFaceId());
  }
  for (TetId t : record.moved) mesh.tets[t.index()][at(mesh.local_index(t, from))] = to;
  mesh.vertex_tet[from.index()] = TetId();
  for (VertexId v : touched) repair_vertex_tet(mesh, v, record);
  for (MeshAttribute* attribute : attributes) attribute->on_collapse(mesh, record);
}

}  // namespace hexfield
