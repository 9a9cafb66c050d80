#include <algorithm>
#include <cstdlib>

#include "hexfield/mesh/edit_legality.hpp"
#include "hexfield/mesh/quality.hpp"
#include "hexfield/repair/state_ops.hpp"
#include "remesh_context.hpp"
#include "state_backup.hpp"

namespace hexfield {
namespace {

constexpr double worst_allowed = 1e10;  // distortion of a tet after a collapse: a sliver of about 1e-5
constexpr double least_cosine = 0.9;    // between the normals of a feature face before and after

class Collapse {
 public:
  Collapse(RemeshContext& context, const VertexMarks& marks, VertexId from, VertexId to)
      : context_(context), state_(context.state), marks_(marks), from_(from), to_(to), edge_(edge_key(from, to)) {}

  bool run() {
    if (!marks_allow()) return false;
    star_ = vertex_star(state_.mesh, from_);
    if (!context_.editable(star_) || !shapes_allow()) return false;
    neighbours_ = neighbours(star_, from_);
    if (!nodes_allow() || !new_edges_allow()) return false;
    if (!collapse_keeps_topology(state_.mesh, state_.features, from_, to_)) return false;
    return try_out();
  }

 private:
  bool marks_allow() const {
    const auto f = from_.index(), t = to_.index();
    if (state_.features.points.contains(from_)) return false;
    if (marks_.on_face[f] && !marks_.on_face[t]) return false;
    if (marks_.on_curve[f] && !state_.features.edges.contains(edge_)) return false;
    return !marks_.singular[f] || state_.codes.contains(edge_);
  }

  Vec3 moved(VertexId v) const { return state_.mesh.point(v == from_ ? to_ : v); }

  // Positive tets, and feature faces that keep their direction.
  bool shapes_allow() const {
    const TetMesh& mesh = state_.mesh;
    const double limit = context_.options.collapse_needs_quality ? worst_distortion(mesh, star_) : worst_allowed;
    for (TetId t : star_) {
      const auto& v = mesh.vertices(t);
      if (!mesh.has_vertex(t, to_) && !(tet_distortion(moved(v[0]), moved(v[1]), moved(v[2]), moved(v[3])) <= limit))
        return false;
    }
    if (!marks_.on_face[from_.index()]) return true;
    for (TetId t : star_)
      for (int f = 0; f < 4; ++f) {
        const HalfFaceId h(t, f);
        const auto c = mesh.face_vertices(h);
        if (std::find(c.begin(), c.end(), from_) == c.end() || std::find(c.begin(), c.end(), to_) != c.end()) continue;
        if (!is_feature_face(state_, h)) continue;
        const Vec3 n = (moved(c[1]) - moved(c[0])).cross(moved(c[2]) - moved(c[0]));
        if (!(n.dot(outward_normal(mesh, h)) > least_cosine * n.norm())) return false;
      }
    return true;
  }

