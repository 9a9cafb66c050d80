#include <algorithm>

#include "hexfield/field/edge_codes.hpp"
#include "hexfield/repair/field_snapshot.hpp"
#include "hexfield/repair/one_ring.hpp"
#include "hexfield/repair/state_ops.hpp"
#include "hexfield/repair/vertex_repair.hpp"
#include "hexfield/repair/zipping.hpp"

/// DT5, transversal arc unzipping.
namespace hexfield {
namespace {

using octahedral::Label;

bool is_blocked(const OneRing& ring, const SurfaceSector& s) {
  if (s.quads > 0) return false;
  const Spoke *a = ring.spoke(s.first), *b = ring.spoke(s.last);
  return a->feature || b->feature;
}

// A regular spoke in the middle of the sector, whose end is on no special edge; made by splits where needed.
VertexId middle_spoke(RepairState& state, VertexId v, const SurfaceSector& sector) {
  const HalfFaceId h = sector.faces[sector.faces.size() / 2];
  std::vector<VertexId> shared;
  for (VertexId w : state.mesh.face_vertices(h))
    if (w != v) shared.push_back(w);
  if (sector.faces.size() >= 2) {
    const FaceKey before = state.mesh.key(sector.faces[sector.faces.size() / 2 - 1]);
    std::erase_if(shared, [&](VertexId w) { return std::find(before.begin(), before.end(), w) == before.end(); });
  }
  if (shared.size() == 2) return split_edge(state, shared[0], shared[1]);
  const VertexId end = shared.front();
  const auto edges = edges_at(state.mesh, end);
  const bool special = std::any_of(edges.begin(), edges.end(), [&](const EdgeKey& e) { return is_special(state, e); });
  return special ? split_edge(state, v, end) : end;
}

// One inner face at the spoke v -> end on the side of a sector, and the label of the surface normal in the chart of
// the tet before it.
struct Cut {
  HalfFaceId face;
  Label normal = octahedral::no_label;
};

Cut plain_cut(const RepairState& state, VertexId v, VertexId end, const Sector& s) {
  Cut best;
  Label normal = closest_label(state.field.frames[s.tets[0].index()], outward_normal(state.mesh, s.first));
  std::size_t distance = s.crossings.size() + 1;
  for (std::size_t k = 0; k < s.crossings.size(); ++k) {
    const HalfFaceId h = s.crossings[k];
    VertexId apex;
    for (VertexId w : state.mesh.face_vertices(h))
      if (w != v && w != end) apex = w;
    const bool plain = !is_special(state, edge_key(v, apex)) && !is_special(state, edge_key(end, apex));
    const std::size_t from_middle = std::max(2 * k + 1, s.crossings.size()) - std::min(2 * k + 1, s.crossings.size());
    if (plain && !on_boundary(state.mesh, apex) && from_middle < distance) best = {h, normal}, distance = from_middle;
    normal = transport(state.field, h, normal);
  }
  return best;
}

VertexId apex_of(const RepairState& state, VertexId v, VertexId end, const Cut& cut) {
  for (VertexId w : state.mesh.face_vertices(cut.face))
    if (w != v && w != end) return w;
  return VertexId();
}

// The new arc leaves v with one quad more and the surface with one less; its two edges run across the flow, so that
// geometry cannot tell.
void set_codes(RepairState& state, VertexId v, VertexId end, const std::vector<Cut>& cuts) {
  for (const Cut& c : cuts) {
    const VertexId apex = apex_of(state, v, end, c);
    state.codes[edge_key(v, apex)] = 1;
    state.codes[edge_key(apex, end)] = -1;
  }
}

// Splits the widest tet of every sector that has no plain face at the spoke.
std::vector<Cut> cuts_of(RepairState& state, VertexId v, VertexId end) {
  auto all = [&] { return sectors(state.mesh, state.features, state.field, ring_of(state.mesh, v, end), v, end); };
  for (const Sector& s : all()) {
    if (plain_cut(state, v, end, s).face.valid()) continue;
    TetId widest = s.tets.front();
    for (TetId t : s.tets)
      if (dihedral_angle(state.mesh, t, v, end) > dihedral_angle(state.mesh, widest, v, end) + 1e-12) widest = t;
    split_tet(state, widest);
  }
  std::vector<Cut> cuts;
  for (const Sector& s : all()) cuts.push_back(plain_cut(state, v, end, s));
  return cuts;
}

// Quarter-turn about the normal across one face.
bool turn_across(RepairState& state, VertexId v, VertexId end, const Cut& cut, bool reverse) {
  const VertexId apex = apex_of(state, v, end, cut);
  ZipPatch patch;
  patch.faces = {state.mesh.key(cut.face)};
  patch.start = edge_key(v, apex);
  patch.boundary = {patch.start, edge_key(end, apex), edge_key(v, end)};
  const EdgeRing ring = ring_of(state.mesh, patch.start[0], patch.start[1]);
  // The label comes from the tet before the face to the first tet of the ring of v - apex without crossing it.
  Label label = cut.normal;
  const auto at =
      static_cast<std::size_t>(std::find(ring.tets.begin(), ring.tets.end(), cut.face.tet()) - ring.tets.begin());
  if (at == ring.tets.size()) return false;
  if (ring.crossings[at] == cut.face) {
    for (std::size_t k = at; k > 0; --k) label = octahedral::image(state.field.matching(ring.crossings[k - 1]), label);
  } else {
    for (std::size_t k = at; k < ring.tets.size(); ++k) label = transport(state.field, ring.crossings[k], label);
  }
  return zip_patch(state, patch, octahedral::quarter_turn(reverse ? octahedral::negate(label) : label));
}

int blocked_sectors(RepairState& state, VertexId v) {
  const OneRing ring(state, v);
  int n = 0;
  for (const SurfaceSector& s : surface_sectors(state, ring)) n += is_blocked(ring, s);
  return n;
}

bool open_sector(RepairState& state, VertexId v, const SurfaceSector& sector, const RingScope& scope) {
  const VertexId end = middle_spoke(state, v, sector);
  isolate_star(state, v);
  const int before = blocked_sectors(state, v);
  const std::vector<Cut> cuts = cuts_of(state, v, end);
  if (std::ranges::any_of(cuts, [](const Cut& c) { return !c.face.valid(); })) return false;
  std::vector<FaceKey> faces;
  for (const Cut& c : cuts) faces.push_back(state.mesh.key(c.face));
  const FieldSnapshot snapshot(state, tets_touching(state.mesh, faces));
  for (unsigned signs = 0; signs < (1U << cuts.size()); ++signs) {
    bool good = true;
    for (std::size_t i = 0; good && i < cuts.size(); ++i)
      good = turn_across(state, v, end, cuts[i], ((signs >> i) & 1U) != 0);
    good = good && code_of(state, edge_key(v, end)) == 0 && empty_sectors(state, edge_key(v, end)) == 0;
    good = good && blocked_sectors(state, v) < before;
    if (good) set_codes(state, v, end, cuts);
    if (good && (!scope.accept || scope.accept(state))) return true;
    snapshot.restore(state);
  }
  return false;
}

}  // namespace

bool unzip_transversally(RepairState& state, VertexId v, const RingScope& scope) {
  isolate_star(state, v);
  for (std::size_t i = 0;; ++i) {
    const OneRing ring(state, v);
    std::vector<SurfaceSector> blocked;
    for (SurfaceSector& s : surface_sectors(state, ring))
      if (is_blocked(ring, s)) blocked.push_back(std::move(s));
    if (i >= blocked.size()) return false;
    if (open_sector(state, v, blocked[i], scope)) return true;
  }
}

}  // namespace hexfield
