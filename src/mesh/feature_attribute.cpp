#include <algorithm>

#include "hexfield/mesh/edit.hpp"

namespace hexfield {

void FeatureAttribute::on_split(const TetMesh& mesh, const SplitRecord& record) {
  if (record.parents.size() == 2) {
    const auto edge = features_.edges.find(edge_key(record.parents[0], record.parents[1]));
    if (edge != features_.edges.end()) {
      const int colour = edge->second;
      features_.edges.erase(edge);
      for (VertexId parent : record.parents) features_.edges[edge_key(parent, record.new_vertex)] = colour;
    }
  }
  std::vector<FaceKey> replaced;
  for (const NewHalfFace& part : record.half_faces) {
    if (!part.origin.valid()) continue;
    const FaceKey face = mesh.key(part.half_face);
    const FaceKey origin = origin_face(mesh, record, part);
    const auto feature = features_.faces.find(origin);
    if (face == origin || feature == features_.faces.end()) continue;
    features_.faces[face] = feature->second;
    replaced.push_back(origin);
  }
  for (const FaceKey& face : replaced) features_.faces.erase(face);
  if (features_.tet_colours.empty()) return;
  features_.tet_colours.resize(mesh.num_tets());
  for (const auto& [child, old] : record.child_of)
    features_.tet_colours[child.index()] = features_.tet_colours[old.index()];
}

void FeatureAttribute::on_collapse(const TetMesh& mesh, const CollapseRecord& record) {
  require(features_.points.count(record.from) == 0, "A feature point was collapsed.");
  auto take = [](auto& colours, const auto& key) {
    const auto found = colours.find(key);
    if (found == colours.end()) return 0;
    const int colour = found->second;
    colours.erase(found);
    return colour;
  };
  take(features_.edges, edge_key(record.from, record.to));
  for (VertexId x : record.neighbours)
    if (const int colour = take(features_.edges, edge_key(record.from, x)); colour != 0)
      features_.edges.emplace(edge_key(record.to, x), colour);
  for (const EdgeKey& e : record.link) {
    const int colour = take(features_.faces, face_key(record.from, e[0], e[1]));
    if (colour != 0 && e[0] != record.to && e[1] != record.to)
      features_.faces.emplace(face_key(record.to, e[0], e[1]), colour);
  }
  if (!features_.tet_colours.empty()) features_.tet_colours.resize(mesh.num_tets());
}

void FeatureAttribute::on_swap(const TetMesh& mesh, const SwapRecord& record) {
  require(!record.removed_edge[0].valid() || features_.edges.count(record.removed_edge) == 0,
          "A feature edge was swapped.");
  for (const auto& [old_face, new_face] : record.flipped) {
    const auto found = features_.faces.find(old_face);
    if (found == features_.faces.end()) continue;
    const int colour = found->second;
    features_.faces.erase(found);
    features_.faces.emplace(new_face, colour);
  }
  if (features_.tet_colours.empty()) return;
  features_.tet_colours.resize(mesh.num_tets());
  for (const auto& [t, like] : record.added) features_.tet_colours[t.index()] = features_.tet_colours[like.index()];
}

void FeatureAttribute::on_compact(const std::vector<TetId>& new_tet) {
  if (features_.tet_colours.empty()) return;
  std::size_t n = 0;
  for (std::size_t i = 0; i < new_tet.size(); ++i)
    if (new_tet[i].valid()) features_.tet_colours[n++] = features_.tet_colours[i];
  features_.tet_colours.resize(n);
}

}  // namespace hexfield