  std::vector<VertexId> neighbours(std::span<const TetId> star, VertexId v) const {
    std::vector<VertexId> found;
    for (TetId t : star)
      for (VertexId x : state_.mesh.vertices(t))
        if (x != v) found.push_back(x);
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  // Nodes and zipper nodes of the singular graph that must not disappear in features or in each other.
  bool nodes_allow() const {
    for (TetId t : star_) {
      if (!state_.mesh.has_vertex(t, to_)) continue;
      std::vector<VertexId> others;
      for (VertexId v : state_.mesh.vertices(t))
        if (v != from_ && v != to_) others.push_back(v);
      if (std::abs(code_of(state_, edge_key(others[0], others[1]))) > 1) return false;
    }
    if (!marks_.singular[from_.index()]) return true;
    std::vector<EdgeCode> codes;
    for (VertexId x : neighbours_)
      if (const EdgeCode code = code_of(state_, edge_key(from_, x)); code != 0) codes.push_back(code);
    const bool arc = codes.size() == 2 && codes[0] == codes[1];
    if (arc) return true;
    if (state_.features.points.contains(to_)) return false;
    const bool zipper = codes.size() == 2 && codes[0] + codes[1] == 0;
    if (zipper || code_of(state_, edge_) == compound_code) return true;
    if (!marks_.on_face[from_.index()] && marks_.on_face[to_.index()]) return false;
    return singular_edges_at(state_, to_).size() <= 2;
  }

  // No new edge inside between vertices of feature faces or of feature edges, and no arc that sinks into one.
  bool new_edges_allow() const {
    const bool face = marks_.on_face[to_.index()] && !marks_.on_face[from_.index()];
    const bool curve = marks_.on_curve[to_.index()] && !marks_.on_curve[from_.index()];
    if (!face && !curve) return true;
    const auto known = neighbours(vertex_star(state_.mesh, to_), to_);
    return std::none_of(neighbours_.begin(), neighbours_.end(), [&](VertexId x) {
      if (x == to_) return false;
      const bool fresh = !std::binary_search(known.begin(), known.end(), x);
      if (!fresh && !state_.codes.contains(edge_key(from_, x))) return false;
      return (face && marks_.on_face[x.index()]) || (curve && marks_.on_curve[x.index()]);
    });
  }

  bool matters(const EdgeKey& e) const {
    return (marks_.on_face[e[0].index()] && marks_.on_face[e[1].index()]) || state_.codes.contains(e);
  }

  // What the codes around must be after the collapse; merged edges with two codes are judged by their new one.
  struct Expected {
    EdgeKey edge;
    EdgeCode code;
    bool any = false;  ///< any code between -1 and 1
  };

  std::vector<Expected> expectations() const {
    const auto edges = edges_with_tets(state_.mesh, star_);
    const auto seed_of = [&](const EdgeKey& e) {
      return std::lower_bound(edges.begin(), edges.end(), std::pair(e, TetId()))->second;
    };
    std::vector<Expected> expected;
    for (const auto& [e, seed] : edges) {
      if (e == edge_) continue;
      const bool at_from = e[0] == from_ || e[1] == from_;
      const VertexId x = e[0] == from_ || e[0] == to_ ? e[1] : e[0];
      if (!at_from && e[0] != to_ && e[1] != to_) {
        if (matters(e)) expected.push_back({e, computed_code(state_, e, seed)});
        continue;
      }
      const EdgeKey other = edge_key(at_from ? to_ : from_, x);
      const auto twin = std::lower_bound(edges.begin(), edges.end(), std::pair(other, TetId()));
      if (twin == edges.end() || twin->first != other) {  // not merged: renamed, or at `to` and left alone
        if (matters(e)) expected.push_back({at_from ? other : e, computed_code(state_, e, seed)});
        continue;
      }
      if (!at_from) continue;
      const EdgeCode a = computed_code(state_, e, seed), b = computed_code(state_, other, seed_of(other));
      expected.push_back({other, a == 0 ? b : a, a != 0 && b != 0});
    }
    return expected;
  }

  bool as_expected(const std::vector<Expected>& expected, std::vector<std::pair<EdgeKey, EdgeCode>>& merged) const {
    std::vector<TetId> around;
    for (TetId t : star_)
      if (state_.mesh.alive(t)) around.push_back(t);
    around.insert(around.end(), beyond_.begin(), beyond_.end());
    const auto edges = edges_with_tets(state_.mesh, around);
    for (const Expected& x : expected) {
      const auto found = std::lower_bound(edges.begin(), edges.end(), std::pair(x.edge, TetId()));
      require(found != edges.end() && found->first == x.edge, "An edge is missing after a collapse.");
      const EdgeCode code = computed_code(state_, x.edge, found->second);
      if (x.any ? std::abs(code) > 1 : code != x.code) return false;
      if (x.any) merged.emplace_back(x.edge, code);
    }
    return true;
  }

  bool try_out() {
    std::vector<EdgeKey> edges{edge_};
    std::vector<FaceKey> faces;
    for (VertexId x : neighbours_)
      if (x != to_) edges.push_back(edge_key(from_, x)), edges.push_back(edge_key(to_, x));
    for (TetId t : star_) {
      for (int f = 0; f < 4; ++f) {
        FaceKey key = state_.mesh.key(HalfFaceId(t, f));
        const auto corner = std::find(key.begin(), key.end(), from_);
        if (corner == key.end()) continue;
        faces.push_back(key);
        *corner = to_;
        faces.push_back(face_key(key[0], key[1], key[2]));
      }
      if (!state_.mesh.has_vertex(t, to_)) continue;
      const HalfFaceId beyond = state_.mesh.opposite_half_face(HalfFaceId(t, state_.mesh.local_index(t, from_)));
      if (beyond.valid()) beyond_.push_back(beyond.tet());
    }
    const StateBackup backup(state_, star_, edges, faces);
    const auto expected = expectations();
    collapse_edge(state_, from_, to_);
    std::vector<std::pair<EdgeKey, EdgeCode>> merged;
    if (!as_expected(expected, merged)) {
      backup.restore(state_);
      ++context_.report.refused;
      return false;
    }
    for (const auto& [e, code] : merged)
      if (code == 0)
        state_.codes.erase(e), state_.pairs.erase(e), state_.kept.erase(e);
      else
        state_.codes[e] = code;
    for (TetId t : star_)
      if (state_.mesh.alive(t)) context_.report.touched.push_back(t);
    context_.touch(beyond_);
    ++context_.report.collapses;
    return true;
  }

  RemeshContext& context_;
  RepairState& state_;
  const VertexMarks& marks_;
  VertexId from_, to_;
  EdgeKey edge_;
  std::vector<TetId> star_;    // of `from`, before
  std::vector<TetId> beyond_;  // tets at `to` that lose a neighbour
  std::vector<VertexId> neighbours_;
};

}  // namespace

bool try_collapse(RemeshContext& context, const VertexMarks& marks, VertexId from, VertexId to) {
  return Collapse(context, marks, from, to).run();
}

constexpr std::size_t typical_star = 24;  // tets at a vertex

void collapse_pass(RemeshContext& context, std::span<const TetId> region) {
  std::vector<SizedEdge> edges = sized_edges(context, region);
  std::erase_if(edges, [&](const SizedEdge& e) { return e.length >= context.options.collapse_below; });
  sort_by_length(edges, false);
  if (edges.empty()) return;
  const VertexMarks marks(context.state);
  const TetMesh& mesh = context.state.mesh;
  for (const SizedEdge& e : edges) {
    if (!mesh.vertex_tet[e.edge[0].index()].valid() || !mesh.vertex_tet[e.edge[1].index()].valid()) continue;
    const bool known = mesh.has_vertex(e.seed, e.edge[0]) && mesh.has_vertex(e.seed, e.edge[1]);
    if (!known && !find_tet_with_edge(mesh, e.edge[0], e.edge[1]).valid()) continue;
    context.state.begin_operation(typical_star);
    if (!try_collapse(context, marks, e.edge[0], e.edge[1])) try_collapse(context, marks, e.edge[1], e.edge[0]);
  }
}

}  // namespace hexfield
