#include "hexfield/repair/neighbourhood.hpp"

#include <algorithm>
#include <iterator>

#include "hexfield/repair/state_ops.hpp"

namespace hexfield {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Translates sorted keys between two numberings; the second member of `map_key` says whether all ids exist.
template <std::size_t N, class Translate>
std::pair<std::array<VertexId, N>, bool> translated(const std::array<VertexId, N>& key, const Translate& translate) {
  std::array<VertexId, N> out;
  for (std::size_t i = 0; i < N; ++i) {
    out[i] = translate(key[i]);
    if (!out[i].valid()) return {out, false};
  }
  std::sort(out.begin(), out.end());
  return {out, true};
}

VertexId first_vertex(VertexId v) { return v; }
template <std::size_t N>
VertexId first_vertex(const std::array<VertexId, N>& key) {
  return key[0];
}

std::array<VertexId, 1> as_key(VertexId v) { return {v}; }
template <std::size_t N>
std::array<VertexId, N> as_key(const std::array<VertexId, N>& key) {
  return key;
}
void from_key(VertexId& v, const std::array<VertexId, 1>& key) { v = key[0]; }
template <std::size_t N>
void from_key(std::array<VertexId, N>& v, const std::array<VertexId, N>& key) {
  v = key;
}

// The entries of an ordered map whose vertices are all among the copied ones.
template <class Key, class Value, class Translate>
std::map<Key, Value> copied_entries(const std::map<Key, Value>& all, const std::vector<VertexId>& vertices,
                                    const Translate& to_local) {
  std::map<Key, Value> out;
  for (VertexId v : vertices) {
    Key lowest{};
    auto low = as_key(lowest);
    low.fill(VertexId());
    low[0] = v;
    from_key(lowest, low);
    for (auto it = all.lower_bound(lowest); it != all.end() && first_vertex(it->first) == v; ++it) {
      const auto [key, complete] = translated(as_key(it->first), to_local);
      if (!complete) continue;
      Key local{};
      from_key(local, key);
      out.emplace(local, it->second);
    }
  }
  return out;
}

// Applies the difference between the entries before and now, in local ids, to the parent's map.
template <class Key, class Value, class Translate>
void write_back(const std::map<Key, Value>& before, const std::map<Key, Value>& now, std::map<Key, Value>& parent,
                const Translate& to_parent) {
  auto parent_key = [&](const Key& key) {
    Key out{};
    from_key(out, translated(as_key(key), to_parent).first);
    return out;
  };
  for (const auto& [key, value] : before)
    if (!now.contains(key)) parent.erase(parent_key(key));
  for (const auto& [key, value] : now) {
    const auto old = before.find(key);
    if (old == before.end() || !(old->second == value)) parent[parent_key(key)] = value;
  }
}

std::set<EdgeKey> copied_edges(const std::set<EdgeKey>& all, const std::vector<VertexId>& vertices,
                               const auto& to_local) {
  std::set<EdgeKey> out;
  for (VertexId v : vertices)
    for (auto it = all.lower_bound(EdgeKey{v, VertexId()}); it != all.end() && (*it)[0] == v; ++it)
      if (const auto [key, complete] = translated(*it, to_local); complete) out.insert(key);
  return out;
}

// Rings around so many seeds that looking at every tet once per ring is less work than walking through stars.
std::vector<TetId> tets_around_many(const TetMesh& mesh, std::span<const VertexId> seeds, int rings) {
  std::vector<int> reached(mesh.num_vertices(), rings + 1);  // ring in which a vertex is reached
  for (VertexId v : seeds) reached[v.index()] = 0;
  std::vector<char> inside(mesh.num_tets(), 0);
  for (int ring = 0; ring <= rings; ++ring)
    for (std::size_t i = 0; i < mesh.num_tets(); ++i) {
      const auto& tet = mesh.tets[i];
      if (inside[i] != 0 || !tet[0].valid()) continue;
      inside[i] = std::any_of(tet.begin(), tet.end(), [&](VertexId v) { return reached[v.index()] <= ring; });
      if (inside[i] == 0) continue;
      for (VertexId v : tet) reached[v.index()] = std::min(reached[v.index()], ring + 1);
    }
  std::vector<TetId> tets;
  for (std::size_t i = 0; i < inside.size(); ++i)
    if (inside[i] != 0) tets.emplace_back(static_cast<std::int64_t>(i));
  return tets;
}

constexpr std::size_t many_seeds = 100;  // one in so many tets

}  // namespace

