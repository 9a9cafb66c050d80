#include "hexfield/mesh/edit.hpp"

#include <algorithm>

namespace hexfield {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Replaces the tets of `star`, which are all that have every vertex of `parents`, by their children.
class SimplexSplit {
 public:
  SimplexSplit(TetMesh& mesh, std::vector<VertexId> parents, std::vector<TetId> star)
      : mesh_(mesh), star_(std::move(star)), base_(mesh.num_tets()) {
    std::sort(parents.begin(), parents.end());
    record_.parents = std::move(parents);
  }

  const SplitRecord& run() {
    add_vertex();
    for (TetId t : star_) add_children(t);
    for (std::size_t s = 0; s < star_.size(); ++s)
      for (std::size_t p = 0; p < record_.parents.size(); ++p) link_child(s, p);
    update_vertex_tets();
    for (TetId t : star_) {
      mesh_.tets[t.index()].fill(VertexId());
      mesh_.opposite[t.index()].fill(HalfFaceId());
    }
    return record_;
  }

 private:
  TetId child(std::size_t star_index, std::size_t parent) const {
    return TetId(static_cast<std::int64_t>(base_ + star_index * record_.parents.size() + parent));
  }

  void add_vertex() {
    Vec3 place = Vec3::Zero();
    for (VertexId v : record_.parents) place += mesh_.point(v);
    record_.new_vertex = VertexId(static_cast<std::int64_t>(mesh_.num_vertices()));
    mesh_.points.push_back(place / static_cast<double>(record_.parents.size()));
    mesh_.vertex_tet.push_back(child(0, 0));
  }

  void add_children(TetId old) {
    for (VertexId parent : record_.parents) {
      const TetId t(static_cast<std::int64_t>(mesh_.num_tets()));
      auto vertices = mesh_.vertices(old);
      vertices[at(mesh_.local_index(old, parent))] = record_.new_vertex;
      mesh_.tets.push_back(vertices);
      mesh_.opposite.emplace_back();
      record_.child_of.emplace_back(t, old);
    }
  }

  void link_child(std::size_t s, std::size_t p) {
    const TetId old = star_[s];
    const TetId t = child(s, p);
    for (int i = 0; i < 4; ++i) {
      const HalfFaceId h(t, i);
      const HalfFaceId old_face(old, i);
      const VertexId apex = mesh_.vertices(old)[at(i)];
      const HalfFaceId beyond = mesh_.opposite_half_face(old_face);
      HalfFaceId& opposite = mesh_.opposite[t.index()][at(i)];
      if (apex == record_.parents[p]) {  // the whole old face
        opposite = beyond;
        if (beyond.valid()) mesh_.opposite[beyond.tet().index()][at(beyond.local())] = h;
        record_.half_faces.push_back({h, old_face});
      } else if (const auto q = std::find(record_.parents.begin(), record_.parents.end(), apex);
                 q != record_.parents.end()) {  // between two children of one tet
        const auto sibling = static_cast<std::size_t>(q - record_.parents.begin());
        opposite = HalfFaceId(child(s, sibling), mesh_.local_index(old, record_.parents[p]));
        record_.half_faces.push_back({h, HalfFaceId()});
      } else {  // a part of an old face that has all parents
        if (beyond.valid()) {
          const auto n = static_cast<std::size_t>(std::find(star_.begin(), star_.end(), beyond.tet()) - star_.begin());
          require(n < star_.size(), "A tet around a split simplex is missing from its star.");
          opposite = HalfFaceId(child(n, p), beyond.local());
        }
        record_.half_faces.push_back({h, old_face});
      }
    }
  }

  void update_vertex_tets() {
    for (const auto& [t, old] : record_.child_of)
      for (VertexId v : mesh_.vertices(t))
        if (mesh_.vertex_tet[v.index()] == old) mesh_.vertex_tet[v.index()] = t;
  }

  TetMesh& mesh_;
  std::vector<TetId> star_;
  std::size_t base_;
  SplitRecord record_;
};

VertexId split(TetMesh& mesh, std::vector<VertexId> parents, std::vector<TetId> star,
               const std::vector<MeshAttribute*>& attributes) {
  SimplexSplit work(mesh, std::move(parents), std::move(star));
  const SplitRecord& record = work.run();
  for (MeshAttribute* attribute : attributes) attribute->on_split(mesh, record);
  return record.new_vertex;
}

}  // namespace

void MeshAttribute::on_collapse(const TetMesh&, const CollapseRecord&) {
  throw Error(ExitCode::bug, "An attribute of the mesh cannot follow a collapse.");
}

void MeshAttribute::on_swap(const TetMesh&, const SwapRecord&) {
  throw Error(ExitCode::bug, "An attribute of the mesh cannot follow a swap.");
}

FaceKey origin_face(const TetMesh& mesh, const SplitRecord& record, const NewHalfFace& half_face) {
  FaceKey face = mesh.key(half_face.half_face);
  const auto position = std::find(face.begin(), face.end(), record.new_vertex);
  if (position == face.end()) return face;
  // A part of an old face has all parents but the one that the new vertex replaced.
  for (VertexId parent : record.parents)
    if (std::find(face.begin(), face.end(), parent) == face.end()) {
      *position = parent;
      break;
    }
  return face_key(face[0], face[1], face[2]);
}

VertexId split_edge(TetMesh& mesh, VertexId a, VertexId b, const std::vector<MeshAttribute*>& attributes) {
  const TetId seed = find_tet_with_edge(mesh, a, b);
  require(seed.valid() && a != b, "An edge to split is not in the mesh.");
  return split(mesh, {a, b}, edge_ring(mesh, seed, a, b).tets, attributes);
}

VertexId split_face(TetMesh& mesh, HalfFaceId h, const std::vector<MeshAttribute*>& attributes) {
  require(h.valid() && h.tet().index() < mesh.num_tets() && mesh.alive(h.tet()), "A face to split is not in the mesh.");
  const auto f = mesh.face_vertices(h);
  std::vector<TetId> star{h.tet()};
  if (!mesh.is_boundary(h)) star.push_back(mesh.opposite_half_face(h).tet());
  return split(mesh, {f.begin(), f.end()}, star, attributes);
}

VertexId split_tet(TetMesh& mesh, TetId t, const std::vector<MeshAttribute*>& attributes) {
  require(t.valid() && t.index() < mesh.num_tets() && mesh.alive(t), "A tet to split is not in the mesh.");
  const auto& v = mesh.vertices(t);
  return split(mesh, {v.begin(), v.end()}, {t}, attributes);
}

void compact(TetMesh& mesh, const std::vector<MeshAttribute*>& attributes) {
  std::vector<TetId> new_tet(mesh.num_tets());
  std::size_t n = 0;
  for (std::size_t i = 0; i < mesh.num_tets(); ++i)
    if (mesh.tets[i][0].valid()) new_tet[i] = TetId(static_cast<std::int64_t>(n++));
  for (std::size_t i = 0; i < mesh.num_tets(); ++i) {
    if (!new_tet[i].valid()) continue;
    auto opposite = mesh.opposite[i];
    for (HalfFaceId& h : opposite)
      if (h.valid()) h = HalfFaceId(new_tet[h.tet().index()], h.local());
    mesh.opposite[new_tet[i].index()] = opposite;
    mesh.tets[new_tet[i].index()] = mesh.tets[i];
  }
  mesh.tets.resize(n);
  mesh.opposite.resize(n);
  for (TetId& t : mesh.vertex_tet)
    if (t.valid()) t = new_tet[t.index()];
  for (MeshAttribute* attribute : attributes) attribute->on_compact(new_tet);
}

}  // namespace hexfield
