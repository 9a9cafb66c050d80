#include "hexfield/repair/zipping.hpp"

#include <algorithm>
#include <set>

#include "hexfield/field/edge_codes.hpp"
#include "hexfield/repair/field_snapshot.hpp"
#include "hexfield/repair/state_ops.hpp"

namespace hexfield {
namespace {

using octahedral::Label;
using octahedral::Rotation;

// The rotation that takes the axes a and b (perpendicular) to c and d.
Rotation rotation_between(Label a, Label b, Label c, Label d) {
  for (Rotation r = 0; r < octahedral::order; ++r)
    if (octahedral::image(r, a) == c && octahedral::image(r, b) == d) return r;
  return octahedral::identity;
}

// The label closest to a direction among those perpendicular to another one.
Label closest_across(const Quaternion& frame, const Vec3& direction, Label across) {
  const Vec3 d = frame.conjugate() * direction;
  Label best = octahedral::no_label;
  double most = -2;
  for (Label l = 0; l < 6; ++l) {
    if (octahedral::axis(l) == octahedral::axis(across)) continue;
    const double dot = octahedral::sign(l) * d[octahedral::axis(l)];
    if (dot > most + 1e-12) best = l, most = dot;
  }
  return best;
}

// Matching from the last tet of an open ring through the outside to the first.
Rotation virtual_closure(const RepairState& state, const EdgeRing& ring, VertexId a, VertexId b) {
  const Vec3 e = state.mesh.point(b) - state.mesh.point(a);
  const Quaternion& first = state.field.frames[ring.tets.front().index()];
  const Quaternion& last = state.field.frames[ring.tets.back().index()];
  const Label n0 = closest_label(first, outward_normal(state.mesh, ring.first_boundary));
  const Label n1 = closest_label(last, outward_normal(state.mesh, ring.crossings.back()));
  return rotation_between(n0, closest_across(first, e, n0), n1, closest_across(last, e, n1));
}

bool is_half_turn(Rotation r) { return r != octahedral::identity && octahedral::product(r, r) == octahedral::identity; }

int num_empty(const RepairState& state, const EdgeRing& ring, const EdgeKey& edge) {
  int empty = 0;
  for (const Sector& s : sectors(state.mesh, state.features, state.field, ring, edge[0], edge[1])) empty += s.quads < 1;
  return empty;
}

// The matchings of a patch while they are found one after the other.
class Zipping {
 public:
  Zipping(RepairState& state, const ZipPatch& patch) : state_(state), patch_(patch) {
    unknown_.insert(patch.faces.begin(), patch.faces.end());
    fixed_.insert(patch.boundary.begin(), patch.boundary.end());
    fixed_.insert(patch.start);
    for (const FaceKey& f : patch.faces)
      for (const EdgeKey& e : edges_of_face(f)) edges_.push_back(e);
    std::sort(edges_.begin(), edges_.end());
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
    for (const EdgeKey& e : edges_) rings_.push_back(ring_of(state.mesh, e[0], e[1]));
    for (const EdgeRing& ring : rings_) before_.push_back(monodromy(state.field, ring));
  }

  bool solve(Rotation target) {
    if (!determine(patch_.start, target)) return false;
    for (std::size_t i = 0; i < queue_.size(); ++i)
      for (const EdgeKey& e : edges_of_face(queue_[i]))
        if (!fixed_.contains(e) && ring(e).closed) determine(e, octahedral::identity);
    return unknown_.empty();
  }

  bool admissible(bool allow_half_turns) const {
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      if (!rings_[i].closed) continue;
      const Rotation m = monodromy(state_.field, rings_[i]);
      if (!fixed_.contains(edges_[i]) && m != octahedral::identity) return false;
      const Rotation old = before_[i];
      if (octahedral::is_compound(m) && !octahedral::is_compound(old)) return false;
      if (!allow_half_turns && octahedral::is_axial(m) && is_half_turn(m) && !is_half_turn(old)) return false;
    }
    return true;
  }

  // Sectors without quads at every edge of Z.
  std::vector<int> empty_sectors() const {
    std::vector<int> empty;
    for (std::size_t i = 0; i < edges_.size(); ++i) empty.push_back(num_empty(state_, rings_[i], edges_[i]));
    return empty;
  }

  const std::vector<EdgeKey>& edges() const { return edges_; }

 private:
  static std::array<EdgeKey, 3> edges_of_face(const FaceKey& f) {
    return {edge_key(f[0], f[1]), edge_key(f[0], f[2]), edge_key(f[1], f[2])};
  }

  const EdgeRing& ring(const EdgeKey& e) const {
    return rings_[static_cast<std::size_t>(std::lower_bound(edges_.begin(), edges_.end(), e) - edges_.begin())];
  }

