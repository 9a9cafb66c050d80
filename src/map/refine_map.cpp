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

using Lengths = std::map<EdgeKey, double>;

EdgeKey edge_of(const TetMesh& mesh, TetId t, std::size_t e) {
  const auto& v = mesh.vertices(t);
  return edge_key(v[static_cast<std::size_t>(tet_edge_vertices[e][0])],
                  v[static_cast<std::size_t>(tet_edge_vertices[e][1])]);
}

/// Adds the bridges of a tet; false when it has none.
bool add_bridges(const TetMesh& mesh, const CornerMap& map, const Constrained& constrained, TetId t, Lengths& found) {
  bool any = false;
  for (std::size_t e = 0; e < 6; ++e) {
    const EdgeKey edge = edge_of(mesh, t, e);
    if (!constrained.bridges(edge)) continue;
    found.emplace(edge, length_in(mesh, map, t, edge));
    any = true;
  }
  return any;
}

void add_longest(const TetMesh& mesh, const CornerMap& map, TetId t, Lengths& found) {
  std::pair<double, EdgeKey> longest{-1, {}};
  for (std::size_t e = 0; e < 6; ++e) {
    const EdgeKey edge = edge_of(mesh, t, e);
    const double length = length_in(mesh, map, t, edge);
    if (length > longest.first) longest = {length, edge};
  }
  found.emplace(longest.second, longest.first);
}

/// The longest edge first.
int split(FieldResult& field, const std::vector<CornerMap*>& maps, const Lengths& edges) {
  std::vector<std::pair<double, EdgeKey>> sorted;
  for (const auto& [e, length] : edges) sorted.emplace_back(-length, e);
  std::sort(sorted.begin(), sorted.end());
  FieldAttribute frames(field.field);
  FeatureAttribute features(field.features);
  CodesAttribute codes(field.codes);
  std::vector<MapAttribute> followers;
  for (CornerMap* map : maps) followers.emplace_back(*map);
  std::vector<MeshAttribute*> attributes = {&frames, &features, &codes};
  for (MapAttribute& follower : followers) attributes.push_back(&follower);
  for (const auto& entry : sorted) split_edge(field.mesh, entry.second[0], entry.second[1], attributes);
  compact(field.mesh, attributes);
  return static_cast<int>(sorted.size());
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

int split_bridges(FieldResult& field, const std::vector<CornerMap*>& maps) {
  const Constrained constrained(field);
  Lengths found;
  for (std::size_t t = 0; t < field.mesh.num_tets(); ++t)
    add_bridges(field.mesh, *maps.front(), constrained, TetId(static_cast<std::int64_t>(t)), found);
  return split(field, maps, found);
}

int refine_at_blocking_tets(FieldResult& field, const std::vector<CornerMap*>& maps,
                            const std::vector<TetId>& blocking) {
  const TetMesh& mesh = field.mesh;
  const Constrained constrained(field);
  Lengths found;
  std::vector<char> near(mesh.num_vertices(), 0);
  for (TetId t : blocking) {
    for (VertexId v : mesh.vertices(t)) near[v.index()] = 1;
    if (!add_bridges(mesh, *maps.front(), constrained, t, found)) add_longest(mesh, *maps.front(), t, found);
  }
  for (std::size_t t = 0; t < mesh.num_tets(); ++t)
    if (std::any_of(mesh.tets[t].begin(), mesh.tets[t].end(), [&](VertexId v) { return near[v.index()] != 0; }))
      add_bridges(mesh, *maps.front(), constrained, TetId(static_cast<std::int64_t>(t)), found);
  return split(field, maps, found);
}

}  // namespace hexfield
