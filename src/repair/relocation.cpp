#include "hexfield/repair/relocation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <span>

#include "hexfield/base/parallel.hpp"
#include "hexfield/field/edge_codes.hpp"
#include "hexfield/mesh/quality.hpp"
#include "hexfield/repair/neighbourhood.hpp"
#include "hexfield/repair/state_ops.hpp"
#include "relocation_moves.hpp"
#include "singular_vertices.hpp"

namespace hexfield {
namespace {

constexpr std::size_t work_of_step = 10;  // Hessian, factorisation and line search per tet

using octahedral::Label;
using Place = SingularVertex::Place;

// Mean direction of the rotation axis (the axis closest to the edge without one) over the tets around an edge;
// zero when the axes cancel.
Vec3 field_direction(const RepairState& state, const EdgeKey& e) {
  const EdgeRing ring = ring_of(state.mesh, e[0], e[1]);
  const auto m = monodromy(state.field, ring);
  const Vec3 along = (state.mesh.point(e[1]) - state.mesh.point(e[0])).normalized();
  const auto mean = [&](Label start) {
    Vec3 sum = Vec3::Zero();
    const auto labels = transport_around(state.field, ring, start);
    for (std::size_t k = 0; k < labels.size(); ++k)
      sum += state.field.frames[ring.tets[k].index()] * octahedral::direction(labels[k]);
    return sum;
  };
  Vec3 best = Vec3::Zero();
  if (m != octahedral::identity && octahedral::is_axial(m))
    best = mean(octahedral::rotation_axis(m));
  else
    for (Label l = 0; l < 6; l = static_cast<Label>(l + 2))
      if (const Vec3 d = mean(l); std::abs(d.dot(along)) > std::abs(best.dot(along)) + 1e-9) best = d;
  return best.norm() < 1e-6 ? Vec3(0, 0, 0) : Vec3(best.normalized());
}

// An edge of the arcs that repel each other: singular edges of one pair id and one sign.
struct PairedEdge {
  EdgeKey edge;
  std::pair<int, bool> arc;  // id, sign of the code
};

// All of them, ordered by edge, and by vertex.
struct PairedEdges {
  std::vector<PairedEdge> edges;
  std::vector<std::pair<VertexId, std::size_t>> ends;  // vertex and place in `edges`, ascending

  explicit PairedEdges(const RepairState& state) {
    for (const auto& [e, id] : state.pairs) {
      const EdgeCode code = code_of(state, e);
      if (code == 0) continue;
      for (VertexId v : e) ends.emplace_back(v, edges.size());
      edges.push_back({e, {id, code > 0}});
    }
    std::sort(ends.begin(), ends.end());
  }
  std::span<const std::pair<VertexId, std::size_t>> at(VertexId v) const {
    const auto first = std::lower_bound(ends.begin(), ends.end(), std::pair(v, std::size_t{0}));
    auto last = first;
    while (last != ends.end() && last->first == v) ++last;
    return {first, last};
  }
};

class Builder {
 public:
  Builder(const RepairState& state, const RelocationOptions& options)
      : state_(state), options_(options), singular_(singular_vertices(state, options.may_move)) {
    std::vector<VertexId> free;
    for (const auto& v : singular_)
      if (v.place != Place::fixed) free.push_back(v.vertex);
    tets_ = tets_around(state.mesh, free, 0);
    vertices_ = vertices_of(state.mesh, tets_);
    scale_ = 1 / (0.1 * std::cbrt(options.volume > 0 ? options.volume : total_volume(state.mesh)));
    std::vector<Vec3> points;
    std::vector<RelocationEnergy::Freedom> freedoms(vertices_.size());
    for (VertexId v : vertices_) points.push_back(state.mesh.point(v));
    for (const auto& v : singular_)
      if (v.place != Place::fixed) freedoms[index(v.vertex)] = v.freedom();
    energy_ = std::make_unique<RelocationEnergy>(std::move(points), std::move(freedoms));
    add_edges();
    add_curvatures();
    add_repulsions();
    add_shapes();
  }

  const RelocationEnergy& energy() const { return *energy_; }
  const std::vector<TetId>& tets() const { return tets_; }

  std::vector<Move> moves(const Eigen::VectorXd& y) const {
    std::vector<Move> found;
    for (const auto& v : singular_)
      if (v.place != Place::fixed) found.push_back({v, energy_->position(static_cast<int>(index(v.vertex)), y), 1.0});
    return found;
  }

 private:
  bool known(VertexId v) const { return std::binary_search(vertices_.begin(), vertices_.end(), v); }
  std::size_t index(VertexId v) const {
    return static_cast<std::size_t>(std::lower_bound(vertices_.begin(), vertices_.end(), v) - vertices_.begin());
  }
  int number(VertexId v) const { return static_cast<int>(index(v)); }
  double length(VertexId a, VertexId b) const { return (state_.mesh.point(a) - state_.mesh.point(b)).norm(); }
  const SingularVertex& singular(VertexId v) const {
    return *std::lower_bound(singular_.begin(), singular_.end(), v,
                             [](const SingularVertex& s, VertexId w) { return s.vertex < w; });
  }

  void add_edges() {
    std::vector<std::pair<EdgeKey, EdgeCode>> edges;
    for (const auto& [e, code] : state_.codes)
      if (!state_.features.edges.contains(e) && known(e[0]) && known(e[1])) edges.emplace_back(e, code);
    std::vector<Vec3> directions(edges.size(), Vec3::Zero());
    parallel_for(edges.size(), 64, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        if (edges[i].second != compound_code) directions[i] = field_direction(state_, edges[i].first);
    });
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const auto& [e, code] = edges[i];
      const double factor = scale_ / length(e[0], e[1]);
      const int a = number(e[0]), b = number(e[1]);
      if (!directions[i].isZero()) energy_->add_alignment(a, b, directions[i], options_.alignment * factor);
      const SingularVertex &v = singular(e[0]), &w = singular(e[1]);
      const bool inside = v.place == Place::inside || w.place == Place::inside;
      if (code == compound_code && inside) energy_->add_shrinkage(a, b, options_.compound_shrink * factor);
      for (const SingularVertex* end : {&v, &w})
        if (end->place == Place::inside && end->is_zipper())
          energy_->add_shrinkage(a, b, options_.zipper_shrink * factor);
    }
  }

