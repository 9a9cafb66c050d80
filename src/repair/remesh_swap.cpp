#include <algorithm>
#include <limits>

#include "hexfield/base/parallel.hpp"
#include "hexfield/field/edge_codes.hpp"
#include "hexfield/mesh/edit_legality.hpp"
#include "hexfield/mesh/quality.hpp"
#include "hexfield/repair/state_ops.hpp"
#include "remesh_context.hpp"
#include "ring_polygon.hpp"
#include "state_backup.hpp"

namespace hexfield {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int most_vertices = 7;         // of a ring
constexpr double flat_cosine = 0.94;     // between the normals of two feature faces that are flipped (20 degrees)
constexpr double least_gain = 1 - 1e-9;  // of the worst distortion
std::size_t at(int i) { return static_cast<std::size_t>(i); }

// An edge that may be swapped, and into what.
struct Plan {
  EdgeRing ring;
  std::vector<VertexId> around;
  std::vector<int> walls;
  RingTriangulation triangulation;
};

class Swap {
 public:
  Swap(const RemeshContext& context, const VertexMarks& marks, TetId seed, VertexId a, VertexId b)
      : context_(context), state_(context.state), marks_(marks), seed_(seed), a_(a), b_(b), edge_(edge_key(a, b)) {}

  // Finds a better triangulation of the ring; false when there is none.
  bool plan() {
    if (state_.codes.contains(edge_) || state_.features.edges.contains(edge_)) return false;
    plan_.ring = edge_ring(state_.mesh, seed_, a_, b_);
    const int n = static_cast<int>(plan_.ring.tets.size()) + (plan_.ring.closed ? 0 : 1);
    if (n < 3 || n > most_vertices || !context_.editable(plan_.ring.tets)) return false;
    plan_.around = ring_vertices(state_.mesh, plan_.ring, a_, b_);
    if (!plan_.ring.closed || (marks_.on_face[a_.index()] && marks_.on_face[b_.index()]))
      plan_.walls = ring_walls(state_.features, plan_.ring, plan_.around, a_, b_);
    if (!plan_.walls.empty() && !walls_allow(n)) return false;
    const std::array<int, 2> walls =
        plan_.walls.empty() ? std::array{-1, -1} : std::array{plan_.walls[0], plan_.walls[1]};
    auto best = best_triangulation(n, walls, [&](int i, int j, int k) { return cost(i, j, k); });
    if (!(best.worst < least_gain * worst_distortion(state_.mesh, plan_.ring.tets))) return false;
    plan_.triangulation = std::move(best.triangulation);
    return true;
  }

  bool run(RemeshContext& context) {
    if (!plan() ||
        !swap_keeps_topology(state_.mesh, state_.features, plan_.ring, plan_.around, plan_.triangulation, a_, b_))
      return false;
    const auto before = codes_of(plan_.ring.tets);
    const StateBackup backup(state_, plan_.ring.tets, {}, flipped_faces());
    const std::size_t slots = state_.mesh.num_tets();
    swap_edge(context.state, seed_, a_, b_, plan_.triangulation);
    std::vector<TetId> added;
    for (std::size_t i = slots; i < state_.mesh.num_tets(); ++i) added.emplace_back(static_cast<std::int64_t>(i));
    if (!align_to_features(context.state, added) || !same_codes(before, codes_of(added))) {
      backup.restore(context.state);
      ++context.report.refused;
      return false;
    }
    context.touch(added);
    ++context.report.swaps;
    return true;
  }

 private:
  bool is_wall_edge(int i, int j) const {
    return plan_.walls.size() == 2 && std::minmax(i, j) == std::minmax(plan_.walls[0], plan_.walls[1]);
  }
  const Vec3& point(int i) const { return state_.mesh.point(plan_.around[at(i)]); }

  // Both feature faces lie in a plane, and so do those that take their place.
  bool walls_allow(int n) const {
    if (plan_.walls.size() != 2) return false;
    const int x = plan_.walls[0], y = plan_.walls[1];
    if (y == x + 1 || (plan_.ring.closed && x == 0 && y == n - 1)) return false;
    const auto normal = [](const Vec3& p, const Vec3& q, const Vec3& r) { return (q - p).cross(r - p).normalized(); };
    const Vec3 &a = state_.mesh.point(a_), &b = state_.mesh.point(b_);
    const std::array<Vec3, 4> normals{normal(a, b, point(y)), normal(b, a, point(x)), normal(point(x), b, point(y)),
                                      normal(point(y), a, point(x))};
    for (const Vec3& m : normals)
      for (const Vec3& k : normals)
        if (!(m.dot(k) > flat_cosine)) return false;
    return true;
  }

