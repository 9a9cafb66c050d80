#include "hexfield/repair/meshability.hpp"

#include <algorithm>
#include <numeric>

#include "edge_meshability.hpp"
#include "hexfield/base/parallel.hpp"
#include "hexfield/field/edge_codes.hpp"

namespace hexfield {

using octahedral::Rotation;

namespace {

// Is the monodromy a turn by `code` quarters, about whichever axis and in whichever direction?
bool fits(Rotation monodromy, EdgeCode code) {
  if (octahedral::is_compound(monodromy)) return false;
  if (code % 4 == 0) return monodromy == octahedral::identity;
  const bool half_turn =
      monodromy != octahedral::identity && octahedral::product(monodromy, monodromy) == octahedral::identity;
  return code % 2 == 0 ? half_turn : monodromy != octahedral::identity && !half_turn;
}

bool meshable(const FieldView& view, const EdgeKey& edge, TetId seed) {
  const EdgeRing ring = edge_ring(view.mesh, seed, edge[0], edge[1]);
  return edge_meshable(view, edge, ring, sectors(view.mesh, view.features, view.field, ring, edge[0], edge[1]));
}

// Vertices with a special edge or a feature face, and all vertices that have tets.
struct VertexLists {
  std::vector<VertexId> all, to_solve;
};

VertexLists vertex_lists(const FieldView& view) {
  std::vector<char> special(view.mesh.num_vertices(), 0);
  for (const auto& entry : view.codes)
    for (VertexId v : entry.first) special[v.index()] = 1;
  for (const auto& entry : view.features.edges)
    for (VertexId v : entry.first) special[v.index()] = 1;
  for (const auto& entry : view.features.faces)
    for (VertexId v : entry.first) special[v.index()] = 1;
  for (std::size_t i = 0; i < view.mesh.num_tets(); ++i) {
    const TetId t(static_cast<std::int64_t>(i));
    if (!view.mesh.alive(t)) continue;
    for (int f = 0; f < 4; ++f)
      if (view.mesh.is_boundary(HalfFaceId(t, f)))
        for (VertexId v : view.mesh.face_vertices(HalfFaceId(t, f))) special[v.index()] = 1;
  }
  VertexLists lists;
  for (std::size_t i = 0; i < special.size(); ++i) {
    if (!view.mesh.vertex_tet[i].valid()) continue;
    lists.all.push_back(VertexId(static_cast<std::int64_t>(i)));
    if (special[i]) lists.to_solve.push_back(lists.all.back());
  }
  return lists;
}

void judge_edges(const FieldView& view, const std::vector<std::pair<EdgeKey, TetId>>& edges, Meshability& result) {
  std::vector<char> bad(edges.size(), 0);
  parallel_for(edges.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) bad[i] = !meshable(view, edges[i].first, edges[i].second);
  });
  result.edges = edges.size();
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (bad[i]) result.bad_edges.push_back(edges[i].first);
}

void judge_vertices(const FieldView& view, std::span<const VertexId> vertices, const VertexMapOptions& options,
                    Meshability& result) {
  std::vector<VertexVerdict> verdicts(vertices.size());
  std::vector<std::optional<VerdictMemory::Key>> keys(vertices.size());
  parallel_for(vertices.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      verdicts[i] = vertex_verdict(view, vertices[i], options, nullptr, &keys[i]);
  });
  result.solved = vertices.size();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (keys[i]) result.verdicts.note(*keys[i], verdicts[i]);
    if (verdicts[i] == VertexVerdict::not_meshable) result.bad_vertices.push_back(vertices[i]);
    if (verdicts[i] == VertexVerdict::meshable_when_split) result.split_first.push_back(vertices[i]);
  }
}

}  // namespace

bool edge_meshable(const FieldView& view, const EdgeKey& edge, const EdgeRing& ring, std::span<const Sector> between) {
  const auto found = view.codes.find(edge);
  const EdgeCode code = found == view.codes.end() ? 0 : found->second;
  if (code == compound_code || code == undetermined_code) return false;
  const int quads = (ring.closed ? 4 : 2) + code;
  if (quads < 1 || (ring.closed && !fits(monodromy(view.field, ring), code))) return false;
  int sum = 0;
  for (const Sector& s : between) {
    if (s.quads == undetermined_code || s.quads < 1) return false;
    sum += s.quads;
  }
  return between.empty() || sum == quads;
}

bool edge_meshable(const FieldView& view, const EdgeKey& edge) {
  const TetId seed = find_tet_with_edge(view.mesh, edge[0], edge[1]);
  return seed.valid() && meshable(view, edge, seed);
}

Meshability check_meshability(const FieldView& view, const VertexMapOptions& options) {
  Meshability result;
  judge_edges(view, all_edges(view.mesh), result);
  const VertexLists lists = vertex_lists(view);
  judge_vertices(view, lists.to_solve, options, result);
  result.vertices = lists.all.size();
  return result;
}

Meshability check_meshability(const FieldView& view, std::span<const EdgeKey> edges, std::span<const VertexId> vertices,
                              const VertexMapOptions& options) {
  Meshability result;
  std::vector<std::pair<EdgeKey, TetId>> with_tets;
  for (const EdgeKey& e : edges) with_tets.emplace_back(e, find_tet_with_edge(view.mesh, e[0], e[1]));
  judge_edges(view, with_tets, result);
  judge_vertices(view, vertices, options, result);
  result.vertices = vertices.size();
  return result;
}

std::vector<Defect> unrefuted_defects(const FieldView& view, const VertexMapOptions& options) {
  std::vector<Defect> defects = find_defects(view.mesh, view.features, view.field, view.codes);
  std::map<VertexId, int> feature_edges;
  for (const auto& entry : view.features.edges)
    for (VertexId v : entry.first) ++feature_edges[v];
  std::erase_if(defects, [&](const Defect& d) {
    if (d.vertices.size() != 1) return false;
    const auto found = feature_edges.find(d.vertices[0]);
    return found != feature_edges.end() && found->second > 2 && vertex_meshable(view, d.vertices[0], options);
  });
  return defects;
}

}  // namespace hexfield