  // Gives the one unknown face at e the matching that makes the monodromy of e the target.
  bool determine(const EdgeKey& e, Rotation target) {
    const EdgeRing& ring = this->ring(e);
    std::size_t place = ring.crossings.size();
    for (std::size_t k = 0; k < ring.crossings.size(); ++k) {
      if (!unknown_.contains(state_.mesh.key(ring.crossings[k]))) continue;
      if (place != ring.crossings.size()) return false;
      place = k;
    }
    if (place == ring.crossings.size() || state_.mesh.is_boundary(ring.crossings[place])) return false;
    Rotation before = octahedral::identity, after = octahedral::identity;
    const std::size_t inner = ring.closed ? ring.crossings.size() : ring.crossings.size() - 1;
    for (std::size_t k = 0; k < place; ++k)
      before = octahedral::product(before, state_.field.matching(ring.crossings[k]));
    for (std::size_t k = place + 1; k < inner; ++k)
      after = octahedral::product(after, state_.field.matching(ring.crossings[k]));
    if (!ring.closed) after = octahedral::product(after, virtual_closure(state_, ring, e[0], e[1]));
    set_matching(
        state_, ring.crossings[place],
        octahedral::product(octahedral::product(octahedral::inverse(before), target), octahedral::inverse(after)));
    const FaceKey face = state_.mesh.key(ring.crossings[place]);
    unknown_.erase(face);
    queue_.push_back(face);
    return true;
  }

  RepairState& state_;
  const ZipPatch& patch_;
  std::set<FaceKey> unknown_;
  std::set<EdgeKey> fixed_;
  std::vector<EdgeKey> edges_;  // of Z, ascending; with their rings and the monodromies at first
  std::vector<EdgeRing> rings_;
  std::vector<Rotation> before_;
  std::vector<FaceKey> queue_;
};

// Codes after a change of the field: of the edges of Z anew; other singular edges keep the sign they have, since
// their monodromy is the same; regular ones are looked at because an index can jump by whole turns.
void update_codes_near(RepairState& state, const FieldSnapshot& before, const std::vector<EdgeKey>& edges_of_z) {
  std::vector<std::pair<EdgeKey, TetId>> changed = edges_with_tets(state.mesh, before.tets());
  std::erase_if(changed, [&](const auto& entry) {
    const EdgeKey& e = entry.first;
    return before.code(e) != 0 && !std::binary_search(edges_of_z.begin(), edges_of_z.end(), e);
  });
  update_codes(state, changed);
}

bool codes_got_worse(const RepairState& state, const FieldSnapshot& before, bool allow_half_turns) {
  const int limit = allow_half_turns ? 2 : 1;
  for (const EdgeKey& e : before.edges()) {
    const EdgeCode now = code_of(state, e);
    const EdgeCode old = before.code(e);
    if (now == old || now == undetermined_code || std::abs(now) <= limit) continue;
    if (old == compound_code || (now != compound_code && std::abs(now) <= std::abs(old))) continue;
    return true;
  }
  return false;
}

}  // namespace

Rotation closed_monodromy(const RepairState& state, const EdgeRing& ring, VertexId a, VertexId b) {
  if (ring.closed) return monodromy(state.field, ring);
  Rotation m = octahedral::identity;
  for (std::size_t k = 0; k + 1 < ring.crossings.size(); ++k)
    m = octahedral::product(m, state.field.matching(ring.crossings[k]));
  return octahedral::product(m, virtual_closure(state, ring, a, b));
}

int empty_sectors(const RepairState& state, const EdgeKey& edge) {
  return num_empty(state, ring_of(state.mesh, edge[0], edge[1]), edge);
}

std::vector<TetId> tets_touching(const TetMesh& mesh, std::span<const FaceKey> faces) {
  std::set<VertexId> vertices;
  for (const FaceKey& f : faces) vertices.insert(f.begin(), f.end());
  std::set<TetId> tets;
  for (VertexId v : vertices)
    for (TetId t : vertex_star(mesh, v)) tets.insert(t);
  return {tets.begin(), tets.end()};
}

bool zip_patch(RepairState& state, const ZipPatch& patch, Rotation target, const ZipOptions& options) {
  const FieldSnapshot before(state, tets_touching(state.mesh, patch.faces));
  Zipping zipping(state, patch);
  const std::vector<int> empty = zipping.empty_sectors();
  if (!zipping.solve(target) || !zipping.admissible(options.allow_half_turns)) {
    before.restore(state);
    return false;
  }
  update_codes_near(state, before, zipping.edges());
  smooth(state, before.tets(), options.sweeps);
  update_codes_near(state, before, zipping.edges());
  bool good = !codes_got_worse(state, before, options.allow_half_turns);
  if (good && !options.allow_zero_sectors) {
    const std::vector<int> now = zipping.empty_sectors();
    for (std::size_t i = 0; good && i < empty.size(); ++i) good = now[i] <= empty[i];
  }
  if (!good) before.restore(state);
  return good;
}

}  // namespace hexfield