std::vector<TetId> tets_around(const TetMesh& mesh, std::span<const VertexId> seeds, int rings) {
  if (many_seeds * seeds.size() > mesh.num_tets()) return tets_around_many(mesh, seeds, rings);
  std::vector<VertexId> reached(seeds.begin(), seeds.end());
  std::sort(reached.begin(), reached.end());
  reached.erase(std::unique(reached.begin(), reached.end()), reached.end());
  std::vector<VertexId> rim = reached;  // vertices whose stars are still missing
  std::vector<TetId> tets;
  for (int ring = 0; ring <= rings; ++ring) {
    std::vector<TetId> more;
    for (VertexId v : rim) {
      const auto star = vertex_star(mesh, v);
      more.insert(more.end(), star.begin(), star.end());
    }
    std::sort(more.begin(), more.end());
    more.erase(std::unique(more.begin(), more.end()), more.end());
    std::vector<TetId> all;
    all.reserve(tets.size() + more.size());
    std::set_union(tets.begin(), tets.end(), more.begin(), more.end(), std::back_inserter(all));
    tets = std::move(all);
    if (ring == rings) break;
    const auto vertices = vertices_of(mesh, more);
    rim.clear();
    std::set_difference(vertices.begin(), vertices.end(), reached.begin(), reached.end(), std::back_inserter(rim));
    const auto middle = static_cast<std::ptrdiff_t>(reached.size());
    reached.insert(reached.end(), rim.begin(), rim.end());
    std::inplace_merge(reached.begin(), reached.begin() + middle, reached.end());
  }
  return tets;
}

Neighbourhood::Neighbourhood(const RepairState& state, std::span<const TetId> region) {
  std::vector<TetId> inside(region.begin(), region.end());
  std::sort(inside.begin(), inside.end());
  tet_parent_ = tets_around(state.mesh, vertices_of(state.mesh, inside), 0);
  vertex_parent_ = vertices_of(state.mesh, tet_parent_);
  for (TetId t : tet_parent_) frozen_.push_back(!std::binary_search(inside.begin(), inside.end(), t));

  auto local_id = [&](VertexId v) { return to_local(v); };
  std::vector<Vec3> points;
  for (VertexId v : vertex_parent_) {
    points.push_back(state.mesh.point(v));
    local.target_length.push_back(state.target_length[v.index()]);
  }
  std::vector<std::array<VertexId, 4>> tets;
  for (TetId t : tet_parent_) {
    std::array<VertexId, 4> tet;
    std::transform(state.mesh.vertices(t).begin(), state.mesh.vertices(t).end(), tet.begin(), local_id);
    tets.push_back(tet);
    local.field.frames.push_back(state.field.frames[t.index()]);
    local.field.matchings.push_back(state.field.matchings[t.index()]);
    if (!state.features.tet_colours.empty())
      local.features.tet_colours.push_back(state.features.tet_colours[t.index()]);
  }
  local.mesh = build_tet_mesh(std::move(points), std::move(tets));
  local.features.points = copied_entries(state.features.points, vertex_parent_, local_id);
  local.features.edges = copied_entries(state.features.edges, vertex_parent_, local_id);
  local.features.faces = copied_entries(state.features.faces, vertex_parent_, local_id);
  local.codes = copied_entries(state.codes, vertex_parent_, local_id);
  local.pairs = copied_entries(state.pairs, vertex_parent_, local_id);
  local.kept = copied_edges(state.kept, vertex_parent_, local_id);
  local.watch = state.watch;
  features_before_ = local.features;
  codes_before_ = local.codes;
  pairs_before_ = local.pairs;
  kept_before_ = local.kept;
}

bool Neighbourhood::editable(TetId t) const { return t.index() >= num_copied_tets() || frozen_[t.index()] == 0; }

bool Neighbourhood::edge_inside(VertexId a, VertexId b) const {
  const TetId seed = find_tet_with_edge(local.mesh, a, b);
  if (!seed.valid()) return false;
  const EdgeRing ring = edge_ring(local.mesh, seed, a, b);
  return std::all_of(ring.tets.begin(), ring.tets.end(), [&](TetId t) { return editable(t); });
}

VertexId Neighbourhood::to_local(VertexId parent) const {
  const auto it = std::lower_bound(vertex_parent_.begin(), vertex_parent_.end(), parent);
  if (it == vertex_parent_.end() || *it != parent) return VertexId();
  return VertexId(it - vertex_parent_.begin());
}

