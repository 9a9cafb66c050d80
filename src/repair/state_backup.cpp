#include "state_backup.hpp"

#include <algorithm>

namespace hexfield {
namespace {

template <class Map, class Key>
std::optional<int> value_of(const Map& map, const Key& key) {
  const auto found = map.find(key);
  return found == map.end() ? std::nullopt : std::optional<int>(found->second);
}

template <class Map, class Key>
void set_value(Map& map, const Key& key, const std::optional<int>& value) {
  if (value)
    map[key] = *value;
  else
    map.erase(key);
}

}  // namespace

StateBackup::StateBackup(const RepairState& state, std::span<const TetId> tets, std::span<const EdgeKey> edges,
                         std::span<const FaceKey> faces)
    : num_tets_(state.mesh.num_tets()) {
  std::vector<TetId> all(tets.begin(), tets.end());
  for (TetId t : tets)
    for (HalfFaceId o : state.mesh.opposite[t.index()])
      if (o.valid()) all.push_back(o.tet());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  for (TetId t : all) {
    tets_.push_back({t, state.mesh.tets[t.index()], state.mesh.opposite[t.index()], state.field.frames[t.index()],
                     state.field.matchings[t.index()]});
    for (VertexId v : state.mesh.vertices(t)) vertex_tets_.emplace_back(v, state.mesh.vertex_tet[v.index()]);
  }
  for (const EdgeKey& e : edges)
    edges_.push_back({e, value_of(state.features.edges, e), value_of(state.codes, e), value_of(state.pairs, e),
                      state.kept.contains(e)});
  for (const FaceKey& f : faces) faces_.emplace_back(f, value_of(state.features.faces, f));
}

void StateBackup::restore(RepairState& state) const {
  state.mesh.tets.resize(num_tets_);
  state.mesh.opposite.resize(num_tets_);
  state.field.frames.resize(num_tets_);
  state.field.matchings.resize(num_tets_);
  if (!state.features.tet_colours.empty()) state.features.tet_colours.resize(num_tets_);
  for (const Tet& t : tets_) {
    state.mesh.tets[t.id.index()] = t.vertices;
    state.mesh.opposite[t.id.index()] = t.opposite;
    state.field.frames[t.id.index()] = t.frame;
    state.field.matchings[t.id.index()] = t.matchings;
  }
  for (const auto& [v, t] : vertex_tets_) state.mesh.vertex_tet[v.index()] = t;
  for (const Edge& e : edges_) {
    set_value(state.features.edges, e.key, e.feature);
    set_value(state.codes, e.key, e.code);
    set_value(state.pairs, e.key, e.pair);
    if (e.kept)
      state.kept.insert(e.key);
    else
      state.kept.erase(e.key);
  }
  for (const auto& [key, value] : faces_) set_value(state.features.faces, key, value);
}

}  // namespace hexfield