  bool allowed(int i, int j, int n) const {
    const bool side = j == i + 1 || (plan_.ring.closed && i == 0 && j == n - 1);
    if (side) return true;
    const auto v = plan_.around[at(i)].index(), w = plan_.around[at(j)].index();
    if (marks_.on_curve[v] && marks_.on_curve[w]) return false;
    if (marks_.singular[v] && marks_.singular[w]) return false;
    return is_wall_edge(i, j) || !(marks_.on_face[v] && marks_.on_face[w]);
  }

  double cost(int i, int j, int k) const {
    const int n = static_cast<int>(plan_.around.size());
    if (!allowed(i, j, n) || !allowed(j, k, n) || !allowed(i, k, n)) return infinity;
    return std::max(tet_distortion(point(i), point(j), point(k), state_.mesh.point(b_)),
                    tet_distortion(point(i), point(k), point(j), state_.mesh.point(a_)));
  }

  std::vector<FaceKey> flipped_faces() const {
    std::vector<FaceKey> faces;
    for (std::size_t k = 0; k < plan_.walls.size(); ++k) {
      const VertexId x = plan_.around[at(plan_.walls[0])], y = plan_.around[at(plan_.walls[1])];
      faces.push_back(face_key(a_, b_, k == 0 ? x : y));
      faces.push_back(face_key(x, y, k == 0 ? a_ : b_));
    }
    return faces;
  }

  std::vector<std::pair<EdgeKey, EdgeCode>> codes_of(std::span<const TetId> tets) const {
    std::vector<std::pair<EdgeKey, EdgeCode>> codes;
    for (const auto& [e, t] : edges_with_tets(state_.mesh, tets))
      if (e != edge_) codes.emplace_back(e, computed_code(state_, e, t));
    return codes;
  }

  // Old edges keep their codes, new ones have none.
  static bool same_codes(const std::vector<std::pair<EdgeKey, EdgeCode>>& before,
                         const std::vector<std::pair<EdgeKey, EdgeCode>>& after) {
    return std::all_of(after.begin(), after.end(), [&](const auto& x) {
      const auto old = std::lower_bound(before.begin(), before.end(), x,
                                        [](const auto& p, const auto& q) { return p.first < q.first; });
      return old != before.end() && old->first == x.first ? old->second == x.second : x.second == 0;
    });
  }

  // False when a new tet would have one label for two feature faces.
  static bool align_to_features(RepairState& state, std::span<const TetId> added) {
    std::vector<AxisConstraint> constraints;
    for (TetId t : added) {
      std::array<octahedral::Label, 4> labels;
      std::size_t n = 0;
      for (int f = 0; f < 4; ++f) {
        const HalfFaceId h(t, f);
        if (!is_feature_face(state, h)) continue;
        const Vec3 normal = outward_normal(state.mesh, h);
        const auto label = closest_label(state.field.frames[t.index()], normal);
        if (std::find(labels.begin(), labels.begin() + static_cast<std::ptrdiff_t>(n), label) !=
            labels.begin() + static_cast<std::ptrdiff_t>(n))
          return false;
        labels[n++] = label;
        constraints.push_back({t, label, normal, AxisConstraint::Kind::feature_face, h});
      }
    }
    for (const auto& [t, c] : frame_constraints(constraints))
      state.field.frames[t.index()] = project_frame(state.field.frames[t.index()], c);
    return true;
  }

  const RemeshContext& context_;
  const RepairState& state_;
  const VertexMarks& marks_;
  TetId seed_;
  VertexId a_, b_;
  EdgeKey edge_;
  Plan plan_;
};

}  // namespace

bool try_swap(RemeshContext& context, const VertexMarks& marks, TetId seed, VertexId a, VertexId b) {
  return Swap(context, marks, seed, a, b).run(context);
}

constexpr std::size_t typical_ring = 6;  // tets at an edge

void swap_pass(RemeshContext& context, std::span<const TetId> region) {
  const TetMesh& mesh = context.state.mesh;
  const VertexMarks marks(context.state);
  const std::vector<SizedEdge> edges = sized_edges(context, region);
  std::vector<char> gains(edges.size(), 0);
  parallel_for(edges.size(), 64, [&](std::size_t begin, std::size_t end) {
    context.state.begin_operation(typical_ring * (end - begin));
    for (std::size_t i = begin; i < end; ++i)
      gains[i] = Swap(context, marks, edges[i].seed, edges[i].edge[0], edges[i].edge[1]).plan();
  });
  std::vector<SizedEdge> promising;
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (gains[i] != 0) promising.push_back(edges[i]);
  sort_by_length(promising, true);
  for (const auto& [e, old_seed, length] : promising) {
    context.state.begin_operation(typical_ring);
    const TetId seed = mesh.alive(old_seed) ? old_seed : find_tet_with_edge(mesh, e[0], e[1]);
    if (seed.valid()) try_swap(context, marks, seed, e[0], e[1]);
  }
}

}  // namespace hexfield
