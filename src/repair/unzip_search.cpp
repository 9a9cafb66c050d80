#include "hexfield/repair/unzip_search.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "hexfield/field/edge_codes.hpp"
#include "hexfield/repair/state_ops.hpp"
#include "rounding.hpp"

namespace hexfield {
namespace {

using octahedral::Label;
using octahedral::Rotation;

// A tet as first reached. Coordinates and side are those of the chart of the seed.
struct Reached {
  Vec3 coordinates = Vec3::Zero();
  Vec3 side = Vec3::Zero();
  Label seed_u = 0;
  Rotation to_seed = octahedral::identity;  // product of the matchings on the way: charts back to the seed
  HalfFaceId from;                          // half-face of the tet before; invalid at a seed
  std::size_t seed = 0;
};

class UnzipSearch {
 public:
  UnzipSearch(const RepairState& state, std::span<const UnzipSeed> seeds, const UnzipPartners& partners,
              const std::set<FaceKey>& blocked, const std::set<VertexId>& consumed, const UnzipSearchOptions& options)
      : state_(state), seeds_(seeds), partners_(partners), blocked_(blocked), consumed_(consumed), options_(options) {}

  std::optional<UnzipPath> run() {
    for (std::size_t i = 0; i < seeds_.size(); ++i) add_seed(i);
    std::optional<UnzipPath> boundary;
    double limit = std::numeric_limits<double>::infinity();
    while (!queue_.empty()) {
      const auto [distance, t] = *queue_.begin();
      queue_.erase(queue_.begin());
      if (distance > limit) break;
      state_.begin_operation(1);
      if (const UnzipPartner* partner = partner_at(t)) return path_to(t, distance, {}, *partner);
      if (!boundary)
        if (const HalfFaceId exit = exit_at(t); exit.valid()) {
          boundary = path_to(t, distance, exit, {});
          limit = distance * options_.partner_bonus * options_.partner_slack;
        }
      expand(t);
    }
    return boundary;
  }

 private:
  Vec3 in_frame(TetId t, const Vec3& x) const { return state_.field.frames[t.index()].conjugate() * x; }
  Label label_in(const Reached& r) const { return octahedral::image(octahedral::inverse(r.to_seed), r.seed_u); }
  Vec3 centre(HalfFaceId h) const {
    const auto v = state_.mesh.face_vertices(h);
    return (state_.mesh.point(v[0]) + state_.mesh.point(v[1]) + state_.mesh.point(v[2])) / 3;
  }

  double distance_of(const Reached& r) const {
    const double u = r.coordinates.dot(octahedral::direction(r.seed_u));
    return without_noise(std::sqrt(u * u + options_.deviation * std::max(0.0, r.coordinates.squaredNorm() - u * u)));
  }

  void push(TetId t, const Reached& r) {
    reached_.emplace(t, r);
    queue_.emplace(distance_of(r), t);
  }

  void add_seed(std::size_t i) {
    const UnzipSeed& seed = seeds_[i];
    if (reached_.contains(seed.tet)) return;
    Reached r;
    r.seed = i;
    r.seed_u = seed.u;
    r.coordinates = in_frame(seed.tet, centroid(state_.mesh, seed.tet) - state_.mesh.point(seed.origin));
    r.side = in_frame(seed.tet, seed.side);
    const Vec3 u = octahedral::direction(seed.u);
    r.side -= r.side.dot(u) * u;
    push(seed.tet, r);
  }

  void expand(TetId t) {
    const Reached here = reached_.at(t);
    const Label u = label_in(here);
    const Vec3 axis = state_.field.frames[t.index()] * octahedral::direction(u);
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(t, f);
      const HalfFaceId o = state_.mesh.opposite_half_face(h);
      if (!o.valid() || reached_.contains(o.tet())) continue;
      const Vec3 normal = outward_normal(state_.mesh, h);
      if (normal.dot(axis) < options_.smallest_dot) continue;
      if (is_feature_face(state_, h) && closest_label(state_.field.frames[t.index()], normal) != u) continue;
      if (!blocked_.empty() && blocked_.contains(state_.mesh.key(h))) continue;
      Reached next = here;
      next.from = h;
      next.to_seed = octahedral::product(here.to_seed, state_.field.matching(h));
      next.coordinates +=
          octahedral::apply(here.to_seed, in_frame(t, centre(h) - centroid(state_.mesh, t))) +
          octahedral::apply(next.to_seed, in_frame(o.tet(), centroid(state_.mesh, o.tet()) - centre(h)));
      push(o.tet(), next);
    }
  }

  HalfFaceId exit_at(TetId t) const {
    const Label u = label_in(reached_.at(t));
    for (int f = 0; f < 4; ++f)
      if (const HalfFaceId h(t, f); state_.mesh.is_boundary(h) &&
                                    closest_label(state_.field.frames[t.index()], outward_normal(state_.mesh, h)) == u)
        return h;
    return HalfFaceId();
  }

  const UnzipPartner* partner_at(TetId t) const {
    const Reached& r = reached_.at(t);
    const auto [first, last] = partners_.equal_range(t);
    for (auto it = first; it != last; ++it)
      if (it->second.u == label_in(r) && it->second.node != seeds_[r.seed].origin &&
          (it->second.edge == EdgeKey{} || it->second.edge != seeds_[r.seed].edge) &&
          !consumed_.contains(it->second.node))
        return &it->second;
    return nullptr;
  }

  UnzipPath path_to(TetId t, double distance, HalfFaceId exit, std::optional<UnzipPartner> partner) const {
    UnzipPath path;
    path.distance = distance;
    path.partner = partner;
    if (exit.valid()) add_face(path, exit);
    path.tets.push_back(t);
    while (reached_.at(t).from.valid()) {
      const HalfFaceId h = reached_.at(t).from;
      t = h.tet();
      path.tets.push_back(t);
      add_face(path, h);
    }
    path.seed = seeds_[reached_.at(t).seed];
    std::reverse(path.tets.begin(), path.tets.end());
    std::reverse(path.faces.begin(), path.faces.end());
    std::reverse(path.side.begin(), path.side.end());
    return path;
  }

  void add_face(UnzipPath& path, HalfFaceId h) const {
    const Reached& r = reached_.at(h.tet());
    path.faces.push_back(state_.mesh.key(h));
    path.side.push_back(state_.field.frames[h.tet().index()] *
                        octahedral::apply(octahedral::inverse(r.to_seed), r.side));
  }

  const RepairState& state_;
  std::span<const UnzipSeed> seeds_;
  const UnzipPartners& partners_;
  const std::set<FaceKey>& blocked_;
  const std::set<VertexId>& consumed_;
  const UnzipSearchOptions& options_;
  std::unordered_map<TetId, Reached> reached_;  // looked up only, never walked
  std::set<std::pair<double, TetId>> queue_;
};

}  // namespace

std::optional<UnzipPath> find_unzip_path(const RepairState& state, std::span<const UnzipSeed> seeds,
                                         const UnzipPartners& partners, const std::set<FaceKey>& blocked,
                                         const std::set<VertexId>& consumed, const UnzipSearchOptions& options) {
  return UnzipSearch(state, seeds, partners, blocked, consumed, options).run();
}

}  // namespace hexfield
