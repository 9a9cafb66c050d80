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

void FeatureAttribute::on_compact(const std::vector<TetId>& new_tet) {
  if (features_.tet_colours.empty()) return;
  std::size_t n = 0;
  for (std::size_t i = 0; i < new_tet.size(); ++i)
    if (new_tet[i].valid()) features_.tet_colours[n++] = features_.tet_colours[i];
  features_.tet_colours.resize(n);
}

}  // namespace hexfield
