#include "extrude.hpp"

#include <map>

#include "hexfield/base/error.hpp"

namespace hexfield {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// The values of the new tet t on the former boundary face h.
void take_values(RepairState& state, TetId t, HalfFaceId h, VertexId v) {
  const Quaternion frame = state.field.frames[h.tet().index()];
  state.field.frames.push_back(frame);
  state.field.matchings.emplace_back();
  state.field.matchings.back().fill(octahedral::identity);
  if (!state.features.tet_colours.empty()) {
    const int material = state.features.tet_colours[h.tet().index()];
    state.features.tet_colours.push_back(material);
  }
  const auto face = state.features.faces.find(state.mesh.key(h));
  if (face == state.features.faces.end()) return;
  const int colour = face->second;
  state.features.faces.erase(face);
  state.features.faces[state.mesh.key(HalfFaceId(t, state.mesh.local_index(t, v)))] = colour;
}

}  // namespace

std::vector<HalfFaceId> boundary_faces_at(const TetMesh& mesh, VertexId v) {
  std::vector<HalfFaceId> faces;
  for (TetId t : vertex_star(mesh, v))
    for (int f = 0; f < 4; ++f)
      if (const HalfFaceId h(t, f); mesh.is_boundary(h) && mesh.vertices(t)[at(f)] != v) faces.push_back(h);
  return faces;
}

VertexId extrude_vertex(RepairState& state, VertexId v, std::span<const HalfFaceId> faces) {
  TetMesh& mesh = state.mesh;
  const VertexId cover(static_cast<std::int64_t>(mesh.num_vertices()));
  const Vec3 place = mesh.point(v);
  mesh.points.push_back(place);
  mesh.vertex_tet.emplace_back(static_cast<std::int64_t>(mesh.num_tets()));
  const double length = state.target_length[v.index()];
  state.target_length.push_back(length);
  std::map<VertexId, HalfFaceId> open;  // faces (v, cover, w) that have one tet so far
  for (HalfFaceId h : faces) {
    const TetId t(static_cast<std::int64_t>(mesh.num_tets()));
    const auto below = mesh.face_vertices(h);
    mesh.tets.push_back({below[0], below[1], below[2], cover});
    mesh.opposite.emplace_back();
    take_values(state, t, h, v);
    mesh.opposite[t.index()][3] = h;
    mesh.opposite[h.tet().index()][at(h.local())] = HalfFaceId(t, 3);
    for (int i = 0; i < 3; ++i) {
      if (below[at(i)] == v) continue;
      const HalfFaceId side(t, i);
      const VertexId next = below[at((i + 1) % 3)], after = below[at((i + 2) % 3)];
      const auto [entry, first] = open.emplace(next == v ? after : next, side);
      if (first) continue;
      const HalfFaceId other = entry->second;
      mesh.opposite[t.index()][at(i)] = other;
      mesh.opposite[other.tet().index()][at(other.local())] = side;
      open.erase(entry);
    }
  }
  require(!faces.empty() && open.empty(), "The boundary faces at a vertex to extrude are no disc around it.");
  return cover;
}

}  // namespace hexfield
