#include <Eigen/Cholesky>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "hexfield/base/parallel.hpp"
#include "hexfield/repair/relocation_energy.hpp"
#include "hexfield/repair/remesh.hpp"
#include "hexfield/repair/state_ops.hpp"

namespace hexfield {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double worst_term = 1e5;    // of the sum that a vertex lowers
constexpr double good_enough = 4;     // tr / det^{2/3} (3 at its best): vertices with better tets only stay
constexpr double bad_for_arcs = 12;   // the same for vertices of arcs, which lie where the field wants them
constexpr double least_cosine = 0.9;  // between normals of a feature face before and after a move
constexpr int newton_steps = 3;
constexpr int halvings = 6;
constexpr double least_decrease = 1e-3;  // of the sum, for a move

// Tets per vertex and a colouring of the vertices in which no two of a colour share a tet.
struct Stars {
  std::vector<std::size_t> first;
  std::vector<TetId> tets;
  std::vector<std::vector<VertexId>> colours;

  explicit Stars(const TetMesh& mesh) : first(mesh.num_vertices() + 1, 0) {
    for (const auto& tet : mesh.tets)
      if (tet[0].valid())
        for (VertexId v : tet) ++first[v.index() + 1];
    for (std::size_t v = 0; v < mesh.num_vertices(); ++v) first[v + 1] += first[v];
    tets.resize(first.back());
    std::vector<std::size_t> next(first.begin(), first.end() - 1);
    for (std::size_t i = 0; i < mesh.num_tets(); ++i)
      if (mesh.tets[i][0].valid())
        for (VertexId v : mesh.tets[i]) tets[next[v.index()]++] = TetId(static_cast<std::int64_t>(i));
    colour(mesh);
  }

  std::span<const TetId> of(VertexId v) const {
    return {tets.data() + first[v.index()], first[v.index() + 1] - first[v.index()]};
  }

 private:
  void colour(const TetMesh& mesh) {
    std::vector<int> given(mesh.num_vertices(), -1);
    std::vector<char> taken;
    for (std::size_t i = 0; i < mesh.num_vertices(); ++i) {
      const VertexId v(static_cast<std::int64_t>(i));
      taken.assign(colours.size() + 1, 0);
      for (TetId t : of(v))
        for (VertexId w : mesh.vertices(t))
          if (given[w.index()] >= 0) taken[static_cast<std::size_t>(given[w.index()])] = 1;
      const auto c = static_cast<std::size_t>(std::find(taken.begin(), taken.end(), 0) - taken.begin());
      if (c == colours.size()) colours.emplace_back();
      given[i] = static_cast<int>(c);
      colours[c].push_back(v);
    }
  }
};

class VertexOptimiser {
 public:
  VertexOptimiser(RepairState& state, const ClosestSurface& surface, const ClosestCurve& curves)
      : state_(state), surface_(surface), curves_(curves), stars_(state.mesh), places_(state.mesh.num_vertices()) {
    for (const auto& [f, colour] : state.features.faces)
      for (VertexId v : f) places_[v.index()] = {Place::surface, colour};
    for (const auto& [e, colour] : state.features.edges)
      for (VertexId v : e) places_[v.index()] = {Place::curve, colour};
    for (const auto& [v, colour] : state.features.points) places_[v.index()].kind = Place::fixed;
    for (const auto& [e, code] : state.codes)
      if (!state.features.edges.contains(e))
        for (VertexId v : e) places_[v.index()].singular = true;
  }

  int sweep() {
    std::atomic<int> moves = 0;
    for (const auto& colour : stars_.colours)
      parallel_for(colour.size(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          state_.begin_operation(stars_.of(colour[i]).size());
          moves += optimise(colour[i]);
        }
      });
    return moves;
  }

 private:
  struct Place {
    enum Kind { inside, surface, curve, fixed } kind = inside;
    int colour = 0;
    bool singular = false;
  };

  std::array<Vec3, 4> corners(TetId t) const {
    const auto& v = state_.mesh.vertices(t);
    return {state_.mesh.point(v[0]), state_.mesh.point(v[1]), state_.mesh.point(v[2]), state_.mesh.point(v[3])};
  }

  double worst(VertexId v) const {
    double most = 0;
    for (TetId t : stars_.of(v)) most = std::max(most, std::exp(tet_shape(corners(t))));
    return most;
  }

  double sum(VertexId v, const Vec3& p, double w) const {
    double total = 0;
    for (TetId t : stars_.of(v)) {
      auto x = corners(t);
      x[static_cast<std::size_t>(state_.mesh.local_index(t, v))] = p;
      const double shape = tet_shape(x);
      if (!std::isfinite(shape)) return infinity;
      total += std::exp(w * (std::exp(shape) - 3));
    }
    return total;
  }