TetId Neighbourhood::to_local(TetId parent) const {
  const auto it = std::lower_bound(tet_parent_.begin(), tet_parent_.end(), parent);
  if (it == tet_parent_.end() || *it != parent) return TetId();
  return TetId(it - tet_parent_.begin());
}

VertexId Neighbourhood::to_parent(VertexId v) const {
  return v.index() < vertex_parent_.size() ? vertex_parent_[v.index()] : VertexId();
}

namespace {

// Ids in the parent of all local vertices and tets; tets that died here are invalid unless they were copied.
struct Placement {
  std::vector<VertexId> vertices;
  std::vector<TetId> tets;
};

void append_vertices(const RepairState& local, RepairState& state, Placement& place) {
  for (std::size_t v = place.vertices.size(); v < local.mesh.num_vertices(); ++v) {
    place.vertices.emplace_back(static_cast<std::int64_t>(state.mesh.num_vertices()));
    state.mesh.points.emplace_back();
    state.mesh.vertex_tet.emplace_back();
    state.target_length.push_back(local.target_length[v]);
  }
}

void append_tets(const RepairState& local, RepairState& state, Placement& place) {
  for (std::size_t t = place.tets.size(); t < local.mesh.num_tets(); ++t) {
    if (!local.mesh.alive(TetId(static_cast<std::int64_t>(t)))) {
      place.tets.emplace_back();
      continue;
    }
    place.tets.emplace_back(static_cast<std::int64_t>(state.mesh.num_tets()));
    state.mesh.tets.emplace_back();
    state.mesh.opposite.emplace_back();
    state.field.frames.emplace_back();
    state.field.matchings.emplace_back();
    if (!local.features.tet_colours.empty()) state.features.tet_colours.push_back(local.features.tet_colours[t]);
  }
}

// `keep_outer`: boundary faces of the copy are artificial here and keep what the parent has beyond them.
void write_tet(const RepairState& local, RepairState& state, const Placement& place, TetId t, bool keep_outer) {
  const std::size_t i = t.index();
  const TetId target = place.tets[i];
  auto& tet = state.mesh.tets[target.index()];
  auto& opposite = state.mesh.opposite[target.index()];
  if (!local.mesh.alive(t)) {
    tet.fill(VertexId());
    opposite.fill(HalfFaceId());
    return;
  }
  state.field.frames[target.index()] = local.field.frames[i];
  for (int f = 0; f < 4; ++f) {
    tet[at(f)] = place.vertices[local.mesh.tets[i][at(f)].index()];
    const HalfFaceId o = local.mesh.opposite_half_face(HalfFaceId(t, f));
    if (!o.valid() && keep_outer) continue;
    opposite[at(f)] = o.valid() ? HalfFaceId(place.tets[o.tet().index()], o.local()) : HalfFaceId();
    state.field.matchings[target.index()][at(f)] = local.field.matchings[i][at(f)];
  }
}

}  // namespace

std::vector<VertexId> Neighbourhood::commit(RepairState& state) const {
  Placement place{vertex_parent_, tet_parent_};
  append_vertices(local, state, place);
  append_tets(local, state, place);
  for (std::size_t v = 0; v < local.mesh.num_vertices(); ++v) {
    const TetId t = local.mesh.vertex_tet[v];
    state.mesh.points[place.vertices[v].index()] = local.mesh.points[v];
    state.mesh.vertex_tet[place.vertices[v].index()] = t.valid() ? place.tets[t.index()] : TetId();
  }
  for (std::size_t i = 0; i < local.mesh.num_tets(); ++i) {
    const TetId t(static_cast<std::int64_t>(i));
    if (place.tets[i].valid()) write_tet(local, state, place, t, !editable(t));
  }
  auto to_parent_id = [&](VertexId v) { return place.vertices[v.index()]; };
  write_back(features_before_.points, local.features.points, state.features.points, to_parent_id);
  write_back(features_before_.edges, local.features.edges, state.features.edges, to_parent_id);
  write_back(features_before_.faces, local.features.faces, state.features.faces, to_parent_id);
  write_back(codes_before_, local.codes, state.codes, to_parent_id);
  write_back(pairs_before_, local.pairs, state.pairs, to_parent_id);
  for (const EdgeKey& key : kept_before_)
    if (!local.kept.contains(key)) state.kept.erase(edge_key(to_parent_id(key[0]), to_parent_id(key[1])));
  for (const EdgeKey& key : local.kept) state.kept.insert(edge_key(to_parent_id(key[0]), to_parent_id(key[1])));
  return place.vertices;
}

}  // namespace hexfield
