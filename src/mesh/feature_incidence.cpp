#include "feature_incidence.hpp"

#include <algorithm>
#include <tuple>

namespace hexfield {

void FeatureIncidence::set_faces(const std::map<FaceKey, int>& from) {
  faces.assign(from.begin(), from.end());
  at_edge_.clear();
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const FaceKey& f = faces[i].first;
    for (const EdgeKey& e : {EdgeKey{f[0], f[1]}, EdgeKey{f[0], f[2]}, EdgeKey{f[1], f[2]}}) at_edge_.push_back({e, i});
  }
  std::sort(at_edge_.begin(), at_edge_.end(),
            [](const AtEdge& a, const AtEdge& b) { return std::tie(a.edge, a.face) < std::tie(b.edge, b.face); });
}

void FeatureIncidence::set_edges(const std::map<EdgeKey, int>& from) {
  edges.assign(from.begin(), from.end());
  at_vertex_.clear();
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (VertexId v : edges[i].first) at_vertex_.push_back({v, i});
  std::sort(at_vertex_.begin(), at_vertex_.end(), [](const AtVertex& a, const AtVertex& b) {
    return std::tie(a.vertex, a.edge) < std::tie(b.vertex, b.edge);
  });
}

std::vector<FaceKey> outer_and_interface_faces(const TetMesh& mesh, const std::vector<int>& tet_colours) {
  std::vector<FaceKey> faces;
  for (std::size_t i = 0; i < mesh.num_tets(); ++i) {
    const TetId t(static_cast<std::int64_t>(i));
    if (!mesh.alive(t)) continue;
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(t, f);
      const HalfFaceId other = mesh.opposite_half_face(h);
      if (!other.valid() || (other < h && !tet_colours.empty() && tet_colours[i] != tet_colours[other.tet().index()]))
        faces.push_back(mesh.key(h));
    }
  }
  return faces;
}

}  // namespace hexfield
