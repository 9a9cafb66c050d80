#include "hexfield/repair/state_ops.hpp"

#include <algorithm>
#include <iterator>

#include "hexfield/base/parallel.hpp"
#include "hexfield/field/edge_codes.hpp"
#include "hexfield/field/matchings.hpp"
#include "hexfield/field/singularity_graph.hpp"

namespace hexfield {
namespace {

// Both halves of a split edge get what the whole one had in `values` (a map or a set of edges).
template <class Container>
void halve(Container& values, const EdgeKey& edge, VertexId middle) {
  auto whole = values.extract(edge);
  if (whole.empty()) return;
  for (VertexId end : edge) {
    if constexpr (requires { whole.mapped(); })
      values[edge_key(end, middle)] = whole.mapped();
    else
      values.insert(edge_key(end, middle));
  }
}

// Moves what `values` has for the edges at a collapsed vertex to its other end; what is there already stays.
template <class Container>
void rename(Container& values, const CollapseRecord& record) {
  values.erase(edge_key(record.from, record.to));
  for (VertexId x : record.neighbours) {
    auto node = values.extract(edge_key(record.from, x));
    if (node.empty()) continue;
    if constexpr (requires { node.mapped(); })
      values.emplace(edge_key(record.to, x), node.mapped());
    else
      values.insert(edge_key(record.to, x));
  }
}

void append(std::vector<Violation>& all, std::vector<Violation> more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace

StateAttributes::StateAttributes(RepairState& state)
    : features_(state.features), field_(state.field), values_(state), all_{&features_, &field_, &values_} {}

void StateAttributes::RepairValues::on_split(const TetMesh&, const SplitRecord& record) {
  double length = 0;
  for (VertexId v : record.parents) length += state_.target_length[v.index()];
  state_.target_length.push_back(length / static_cast<double>(record.parents.size()));
  if (record.parents.size() != 2) return;
  const EdgeKey edge = edge_key(record.parents[0], record.parents[1]);
  halve(state_.codes, edge, record.new_vertex);
  halve(state_.pairs, edge, record.new_vertex);
  halve(state_.kept, edge, record.new_vertex);
}

void StateAttributes::RepairValues::on_collapse(const TetMesh&, const CollapseRecord& record) {
  rename(state_.codes, record);
  rename(state_.pairs, record);
  rename(state_.kept, record);
}

void StateAttributes::RepairValues::on_swap(const TetMesh&, const SwapRecord& record) {
  require(!record.removed_edge[0].valid() || !state_.codes.contains(record.removed_edge),
          "A singular edge was swapped.");
}

VertexId split_edge(RepairState& state, VertexId a, VertexId b) {
  return split_edge(state.mesh, a, b, StateAttributes(state).all());
}

VertexId split_face(RepairState& state, HalfFaceId h) {
  return split_face(state.mesh, h, StateAttributes(state).all());
}

VertexId split_tet(RepairState& state, TetId t) { return split_tet(state.mesh, t, StateAttributes(state).all()); }

void collapse_edge(RepairState& state, VertexId from, VertexId to) {
  collapse_edge(state.mesh, from, to, StateAttributes(state).all());
}

void swap_edge(RepairState& state, TetId seed, VertexId a, VertexId b, const RingTriangulation& triangulation) {
  swap_edge(state.mesh, seed, a, b, triangulation, StateAttributes(state).all());
}

void compact(RepairState& state) { compact(state.mesh, StateAttributes(state).all()); }

void set_matching(RepairState& state, HalfFaceId h, octahedral::Rotation matching) {
  const HalfFaceId o = state.mesh.opposite_half_face(h);
  require(o.valid(), "A boundary face has no matching to set.");
  state.field.matchings[h.tet().index()][static_cast<std::size_t>(h.local())] = matching;
  state.field.matchings[o.tet().index()][static_cast<std::size_t>(o.local())] = octahedral::inverse(matching);
}

bool is_feature_face(const RepairState& state, HalfFaceId h) {
  return state.mesh.is_boundary(h) || state.features.faces.contains(state.mesh.key(h));
}

bool on_feature_face(const RepairState& state, VertexId v) {
  for (TetId t : vertex_star(state.mesh, v))
    for (int f = 0; f < 4; ++f)
      if (state.mesh.vertices(t)[static_cast<std::size_t>(f)] != v && is_feature_face(state, HalfFaceId(t, f)))
        return true;
  return false;
}

bool on_feature_edge(const RepairState& state, VertexId v) {
  return std::ranges::any_of(edges_at(state.mesh, v),
                             [&](const EdgeKey& e) { return state.features.edges.contains(e); });
}

bool on_feature_curve(const RepairState& state, VertexId v) {
  return state.features.points.contains(v) || on_feature_edge(state, v);
}

std::vector<VertexId> along_arc(const RepairState& state, VertexId v, EdgeKey edge, int steps) {
  std::vector<VertexId> vertices;
  for (int i = 0; i < steps; ++i) {
    v = other_end(edge, v);
    vertices.push_back(v);
    const auto here = singular_edges_at(state, v);
    if (here.size() != 2) break;
    edge = here[0] == edge ? here[1] : here[0];
  }
  return vertices;
}

bool in_feature_face(const RepairState& state, const EdgeRing& ring) {
  return !ring.closed || std::any_of(ring.crossings.begin(), ring.crossings.end(),
                                     [&](HalfFaceId h) { return is_feature_face(state, h); });
}

bool in_feature_face(const RepairState& state, const EdgeKey& edge) {
  return in_feature_face(state, ring_of(state.mesh, edge[0], edge[1]));
}

bool is_special(const RepairState& state, const EdgeKey& edge) {
  return state.codes.contains(edge) || state.features.edges.contains(edge);
}

EdgeCode code_of(const RepairState& state, const EdgeKey& edge) {
  const auto found = state.codes.find(edge);
  return found == state.codes.end() ? 0 : found->second;
}

bool on_boundary(const TetMesh& mesh, VertexId v) {
  for (TetId t : vertex_star(mesh, v))
    for (int f = 0; f < 4; ++f)
      if (mesh.vertices(t)[static_cast<std::size_t>(f)] != v && mesh.is_boundary(HalfFaceId(t, f))) return true;
  return false;
}

std::vector<VertexId> vertices_of(const TetMesh& mesh, std::span<const TetId> tets) {
  std::vector<VertexId> all;
  for (TetId t : tets) all.insert(all.end(), mesh.vertices(t).begin(), mesh.vertices(t).end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

int new_pair(const RepairState& state) {
  int pair = 0;
  for (const auto& [edge, id] : state.pairs) pair = std::max(pair, id + 1);
  return pair;
}

std::vector<EdgeKey> edges_of(const TetMesh& mesh, std::span<const TetId> tets) {
  std::vector<EdgeKey> edges;
  for (TetId t : tets) {
    const auto& v = mesh.vertices(t);
    for (const auto& e : tet_edge_vertices)
      edges.push_back(edge_key(v[static_cast<std::size_t>(e[0])], v[static_cast<std::size_t>(e[1])]));
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

std::vector<EdgeKey> edges_at(const TetMesh& mesh, VertexId v) {
  std::vector<VertexId> ends;
  for (TetId t : vertex_star(mesh, v))
    for (VertexId w : mesh.vertices(t))
      if (w != v) ends.push_back(w);
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::vector<EdgeKey> edges;
  for (VertexId w : ends) edges.push_back(edge_key(v, w));
  return edges;
}

std::vector<EdgeKey> singular_edges_at(const RepairState& state, VertexId v) {
  std::vector<EdgeKey> edges = edges_at(state.mesh, v);
  std::erase_if(edges, [&](const EdgeKey& e) { return !state.codes.contains(e); });
  return edges;
}

EdgeRing ring_of(const TetMesh& mesh, VertexId a, VertexId b) {
  return edge_ring(mesh, find_tet_with_edge(mesh, a, b), a, b);
}

void update_codes(RepairState& state, std::span<const EdgeKey> edges) {
  std::vector<std::pair<EdgeKey, TetId>> with_tets(edges.size());
  parallel_for(edges.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      with_tets[i] = {edges[i], find_tet_with_edge(state.mesh, edges[i][0], edges[i][1])};
  });
  update_codes(state, with_tets);
}

void update_codes(RepairState& state, std::span<const std::pair<EdgeKey, TetId>> edges) {
  std::vector<EdgeCode> codes(edges.size(), 0);
  parallel_for(edges.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& [e, seed] = edges[i];
      if (seed.valid())
        codes[i] =
            edge_code(state.mesh, state.features, state.field, edge_ring(state.mesh, seed, e[0], e[1]), e[0], e[1]);
    }
  });
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (codes[i] == 0)
      state.codes.erase(edges[i].first);
    else
      state.codes[edges[i].first] = codes[i];
}

namespace {

// Frames that turn less than this in a sweep have settled: a hundredth of what decides a code.
constexpr double settled_turn = 1e-3;

AlignReport smooth_aligned(RepairState& state, std::span<const TetId> tets, int sweeps, const EdgeCodes& codes,
                           SingularSign sign, double tolerance) {
  std::vector<TetId> ordered(tets.begin(), tets.end());
  std::sort(ordered.begin(), ordered.end());
  const auto constraints = collect_constraints_of(state.mesh, state.features, state.field, codes, ordered, sign);
  AlignOptions options;
  options.sweeps = sweeps;
  options.tolerance = tolerance;
  return align_submesh(state.mesh, state.field, constraints, ordered, options);
}

}  // namespace

AlignReport smooth(RepairState& state, std::span<const TetId> tets, int sweeps, SingularSign sign) {
  return smooth_aligned(state, tets, sweeps, state.codes, sign, 0);
}

AlignReport smooth_to_features(RepairState& state, std::span<const TetId> tets, int sweeps) {
  return smooth_aligned(state, tets, sweeps, {}, SingularSign::by_geometry, settled_turn);
}

std::vector<Violation> check(const RepairState& state) {
  std::vector<Violation> all = check(state.mesh);
  append(all, check(state.mesh, state.features));
  append(all, check(state.mesh, state.field));
  if (!all.empty()) return all;
  const SingularityGraph graph = singularity_graph(state.mesh, state.features, state.field, state.codes);
  append(all, check(state.mesh, state.field, state.codes, graph));
  if (state.target_length.size() != state.mesh.num_vertices())
    all.push_back({"The target lengths are not one per vertex.", {}, {}});
  return all;
}

}  // namespace hexfield
