#include "hexfield/field/presplit.hpp"

#include <algorithm>

#include "hexfield/field/edge_codes.hpp"

namespace hexfield {
namespace {

// Which vertices, edges and faces are special; follows splits by being rebuilt for every pass.
struct Marks {
  std::vector<char> on_face, on_edge;  // per vertex

  Marks(const TetMesh& mesh, const Features& features)
      : on_face(mesh.num_vertices(), 0), on_edge(mesh.num_vertices(), 0) {
    for (std::size_t i = 0; i < mesh.num_tets(); ++i) {
      const TetId t(static_cast<std::int64_t>(i));
      if (!mesh.alive(t)) continue;
      for (int f = 0; f < 4; ++f)
        if (mesh.is_boundary(HalfFaceId(t, f)))
          for (VertexId v : mesh.face_vertices(HalfFaceId(t, f))) on_face[v.index()] = 1;
    }
    for (const auto& entry : features.faces)
      for (VertexId v : entry.first) on_face[v.index()] = 1;
    for (const auto& entry : features.edges)
      for (VertexId v : entry.first) on_edge[v.index()] = 1;
  }
};

bool is_feature_face(const TetMesh& mesh, const Features& features, HalfFaceId h) {
  return mesh.is_boundary(h) || features.faces.count(mesh.key(h)) != 0;
}

std::vector<FaceKey> faces_to_split(const TetMesh& mesh, const Features& features) {
  const Marks marks(mesh, features);
  std::vector<FaceKey> found;
  for (std::size_t i = 0; i < mesh.num_tets(); ++i) {
    const TetId t(static_cast<std::int64_t>(i));
    if (!mesh.alive(t)) continue;
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(t, f);
      const HalfFaceId o = mesh.opposite_half_face(h);
      if (o.valid() && o < h) continue;
      const FaceKey key = mesh.key(h);
      if (is_feature_face(mesh, features, h)) {
        int edges = 0;
        for (std::size_t k = 0; k < 3; ++k)
          edges += static_cast<int>(features.edges.count(edge_key(key[k], key[(k + 1) % 3])));
        if (edges >= 2) found.push_back(key);
      } else if (marks.on_face[key[0].index()] && marks.on_face[key[1].index()] && marks.on_face[key[2].index()]) {
        found.push_back(key);
      }
    }
  }
  return found;
}

std::vector<EdgeKey> feature_face_edges(const TetMesh& mesh, const Features& features) {
  std::vector<EdgeKey> edges;
  auto add = [&](const FaceKey& f) {
    for (std::size_t k = 0; k < 3; ++k) edges.push_back(edge_key(f[k], f[(k + 1) % 3]));
  };
  for (std::size_t i = 0; i < mesh.num_tets(); ++i) {
    const TetId t(static_cast<std::int64_t>(i));
    if (!mesh.alive(t)) continue;
    for (int f = 0; f < 4; ++f)
      if (mesh.is_boundary(HalfFaceId(t, f))) add(mesh.key(HalfFaceId(t, f)));
  }
  for (const auto& entry : features.faces) add(entry.first);
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

std::vector<EdgeKey> edges_to_split(const TetMesh& mesh, const Features& features) {
  const Marks marks(mesh, features);
  const std::vector<EdgeKey> in_faces = feature_face_edges(mesh, features);
  std::vector<EdgeKey> found;
  for (const auto& entry : all_edges(mesh)) {
    const EdgeKey& e = entry.first;
    if (!marks.on_face[e[0].index()] || !marks.on_face[e[1].index()] || features.edges.count(e) != 0) continue;
    const bool in_face = std::binary_search(in_faces.begin(), in_faces.end(), e);
    if (!in_face || (marks.on_edge[e[0].index()] && marks.on_edge[e[1].index()])) found.push_back(e);
  }
  return found;
}

int split_faces(TetMesh& mesh, const std::vector<FaceKey>& faces, const std::vector<MeshAttribute*>& attributes) {
  int count = 0;
  for (const FaceKey& f : faces) {
    const HalfFaceId h = find_half_face(mesh, f);
    if (h.valid()) split_face(mesh, h, attributes), ++count;
  }
  return count;
}

int split_edges(TetMesh& mesh, const std::vector<EdgeKey>& edges, const std::vector<MeshAttribute*>& attributes) {
  for (const EdgeKey& e : edges) split_edge(mesh, e[0], e[1], attributes);
  return static_cast<int>(edges.size());
}

struct SpecialMarks {
  std::vector<char> special, on_feature;  // per vertex: on a special edge; on a feature edge or face
};

SpecialMarks special_marks(const TetMesh& mesh, const Features& features, const EdgeCodes& codes) {
  const Marks marks(mesh, features);
  SpecialMarks m{marks.on_edge, marks.on_face};
  for (const auto& entry : codes)
    for (VertexId v : entry.first) m.special[v.index()] = 1;
  for (std::size_t v = 0; v < m.on_feature.size(); ++v) m.on_feature[v] = m.on_feature[v] || marks.on_edge[v];
  return m;
}

}  // namespace

int split_for_features(TetMesh& mesh, const Features& features, const std::vector<MeshAttribute*>& attributes) {
  int count = split_faces(mesh, faces_to_split(mesh, features), attributes);
  count += split_edges(mesh, edges_to_split(mesh, features), attributes);
  return count;
}

int split_for_singularities(TetMesh& mesh, const Features& features, const EdgeCodes& codes,
                            const std::vector<MeshAttribute*>& attributes) {
  auto is_special = [&](const EdgeKey& e) { return features.edges.count(e) != 0 || codes.count(e) != 0; };
  std::vector<FaceKey> faces;
  for (std::size_t i = 0; i < mesh.num_tets(); ++i) {
    const TetId t(static_cast<std::int64_t>(i));
    if (!mesh.alive(t)) continue;
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(t, f);
      const HalfFaceId o = mesh.opposite_half_face(h);
      if (o.valid() && o < h) continue;
      const FaceKey k = mesh.key(h);
      if (is_special(edge_key(k[0], k[1])) && is_special(edge_key(k[1], k[2])) && is_special(edge_key(k[0], k[2])))
        faces.push_back(k);
    }
  }
  int count = split_faces(mesh, faces, attributes);
  const SpecialMarks marks = special_marks(mesh, features, codes);
  std::vector<EdgeKey> edges;
  for (const auto& entry : all_edges(mesh)) {
    const EdgeKey& e = entry.first;
    const std::size_t a = e[0].index(), b = e[1].index();
    const bool regular = !is_special(e);
    const bool singular = codes.count(e) != 0 && features.edges.count(e) == 0;
    if ((regular && marks.special[a] && marks.special[b]) || (singular && marks.on_feature[a] && marks.on_feature[b]))
      edges.push_back(e);
  }
  return count + split_edges(mesh, edges, attributes);
}

void CodesAttribute::on_split(const TetMesh&, const SplitRecord& record) {
  if (record.parents.size() != 2) return;
  const auto found = codes_.find(edge_key(record.parents[0], record.parents[1]));
  if (found == codes_.end()) return;
  const EdgeCode code = found->second;
  codes_.erase(found);
  for (VertexId v : record.parents) codes_[edge_key(v, record.new_vertex)] = code;
}

void CodesAttribute::on_collapse(const TetMesh&, const CollapseRecord& record) {
  codes_.erase(edge_key(record.from, record.to));
  for (VertexId x : record.neighbours) {
    const auto found = codes_.find(edge_key(record.from, x));
    if (found == codes_.end()) continue;
    codes_.emplace(edge_key(record.to, x), found->second);
    codes_.erase(found);
  }
}

void CodesAttribute::on_swap(const TetMesh&, const SwapRecord& record) {
  require(!record.removed_edge[0].valid() || codes_.count(record.removed_edge) == 0, "A singular edge was swapped.");
}

void CodesAttribute::on_compact(const std::vector<TetId>&) {}

}  // namespace hexfield
