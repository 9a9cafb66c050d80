#include "hexfield/repair/remesh.hpp"
#include "hexfield/repair/state_ops.hpp"

namespace hexfield {
namespace {

template <std::size_t N>
std::array<VertexId, N> renumbered(std::array<VertexId, N> key, const std::vector<VertexId>& new_id) {
  for (VertexId& v : key) v = new_id[v.index()];  // order is kept
  return key;
}
VertexId renumbered(VertexId v, const std::vector<VertexId>& new_id) { return new_id[v.index()]; }

template <class Key>
void renumber(std::map<Key, int>& values, const std::vector<VertexId>& new_id) {
  std::map<Key, int> out;
  for (const auto& [key, value] : values) out.emplace_hint(out.end(), renumbered(key, new_id), value);
  values = std::move(out);
}

}  // namespace

void remove_unused(RepairState& state) {
  compact(state);
  TetMesh& mesh = state.mesh;
  std::vector<VertexId> new_id(mesh.num_vertices());
  std::size_t n = 0;
  for (std::size_t v = 0; v < mesh.num_vertices(); ++v) {
    if (!mesh.vertex_tet[v].valid()) continue;
    new_id[v] = VertexId(static_cast<std::int64_t>(n));
    mesh.points[n] = mesh.points[v];
    mesh.vertex_tet[n] = mesh.vertex_tet[v];
    state.target_length[n] = state.target_length[v];
    ++n;
  }
  if (n == mesh.num_vertices()) return;
  mesh.points.resize(n);
  mesh.vertex_tet.resize(n);
  state.target_length.resize(n);
  for (auto& tet : mesh.tets)
    for (VertexId& v : tet) v = new_id[v.index()];
  renumber(state.features.points, new_id);
  renumber(state.features.edges, new_id);
  renumber(state.features.faces, new_id);
  renumber(state.codes, new_id);
  renumber(state.pairs, new_id);
  std::set<EdgeKey> kept;
  for (const EdgeKey& e : state.kept) kept.insert(renumbered(e, new_id));
  state.kept = std::move(kept);
}

}  // namespace hexfield
