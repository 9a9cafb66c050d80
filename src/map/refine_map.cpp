#include "hexfield/map/refine_map.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "hexfield/field/presplit.hpp"

namespace hexfield {
namespace {

/// What constrains a map: vertices on lines or faces, and these lines and the edges of these faces.
struct Constrained {
  std::vector<char> vertices;
  std::set<EdgeKey> edges;

  explicit Constrained(const FieldResult& field) : vertices(field.mesh.num_vertices(), 0) {
    const TetMesh& mesh = field.mesh;
    const auto add = [&](const auto& key) {
      for (std::size_t k = 0; k < key.size(); ++k) {
        vertices[key[k].index()] = 1;
        const VertexId next = key[(k + 1) % key.size()];
        edges.insert(edge_key(key[k], next));
      }
    };
    for (std::size_t i = 0; i < 4 * mesh.num_tets(); ++i) {
      const HalfFaceId h{static_cast<std::int64_t>(i)};
      if (mesh.is_boundary(h)) add(mesh.key(h));
    }
    for (const auto& entry : field.features.faces) add(entry.first);
    for (const auto& entry : field.features.edges) add(entry.first);
    for (const auto& entry : field.codes) add(entry.first);
    for (const auto& entry : field.features.points) vertices[entry.first.index()] = 1;
  }

  bool bridges(const EdgeKey& e) const {
    return vertices[e[0].index()] != 0 && vertices[e[1].index()] != 0 && edges.count(e) == 0;
  }
};

double length_in(const TetMesh& mesh, const CornerMap& map, TetId t, const EdgeKey& e) {
  const auto& f = map.uvw[t.index()];
  return (f[static_cast<std::size_t>(mesh.local_index(t, e[0]))] -
          f[static_cast<std::size_t>(mesh.local_index(t, e[1]))])
      .norm();
}

/// Edges to split with their length in the map, the longest first.
std::vector<std::pair<double, EdgeKey>> edges_to_split(const FieldResult& field, const CornerMap& map,
                                                       const std::vector<TetId>& blocking) {
  const Constrained constrained(field);
  std::map<EdgeKey, double> found;
  for (TetId t : blocking) {
    const auto& v = field.mesh.vertices(t);
    EdgeKey longest{};
    double most = -1;
    bool bridge = false;
    for (const auto& pair : tet_edge_vertices) {
      const EdgeKey e = edge_key(v[static_cast<std::size_t>(pair[0])], v[static_cast<std::size_t>(pair[1])]);
      const double length = length_in(field.mesh, map, t, e);
      if (length > most) most = length, longest = e;
      if (!constrained.bridges(e)) continue;
      bridge = true;
      found.emplace(e, length);
    }
    if (!bridge) found.emplace(longest, most);
  }
  std::vector<std::pair<double, EdgeKey>> sorted;
  for (const auto& [e, length] : found) sorted.emplace_back(length, e);
  std::sort(sorted.begin(), sorted.end(),
            [](const auto& a, const auto& b) { return a.first != b.first ? a.first > b.first : a.second < b.second; });
  return sorted;
}

}  // namespace

void MapAttribute::on_split(const TetMesh& mesh, const SplitRecord& record) {
  map_.uvw.resize(mesh.num_tets());
  map_.rotations.resize(mesh.num_tets());
  for (const auto& [fresh, old] : record.child_of) {
    const auto at = static_cast<std::size_t>(mesh.local_index(fresh, record.new_vertex));
    const auto corners = map_.uvw[old.index()];
    Vec3 mean = corners[at];
    for (std::size_t k = 0; k < 4; ++k) {
      const VertexId v = mesh.vertices(fresh)[k];
      if (k != at && std::binary_search(record.parents.begin(), record.parents.end(), v)) mean += corners[k];
    }
    map_.uvw[fresh.index()] = corners;
    map_.uvw[fresh.index()][at] = mean / static_cast<double>(record.parents.size());
  }
  for (const NewHalfFace& face : record.half_faces)
    map_.rotations[face.half_face.tet().index()][static_cast<std::size_t>(face.half_face.local())] =
        face.origin.valid() ? map_.rotation(face.origin) : octahedral::identity;
}

void MapAttribute::on_compact(const std::vector<TetId>& new_tet) {
  for (std::size_t t = 0; t < new_tet.size(); ++t) {
    if (!new_tet[t].valid()) continue;
    map_.uvw[new_tet[t].index()] = map_.uvw[t];
    map_.rotations[new_tet[t].index()] = map_.rotations[t];
  }
  const auto kept =
      static_cast<std::size_t>(std::count_if(new_tet.begin(), new_tet.end(), [](TetId t) { return t.valid(); }));
  map_.uvw.resize(kept);
  map_.rotations.resize(kept);
}

int refine_at_blocking_tets(FieldResult& field, const std::vector<CornerMap*>& maps,
                            const std::vector<TetId>& blocking) {
  const auto edges = edges_to_split(field, *maps.front(), blocking);
  FieldAttribute frames(field.field);
  FeatureAttribute features(field.features);
  CodesAttribute codes(field.codes);
  std::vector<MapAttribute> followers;
  for (CornerMap* map : maps) followers.emplace_back(*map);
  std::vector<MeshAttribute*> attributes = {&frames, &features, &codes};
  for (MapAttribute& follower : followers) attributes.push_back(&follower);
  for (const auto& entry : edges) split_edge(field.mesh, entry.second[0], entry.second[1], attributes);
  compact(field.mesh, attributes);
  return static_cast<int>(edges.size());
}

}  // namespace hexfield
