#include "relocation_moves.hpp"

#include <algorithm>
#include <cmath>

#include "hexfield/base/parallel.hpp"
#include "hexfield/repair/neighbourhood.hpp"
#include "hexfield/repair/state_ops.hpp"

namespace hexfield {
namespace {

using Place = SingularVertex::Place;
constexpr double shorter = 0.8;
constexpr int max_rounds = 10;
// A tet with less volume than this share of the cube of its longest edge, and less than half of what it had, is bad.
constexpr double least_volume6 = 1e-7;

class MovedMesh {
 public:
  MovedMesh(const RepairState& state, std::span<const Move> moves) : state_(state), moves_(moves) {}

  // Position in `moves` of a vertex; the number of moves when it has none.
  std::size_t find(VertexId v) const {
    const auto it =
        std::lower_bound(moves_.begin(), moves_.end(), v, [](const Move& m, VertexId w) { return m.who.vertex < w; });
    return it != moves_.end() && it->who.vertex == v ? static_cast<std::size_t>(it - moves_.begin()) : moves_.size();
  }
  Vec3 place(VertexId v) const {
    const Vec3& p = state_.mesh.point(v);
    const std::size_t i = find(v);
    return i == moves_.size() ? p : Vec3(p + moves_[i].share * (moves_[i].target - p));
  }

  bool is_bad(TetId t) const {
    const auto& v = state_.mesh.vertices(t);
    std::array<Vec3, 4> x;
    for (std::size_t k = 0; k < 4; ++k) x[k] = place(v[k]);
    const double volume6 = (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]);
    if (!(volume6 > 0)) return true;
    double longest = 0;
    for (const auto& e : tet_edge_vertices)
      longest = std::max(longest, (x[static_cast<std::size_t>(e[0])] - x[static_cast<std::size_t>(e[1])]).norm());
    if (volume6 < least_volume6 * longest * longest * longest && volume6 < signed_volume6(state_.mesh, t) / 2)
      return true;
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(t, f);
      if (!is_feature_face(state_, h)) continue;
      const auto c = state_.mesh.face_vertices(h);
      const Vec3 o = place(c[0]);
      if (!((place(c[1]) - o).cross(place(c[2]) - o).dot(outward_normal(state_.mesh, h)) > 0)) return true;
    }
    return false;
  }

 private:
  const RepairState& state_;
  std::span<const Move> moves_;
};

// Moves with a vertex in a bad tet, ascending.
std::vector<std::size_t> moves_in_bad_tets(const RepairState& state, std::span<const TetId> tets,
                                           const std::vector<Move>& moves) {
  const MovedMesh moved(state, moves);
  std::vector<char> bad(tets.size(), 0);
  parallel_for(tets.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) bad[i] = moved.is_bad(tets[i]);
  });
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < tets.size(); ++i) {
    if (bad[i] == 0) continue;
    for (VertexId v : state.mesh.vertices(tets[i]))
      if (const std::size_t m = moved.find(v); m < moves.size() && moves[m].share > 0) found.push_back(m);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

// Directions of constraints where the mesh is now.
void refresh(const TetMesh& mesh, std::vector<AxisConstraint>& constraints) {
  for (AxisConstraint& c : constraints)
    c.direction = c.kind == AxisConstraint::Kind::feature_face
                      ? outward_normal(mesh, c.face)
                      : Vec3((mesh.point(c.edge[1]) - mesh.point(c.edge[0])).normalized());
}

}  // namespace

void project_to_originals(std::vector<Move>& moves, const ClosestSurface& surface, const ClosestCurve& curves) {
  parallel_for(moves.size(), 32, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Move& m = moves[i];
      if (m.who.place == Place::curve && curves.has(m.who.colour)) {
        m.target = curves.project(m.target, m.who.colour).point;
      } else if (m.who.place == Place::surface && surface.has(m.who.colour)) {
        const SurfaceProjection p = surface.project(m.target, m.who.colour);
        if (std::abs(p.normal.dot(m.who.direction)) > std::sqrt(0.5))
          m.target = p.point;
        else
          m.share = 0;
      }
    }
  });
}

void shorten_moves(const RepairState& state, std::span<const TetId> tets, std::vector<Move>& moves) {
  for (int round = 0;; ++round) {
    const auto bad = moves_in_bad_tets(state, tets, moves);
    if (bad.empty()) return;
    for (std::size_t m : bad) moves[m].share = round < max_rounds ? shorter * moves[m].share : 0;
  }
}

std::vector<TetId> apply_moves(RepairState& state, std::span<const Move> moves) {
  std::vector<VertexId> moved, on_features;
  for (const Move& m : moves) {
    if (m.share == 0 || m.target == state.mesh.point(m.who.vertex)) continue;
    moved.push_back(m.who.vertex);
    if (m.who.place != Place::inside) on_features.push_back(m.who.vertex);
  }
  const std::vector<TetId> turned = tets_around(state.mesh, on_features, 0);
  auto constraints =
      collect_constraints_of(state.mesh, state.features, state.field, state.codes, turned, SingularSign::by_geometry);
  std::erase_if(constraints, [](const auto& c) { return c.kind == AxisConstraint::Kind::singular_edge; });
  for (const Move& m : moves) {
    Vec3& p = state.mesh.points[m.who.vertex.index()];
    p += m.share * (m.target - p);
  }
  refresh(state.mesh, constraints);
  for (const auto& [t, c] : frame_constraints(constraints))
    state.field.frames[t.index()] = project_frame(state.field.frames[t.index()], c);
  return tets_around(state.mesh, moved, 0);
}

}  // namespace hexfield