  // Newton direction of the sum, Hessian made positive by a multiple of the identity; in the span of `basis`.
  Vec3 direction(VertexId v, double w, const Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3>& basis) const {
    Vec3 gradient = Vec3::Zero();
    Mat3 hessian = Mat3::Zero();
    for (TetId t : stars_.of(v)) {
      const CornerShape s = tet_corner_derivatives(corners(t), state_.mesh.local_index(t, v));
      const double q = std::exp(s.value);
      const double term = std::exp(w * (q - 3));
      const Vec3 dq = q * s.gradient;
      gradient += term * w * dq;
      hessian += term * (w * w * dq * dq.transpose() + w * q * (s.hessian + s.gradient * s.gradient.transpose()));
    }
    using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;
    const Small h = basis.transpose() * hessian * basis;
    const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> g = basis.transpose() * gradient;
    for (double shift = 0; shift < infinity; shift = shift == 0 ? 1e-3 * h.norm() : 10 * shift) {
      const Eigen::LLT<Small> llt(h + shift * Small::Identity(h.rows(), h.rows()));
      if (llt.info() == Eigen::Success) return -(basis * llt.solve(g));
      if (!(h.norm() > 0)) break;
    }
    return Vec3::Zero();
  }

  bool faces_keep_normals(VertexId v, const Vec3& p) const {
    for (TetId t : stars_.of(v))
      for (int f = 0; f < 4; ++f) {
        const HalfFaceId h(t, f);
        if (state_.mesh.vertices(t)[static_cast<std::size_t>(f)] == v || !is_feature_face(state_, h)) continue;
        const auto c = state_.mesh.face_vertices(h);
        std::array<Vec3, 3> x;
        for (std::size_t k = 0; k < 3; ++k) x[k] = c[k] == v ? p : state_.mesh.point(c[k]);
        const Vec3 n = (x[1] - x[0]).cross(x[2] - x[0]);
        if (!(n.dot(outward_normal(state_.mesh, h)) > least_cosine * n.norm())) return false;
      }
    return true;
  }

  // On the surface or curve of the input; the point itself inside and where the input has no such colour.
  Vec3 projected(const Place& place, const Vec3& p) const {
    if (place.kind == Place::surface && surface_.has(place.colour)) return surface_.project(p, place.colour).point;
    if (place.kind == Place::curve && curves_.has(place.colour)) return curves_.project(p, place.colour).point;
    return p;
  }

  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> basis(const Place& place, const Vec3& p) const {
    if (place.kind == Place::curve) {
      if (!curves_.has(place.colour)) return {3, 0};
      return curves_.project(p, place.colour).tangent;
    }
    if (place.kind == Place::surface) {
      if (!surface_.has(place.colour)) return {3, 0};
      const Vec3 n = surface_.project(p, place.colour).normal;
      Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> b(3, 2);
      b << n.unitOrthogonal(), n.cross(n.unitOrthogonal());
      return b;
    }
    return Mat3::Identity();
  }

  bool optimise(VertexId v) {
    const Place& place = places_[v.index()];
    if (place.kind == Place::fixed || stars_.of(v).empty()) return false;
    bool moved = false;
    Vec3& p = state_.mesh.points[v.index()];
    if (place.kind != Place::inside) moved |= back_to_feature(v, place);
    for (int step = 0; step < newton_steps; ++step) {
      const double most = worst(v);
      if (most < (place.singular ? bad_for_arcs : good_enough)) break;
      const double w = std::log(worst_term) / (most - 3);
      const auto b = basis(place, p);
      if (b.cols() == 0) break;
      const Vec3 d = direction(v, w, b);
      const double before = sum(v, p, w);
      double length = 1;
      bool found = false;
      for (int k = 0; k < halvings && !found; ++k, length /= 2) {
        const Vec3 q = projected(place, p + length * d);
        if (!(sum(v, q, w) < (1 - least_decrease) * before)) continue;
        if (place.kind != Place::inside && !faces_keep_normals(v, q)) continue;
        p = q;
        found = moved = true;
      }
      if (!found) break;
    }
    return moved;
  }

  // New vertices of curved features lie beside them: they go there unless a tet would suffer.
  bool back_to_feature(VertexId v, const Place& place) {
    Vec3& p = state_.mesh.points[v.index()];
    const Vec3 q = projected(place, p);
    if (q == p || !faces_keep_normals(v, q)) return false;
    const double now = worst(v);
    const Vec3 old = p;
    p = q;
    if (worst(v) <= std::max(2 * now, 2 * good_enough)) return true;
    p = old;
    return false;
  }

  RepairState& state_;
  const ClosestSurface& surface_;
  const ClosestCurve& curves_;
  Stars stars_;
  std::vector<Place> places_;
};

}  // namespace

int optimise_vertices(RepairState& state, const ClosestSurface& original_surface, const ClosestCurve& original_curves,
                      int sweeps) {
  VertexOptimiser optimiser(state, original_surface, original_curves);
  int moves = 0;
  for (int k = 0; k < sweeps; ++k) moves += optimiser.sweep();
  return moves;
}

}  // namespace hexfield
