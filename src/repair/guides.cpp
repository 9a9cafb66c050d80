#include "hexfield/repair/guides.hpp"

#include <algorithm>

#include "hexfield/field/edge_codes.hpp"
#include "hexfield/repair/state_ops.hpp"

namespace hexfield {

using octahedral::Label;

namespace {

constexpr double along_guide = 0.7;  // smallest dot of edge and axis for a step along a feature edge (45 degrees)

HalfFaceId exit_at(const RepairState& state, const std::vector<FlowPlace>& star, Label u, const Vec3& side) {
  HalfFaceId exit;
  double best = -std::numeric_limits<double>::infinity();
  for (const FlowPlace& p : star)
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(p.tet, f);
      if (!state.mesh.is_boundary(h) || state.mesh.vertices(p.tet)[static_cast<std::size_t>(f)] == p.vertex) continue;
      if (closest_label(state.field.frames[p.tet.index()], outward_normal(state.mesh, h)) != label_at(p, u)) continue;
      Vec3 middle = Vec3::Zero();
      for (VertexId v : state.mesh.face_vertices(h)) middle += (state.mesh.point(v) - state.mesh.point(p.vertex)) / 3;
      const double dot = middle.normalized().dot(in_space(state, p, side));
      if (dot > best + 1e-12) exit = h, best = dot;
    }
  return exit;
}

// The feature edge at the star's vertex that follows u best, as a place at its other end.
std::optional<FlowPlace> step_along(const RepairState& state, const std::vector<FlowPlace>& star, Label u) {
  std::optional<FlowPlace> next;
  double best = along_guide;
  for (const FlowPlace& p : star)
    for (VertexId w : state.mesh.vertices(p.tet)) {
      if (w == p.vertex || !state.features.edges.contains(edge_key(p.vertex, w))) continue;
      const Vec3 edge = (state.mesh.point(w) - state.mesh.point(p.vertex)).normalized();
      if (closest_label(state.field.frames[p.tet.index()], edge) != label_at(p, u)) continue;
      const double dot = edge.dot(in_space(state, p, octahedral::direction(u)));
      if (dot > best + 1e-12) best = dot, next = FlowPlace{w, p.tet, p.to_start};
    }
  return next;
}

}  // namespace

Label label_at(const FlowPlace& place, Label reference) {
  return octahedral::image(octahedral::inverse(place.to_start), reference);
}

Vec3 in_space(const RepairState& state, const FlowPlace& place, const Vec3& reference) {
  return state.field.frames[place.tet.index()] * octahedral::apply(octahedral::inverse(place.to_start), reference);
}

std::vector<FlowPlace> flow_star(const RepairState& state, const FlowPlace& place) {
  std::vector<FlowPlace> star{place};
  std::set<TetId> seen{place.tet};
  for (std::size_t i = 0; i < star.size(); ++i) {
    const FlowPlace here = star[i];
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(here.tet, f);
      if (state.mesh.vertices(here.tet)[static_cast<std::size_t>(f)] == place.vertex || is_feature_face(state, h))
        continue;
      const TetId t = state.mesh.opposite_half_face(h).tet();
      if (!seen.insert(t).second) continue;
      star.push_back({place.vertex, t, octahedral::product(here.to_start, state.field.matching(h))});
    }
  }
  return star;
}

Guide walk_guide(const RepairState& state, const FlowPlace& start, Label u, const Vec3& side) {
  Guide guide;
  guide.places = {start};
  std::set<VertexId> seen{start.vertex};
  for (;;) {
    const auto star = flow_star(state, guide.places.back());
    if (guide.places.size() > 1) guide.exit = exit_at(state, star, u, side);
    if (guide.exit.valid()) return guide;
    const auto next = step_along(state, star, u);
    if (!next || !seen.insert(next->vertex).second) return guide;
    guide.places.push_back(*next);
  }
}

}  // namespace hexfield
