#include <algorithm>
#include <map>

#include "hexfield/mesh/edit.hpp"

namespace hexfield {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Replaces a set of tets by others that fill the same space; outer faces are matched by their vertices.
class Refill {
 public:
  explicit Refill(TetMesh& mesh) : mesh_(mesh) {}
  SwapRecord record;

  void add(const std::array<VertexId, 4>& tet, TetId like) {
    record.added.emplace_back(TetId(static_cast<std::int64_t>(mesh_.num_tets())), like);
    mesh_.tets.push_back(tet);
    mesh_.opposite.emplace_back();
  }

  void run(const std::vector<MeshAttribute*>& attributes) {
    for (const auto& [a, b] : record.crossings) inner_.push_back(a), inner_.push_back(b);
    std::sort(inner_.begin(), inner_.end());
    std::map<FaceKey, HalfFaceId> open;  // outer faces of the old tets, then also faces of new tets without partner
    for (TetId t : record.removed)
      for (int f = 0; f < 4; ++f) note_outer(HalfFaceId(t, f), open);
    for (const auto& [t, like] : record.added)
      for (int f = 0; f < 4; ++f) link(HalfFaceId(t, f), open);
    for (TetId t : record.removed) {
      mesh_.tets[t.index()].fill(VertexId());
      mesh_.opposite[t.index()].fill(HalfFaceId());
    }
    update_vertex_tets();
    for (MeshAttribute* attribute : attributes) attribute->on_swap(mesh_, record);
  }

 private:
  void note_outer(HalfFaceId h, std::map<FaceKey, HalfFaceId>& open) const {
    if (std::binary_search(inner_.begin(), inner_.end(), h)) return;
    for (const auto& [old_face, new_face] : record.flipped)
      if (mesh_.key(h) == old_face) return;  // a flipped boundary face is gone
    open[mesh_.key(h)] = h;
  }

  void link(HalfFaceId h, std::map<FaceKey, HalfFaceId>& open) {
    const auto [found, fresh] = open.emplace(mesh_.key(h), h);
    record.half_faces.push_back({h, HalfFaceId()});
    if (fresh) return;
    const HalfFaceId other = found->second;
    const bool outer = other.tet() < record.added.front().first;
    const HalfFaceId beyond = outer ? mesh_.opposite_half_face(other) : other;
    if (outer) record.half_faces.back().origin = other;
    mesh_.opposite[h.tet().index()][at(h.local())] = beyond;
    if (beyond.valid()) mesh_.opposite[beyond.tet().index()][at(beyond.local())] = h;
    found->second = h;
  }

  void update_vertex_tets() {
    for (const auto& [t, like] : record.added)
      for (VertexId v : mesh_.vertices(t))
        if (!mesh_.alive(mesh_.vertex_tet[v.index()])) mesh_.vertex_tet[v.index()] = t;
  }

  TetMesh& mesh_;
  std::vector<HalfFaceId> inner_;  // half-faces between old tets, ascending
};

// The tet of the ring that lies on the same side of the walls as a triangle.
TetId tet_beside(const EdgeRing& ring, const RingTriangulation& triangulation, const std::array<int, 3>& triangle) {
  const auto [x, y] = triangulation.walls;
  if (x < 0 || !ring.closed) return ring.tets[std::min(at(triangle[0]), ring.tets.size() - 1)];
  const bool inside = triangle[0] >= x && triangle[2] <= y;
  for (int k : triangle)
    if ((k >= x && k < y) == inside) return ring.tets[at(k)];
  throw Error(ExitCode::bug, "A triangle of a swap crosses a feature surface.");
}

}  // namespace

std::vector<VertexId> ring_vertices(const TetMesh& mesh, const EdgeRing& ring, VertexId a, VertexId b) {
  std::vector<VertexId> around;
  // The crossing out of tet k holds a, b and r_{k + 1}; the other vertex of the tet is r_k.
  for (std::size_t k = 0; k < ring.tets.size(); ++k)
    around.push_back(mesh.vertices(ring.tets[k])[at(ring.crossings[k].local())]);
  if (!ring.closed)
    for (VertexId v : mesh.face_vertices(ring.crossings.back()))
      if (v != a && v != b) around.push_back(v);
  return around;
}

void swap_edge(TetMesh& mesh, TetId seed, VertexId a, VertexId b, const RingTriangulation& triangulation,
               const std::vector<MeshAttribute*>& attributes) {
  const EdgeRing ring = edge_ring(mesh, seed, a, b);
  const auto r = ring_vertices(mesh, ring, a, b);
  const auto [x, y] = triangulation.walls;
  require(triangulation.triangles.size() + 2 == r.size(), "A swap needs a triangulation of the ring.");
  require(ring.closed || (x == 0 && at(y) + 1 == r.size()), "A swap at the boundary needs its two walls.");
  Refill refill(mesh);
  refill.record.removed_edge = edge_key(a, b);
  refill.record.removed = ring.tets;
  for (std::size_t k = 0; k + (ring.closed ? 0 : 1) < ring.tets.size(); ++k)
    refill.record.crossings.emplace_back(ring.crossings[k], mesh.opposite_half_face(ring.crossings[k]));
  if (x >= 0)
    refill.record.flipped = {{face_key(a, b, r[at(x)]), face_key(r[at(x)], r[at(y)], a)},
                             {face_key(a, b, r[at(y)]), face_key(r[at(x)], r[at(y)], b)}};
  for (const auto& t : triangulation.triangles) {
    const TetId like = tet_beside(ring, triangulation, t);
    refill.add({r[at(t[0])], r[at(t[1])], r[at(t[2])], b}, like);
    refill.add({r[at(t[0])], r[at(t[2])], r[at(t[1])], a}, like);
  }
  refill.run(attributes);
}

void swap_face(TetMesh& mesh, HalfFaceId h, const std::vector<MeshAttribute*>& attributes) {
  const HalfFaceId o = mesh.opposite_half_face(h);
  require(o.valid(), "A face to swap is on the boundary.");
  const VertexId below = mesh.vertices(h.tet())[at(h.local())];
  const VertexId above = mesh.vertices(o.tet())[at(o.local())];
  const auto f = mesh.face_vertices(h);  // counter-clockwise seen from above
  Refill refill(mesh);
  refill.record.removed = {h.tet(), o.tet()};
  refill.record.crossings = {{h, o}};
  for (std::size_t k = 0; k < 3; ++k) refill.add({below, above, f[k], f[(k + 1) % 3]}, h.tet());
  refill.run(attributes);
}

}  // namespace hexfield
