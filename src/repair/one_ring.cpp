#include "hexfield/repair/one_ring.hpp"

#include <algorithm>

#include "hexfield/field/edge_codes.hpp"
#include "hexfield/repair/field_snapshot.hpp"
#include "hexfield/repair/state_ops.hpp"

namespace hexfield {
namespace {

using octahedral::Label;

Spoke make_spoke(const RepairState& state, const EdgeKey& edge, VertexId centre) {
  Spoke spoke;
  spoke.end = edge[0] == centre ? edge[1] : edge[0];
  spoke.edge = edge;
  spoke.code = code_of(state, edge);
  spoke.feature = state.features.edges.contains(edge);
  const EdgeRing ring = ring_of(state.mesh, centre, spoke.end);
  spoke.boundary = !ring.closed;
  spoke.in_surface = in_feature_face(state, ring);
  spoke.tets = ring.tets;
  Label label = octahedral::no_label;
  if (ring.closed && spoke.code != compound_code)
    label = outgoing_label(state.mesh, state.field, ring, spoke.code, centre, spoke.end);
  if (label == octahedral::no_label && spoke.code != compound_code) label = label_along(state, ring, centre, spoke.end);
  if (label != octahedral::no_label) spoke.labels = transport_around(state.field, ring, label);
  return spoke;
}

}  // namespace

Label Spoke::label_in(TetId t) const {
  const auto found = std::find(tets.begin(), tets.end(), t);
  if (labels.empty() || found == tets.end()) return octahedral::no_label;
  return labels[static_cast<std::size_t>(found - tets.begin())];
}

OneRing::OneRing(RepairState& state, VertexId centre) : centre_(centre), tets_(vertex_star(state.mesh, centre)) {
  for (std::size_t i = 0; i < tets_.size(); ++i) index_.emplace(tets_[i], static_cast<int>(i));
  const FieldSnapshot before(state, tets_);
  smooth(state, tets_, 20);
  for (TetId t : tets_) frames_.push_back(state.field.frames[t.index()]);
  before.restore(state);
  region_.assign(tets_.size(), -1);
  int regions = 0;
  for (std::size_t seed = 0; seed < tets_.size(); ++seed) {
    if (region_[seed] >= 0) continue;
    std::vector<TetId> queue{tets_[seed]};
    region_[seed] = regions;
    for (std::size_t i = 0; i < queue.size(); ++i)
      for (int f = 0; f < 4; ++f) {
        const HalfFaceId h(queue[i], f);
        if (state.mesh.vertices(queue[i])[static_cast<std::size_t>(f)] == centre || is_feature_face(state, h)) continue;
        const TetId next = state.mesh.opposite_half_face(h).tet();
        int& region = region_[static_cast<std::size_t>(index(next))];
        if (region < 0) region = regions, queue.push_back(next);
      }
    ++regions;
  }
  for (const EdgeKey& e : edges_at(state.mesh, centre))
    if (is_special(state, e)) spokes_.push_back(make_spoke(state, e, centre));
  labels_at_.resize(tets_.size());
  for (std::size_t i = 0; i < spokes_.size(); ++i)
    for (std::size_t k = 0; k < spokes_[i].labels.size(); ++k)
      labels_at_[static_cast<std::size_t>(index(spokes_[i].tets[k]))].emplace_back(i, spokes_[i].labels[k]);
}

const Spoke* OneRing::spoke(VertexId end) const {
  for (const Spoke& s : spokes_)
    if (s.end == end) return &s;
  return nullptr;
}

int OneRing::index(TetId t) const {
  const auto found = index_.find(t);
  return found == index_.end() ? -1 : found->second;
}

Vec3 OneRing::axis(TetId t, Label label) const { return frame(t) * octahedral::direction(label); }

Label label_along(const RepairState& state, const EdgeRing& ring, VertexId a, VertexId b) {
  const Vec3 e = (state.mesh.point(b) - state.mesh.point(a)).normalized();
  const auto m = monodromy(state.field, ring);
  std::vector<std::pair<std::size_t, Label>> normals;
  auto note = [&](std::size_t k, HalfFaceId h) {
    if (is_feature_face(state, h))
      normals.emplace_back(k, closest_label(state.field.frames[ring.tets[k].index()], outward_normal(state.mesh, h)));
  };
  if (!ring.closed) note(0, ring.first_boundary);
  for (std::size_t k = 0; k < ring.tets.size(); ++k) {
    note(k, ring.crossings[k]);
    if (ring.closed && is_feature_face(state, ring.crossings[k]))
      note((k + 1) % ring.tets.size(), state.mesh.opposite_half_face(ring.crossings[k]));
  }
  Label best = octahedral::no_label;
  double most = 0;
  for (Label start = 0; start < 6; ++start) {
    if (octahedral::image(m, start) != start) continue;
    const auto labels = transport_around(state.field, ring, start);
    const bool across = std::any_of(normals.begin(), normals.end(), [&](const auto& n) {
      return octahedral::axis(labels[n.first]) == octahedral::axis(n.second);
    });
    if (across) continue;
    double dot = 0;
    for (std::size_t k = 0; k < ring.tets.size(); ++k)
      dot += (state.field.frames[ring.tets[k].index()] * octahedral::direction(labels[k])).dot(e);
    if (dot > most + 1e-9) best = start, most = dot;
  }
  return best;
}

}  // namespace hexfield