  void add_curvatures() {
    for (const auto& v : singular_) {
      if (v.place == Place::fixed || v.spokes.size() != 2) continue;
      const SingularSpoke &s = v.spokes[0], &t = v.spokes[1];
      if (s.code == compound_code || t.code == compound_code) continue;
      double weight = options_.curvature;
      if (state_.pairs.contains(edge_key(v.vertex, s.end)) && state_.pairs.contains(edge_key(v.vertex, t.end)))
        weight += 10 * options_.repulsion;
      energy_->add_curvature(number(s.end), number(v.vertex), number(t.end),
                             weight * scale_ / (length(v.vertex, s.end) + length(v.vertex, t.end)));
    }
  }

  // Every vertex of a paired arc is pushed to one target length from the closest point of another such arc nearby.
  void add_repulsions() {
    const PairedEdges paired(state_);
    if (paired.edges.empty()) return;
    std::map<std::pair<int, bool>, double> shortest;
    for (const PairedEdge& p : paired.edges)
      for (VertexId v : p.edge) {
        const auto found = shortest.emplace(p.arc, state_.target_length[v.index()]).first;
        found->second = std::min(found->second, state_.target_length[v.index()]);
      }
    for (const auto& v : singular_) {
      if (v.place == Place::fixed || v.spokes.size() > 2) continue;
      const auto own = paired.at(v.vertex);
      if (own.empty()) continue;
      const auto& arc = paired.edges[own.front().second].arc;
      const Vec3 p = state_.mesh.point(v.vertex);
      const auto [closest, distance] = closest_on_others(v.vertex, arc, paired);
      const double wished = shortest.at(arc);
      if (!(distance < wished) || distance == 0) continue;
      const Vec3 target = (p + closest) / 2 + wished * (p - closest) / distance;
      energy_->add_attraction(number(v.vertex), target, options_.repulsion * scale_ / (2 * distance));
      repelled_.push_back(v.vertex);
    }
  }

  std::pair<Vec3, double> closest_on_others(VertexId v, const std::pair<int, bool>& arc,
                                            const PairedEdges& paired) const {
    const VertexId seeds[] = {v};
    std::vector<std::size_t> near;
    for (VertexId w : vertices_of(state_.mesh, tets_around(state_.mesh, seeds, 1)))
      for (const auto& end : paired.at(w)) near.push_back(end.second);
    std::sort(near.begin(), near.end());
    std::pair<Vec3, double> best{Vec3::Zero(), std::numeric_limits<double>::infinity()};
    const Vec3& p = state_.mesh.point(v);
    for (std::size_t i : near) {
      const PairedEdge& other = paired.edges[i];
      if (other.arc == arc || other.edge[0] == v || other.edge[1] == v) continue;
      const Vec3 q = closest_on_segment(p, state_.mesh.point(other.edge[0]), state_.mesh.point(other.edge[1]));
      if ((q - p).norm() < best.second) best = {q, (q - p).norm()};
    }
    return best;
  }

  void add_shapes() {
    for (TetId t : tets_) {
      const auto& v = state_.mesh.vertices(t);
      const bool near_repelled = std::any_of(
          v.begin(), v.end(), [&](VertexId x) { return std::binary_search(repelled_.begin(), repelled_.end(), x); });
      energy_->add_tet({number(v[0]), number(v[1]), number(v[2]), number(v[3])},
                       options_.tet_shape * (near_repelled ? 10 : 1));
      for (int f = 0; f < 4; ++f) {
        const HalfFaceId h(t, f);
        const HalfFaceId o = state_.mesh.opposite_half_face(h);
        if ((o.valid() && o < h) || !is_feature_face(state_, h)) continue;
        const auto c = state_.mesh.face_vertices(h);
        energy_->add_triangle({number(c[0]), number(c[1]), number(c[2])}, outward_normal(state_.mesh, h),
                              options_.triangle_shape);
      }
    }
  }

  const RepairState& state_;
  const RelocationOptions& options_;
  std::vector<SingularVertex> singular_;
  std::vector<TetId> tets_;         // at free vertices, ascending
  std::vector<VertexId> vertices_;  // of these tets, ascending: the points of the energy
  std::vector<VertexId> repelled_;  // ascending
  double scale_ = 0;
  std::unique_ptr<RelocationEnergy> energy_;
};

}  // namespace

RelocationReport relocate_singularities(RepairState& state, const ClosestSurface& original_surface,
                                        const ClosestCurve& original_curves, const RelocationOptions& options) {
  RelocationReport report;
  const Builder builder(state, options);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(builder.energy().num_unknowns());
  report.newton = descend(builder.energy(), y, options.max_iterations, options.tolerance,
                          [&] { state.begin_operation(work_of_step * builder.tets().size()); });
  std::vector<Move> moves = builder.moves(y);
  report.vertices = static_cast<int>(moves.size());
  project_to_originals(moves, original_surface, original_curves);
  shorten_moves(state, builder.tets(), moves);
  for (const Move& m : moves) {
    report.shortened += m.share < 1;
    report.restored += m.share == 0;
  }
  report.touched = apply_moves(state, moves);
  return report;
}

}  // namespace hexfield
