#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "hexfield/field/edge_codes.hpp"
#include "hexfield/field/singularity_graph.hpp"
#include "hexfield/repair/edge_repair.hpp"
#include "hexfield/repair/guides.hpp"
#include "hexfield/repair/neighbourhood_loop.hpp"
#include "hexfield/repair/state_ops.hpp"

#include "extrude.hpp"

/// Arcs that lie in feature surfaces inside the domain though their axis is the normal there: whole arcs go to one
/// side.
namespace hexfield {
namespace {

using octahedral::Rotation;

constexpr int frame_sweeps = 20;

std::vector<Sector> sectors_at(const RepairState& state, const EdgeKey& e) {
  return sectors(state.mesh, state.features, state.field, ring_of(state.mesh, e[0], e[1]), e[0], e[1]);
}

int quads(const std::vector<Sector>& all) {
  int sum = 0;
  for (const Sector& s : all) sum += s.quads;
  return sum;
}

// An edge in a surface that both its sides take for flat, of an arc that therefore cannot run there.
bool crosses_at_an_edge(const RepairState& state, const EdgeKey& e) {
  const EdgeCode code = code_of(state, e);
  if (std::abs(code) != 1 || state.features.edges.contains(e) || state.kept.contains(e)) return false;
  if (!ring_of(state.mesh, e[0], e[1]).closed) return false;
  const auto between = sectors_at(state, e);
  return !between.empty() && quads(between) == 4;
}

// The tets at v that are connected with `seed` through faces at v that are no features.
std::set<TetId> side_of(const RepairState& state, VertexId v, TetId seed) {
  std::set<TetId> side;
  for (const FlowPlace& p : flow_star(state, {v, seed})) side.insert(p.tet);
  return side;
}

// One smooth surface at a vertex inside the domain, seen from one of its sides.
struct Sheet {
  std::set<TetId> side, beyond;
  std::vector<HalfFaceId> faces;  // half-faces of `side`, ascending
};

std::optional<Sheet> sheet_at(const RepairState& state, VertexId v, TetId seed) {
  if (on_feature_curve(state, v) || on_boundary(state.mesh, v)) return {};
  Sheet sheet;
  sheet.side = side_of(state, v, seed);
  for (TetId t : sheet.side)
    for (int f = 0; f < 4; ++f)
      if (const HalfFaceId h(t, f);
          state.mesh.vertices(t)[static_cast<std::size_t>(f)] != v && is_feature_face(state, h))
        sheet.faces.push_back(h);
  if (sheet.faces.empty()) return {};
  sheet.beyond = side_of(state, v, state.mesh.opposite_half_face(sheet.faces.front()).tet());
  if (sheet.side.size() + sheet.beyond.size() != vertex_star(state.mesh, v).size()) return {};
  const bool two_sided = std::ranges::all_of(
      sheet.faces, [&](HalfFaceId h) { return sheet.beyond.contains(state.mesh.opposite_half_face(h).tet()); });
  if (!two_sided || sheet.side.contains(*sheet.beyond.begin())) return {};
  return sheet;
}

// Gives the face (v, cover, end) the matching that makes the edge from the cover to `end` regular.
void make_regular(RepairState& state, VertexId v, VertexId cover, VertexId end) {
  const EdgeRing ring = ring_of(state.mesh, cover, end);
  const FaceKey wall = face_key(v, cover, end);
  Rotation before = octahedral::identity, after = octahedral::identity;
  HalfFaceId unknown;
  for (HalfFaceId h : ring.crossings) {
    if (state.mesh.key(h) == wall) {
      unknown = h;
      continue;
    }
    Rotation& product = unknown.valid() ? after : before;
    product = octahedral::product(product, state.field.matching(h));
  }
  set_matching(state, unknown, octahedral::product(octahedral::inverse(before), octahedral::inverse(after)));
}

std::set<VertexId> rim_of(const TetMesh& mesh, VertexId v, const std::vector<HalfFaceId>& faces) {
  std::set<VertexId> rim;
  for (HalfFaceId h : faces)
    for (VertexId w : mesh.face_vertices(h))
      if (w != v) rim.insert(w);
  return rim;
}

// The surface at the cover is flat on both sides, and at most one arc passes through it.
bool cover_is_sound(const RepairState& state, VertexId v, VertexId cover, const std::set<VertexId>& rim) {
  for (VertexId end : rim) {
    const EdgeKey e = edge_key(cover, end);
    if (code_of(state, e) != 0) return false;
    for (const Sector& s : sectors_at(state, e))
      if (s.quads != 2) return false;
  }
  const EdgeCode through = code_of(state, edge_key(v, cover));
  const std::size_t arcs = singular_edges_at(state, cover).size();
  return arcs == 0 || (arcs == 2 && std::abs(through) == 1);
}

}  // namespace

bool push_off_surface(RepairState& state, VertexId v, TetId side) {
  if (!state.mesh.alive(side) || !state.mesh.has_vertex(side, v)) return false;
  const auto sheet = sheet_at(state, v, side);
  if (!sheet) return false;
  RepairState trial = state;
  const std::vector<TetId> beyond(sheet->beyond.begin(), sheet->beyond.end());
  const VertexId cover = extrude_vertex(trial, v, sheet->faces, beyond);
  if (!move_below(trial, v, sheet->faces)) return false;
  const auto rim = rim_of(trial.mesh, v, sheet->faces);
  for (VertexId end : rim) make_regular(trial, v, cover, end);
  const auto arcs = singular_edges_at(trial, cover);
  std::vector<EdgeKey> changed{edge_key(v, cover)};
  for (VertexId end : rim) changed.push_back(edge_key(cover, end));
  update_codes(trial, changed);
  // An arc that goes on keeps its code.
  if (arcs.size() == 1 && std::abs(code_of(trial, changed[0])) == 1) trial.codes[changed[0]] = code_of(trial, arcs[0]);
  if (!cover_is_sound(trial, v, cover, rim)) return false;
  state = std::move(trial);
  return true;
}

namespace {

// Vertices of one arc that shall leave the surface, each with a tet of it on the side where they go.
struct Lift {
  std::vector<VertexId> vertices;
  std::vector<TetId> sides;
};

bool on_side(const RepairState& state, const std::set<TetId>& side, const EdgeKey& e) {
  return std::ranges::any_of(ring_of(state.mesh, e[0], e[1]).tets, [&](TetId t) { return side.contains(t); });
}

// Arcs that leave v on one of the sides, those in the surface left out.
int arcs_on(const RepairState& state, VertexId v, const std::set<TetId>& side) {
  return static_cast<int>(std::ranges::count_if(singular_edges_at(state, v), [&](const EdgeKey& e) {
    return !in_feature_face(state, e) && on_side(state, side, e);
  }));
}

double volume_of(const TetMesh& mesh, const std::set<TetId>& tets) {
  double sum = 0;
  for (TetId t : tets) sum += signed_volume6(mesh, t);
  return sum;
}

// What speaks for a side: arcs that are there already; then room.
using Votes = std::pair<int, double>;

// The arc through these edges from one of them on, through vertices off the feature curves, and the tets at it on one
// side and on the other.
class Tracing {
 public:
  Tracing(const RepairState& state, const std::map<VertexId, std::vector<EdgeKey>>& at, std::set<EdgeKey>& seen)
      : state_(state), at_(at), seen_(seen) {}

  Lift from(const EdgeKey& seed) {
    const auto walls = sectors_at(state_, seed);
    seen_.insert(seed);
    for (VertexId v : seed) reach(v, walls[0].tets.front(), walls[1].tets.front());
    for (std::size_t i = 0; i < found_.size(); ++i) {
      const VertexId v = found_[i];
      for (const EdgeKey& e : at_.at(v))
        if (seen_.insert(e).second) pass(v, e);
    }
    return better_side();
  }

 private:
  void reach(VertexId v, TetId here, TetId there) {
    if (sides_.contains(v)) return;
    const auto sheet = sheet_at(state_, v, here);
    if (!sheet || !sheet->beyond.contains(there)) return;
    sides_[v] = {here, there};
    found_.push_back(v);
    votes_[0].first += arcs_on(state_, v, sheet->side);
    votes_[1].first += arcs_on(state_, v, sheet->beyond);
    votes_[0].second += volume_of(state_.mesh, sheet->side);
    votes_[1].second += volume_of(state_.mesh, sheet->beyond);
  }

  void pass(VertexId v, const EdgeKey& e) {
    const auto here = side_of(state_, v, sides_.at(v)[0]);
    const auto walls = sectors_at(state_, e);
    const bool turned = !here.contains(walls[0].tets.front());
    reach(other_end(e, v), walls[turned].tets.front(), walls[!turned].tets.front());
  }

  Lift better_side() const {
    const bool there = votes_[1].first != votes_[0].first ? votes_[1].first > votes_[0].first
                                                          : votes_[1].second > votes_[0].second * (1 + 1e-9);
    Lift lift;
    for (VertexId v : found_) {
      lift.vertices.push_back(v);
      lift.sides.push_back(sides_.at(v)[there]);
    }
    return lift;
  }

  const RepairState& state_;
  const std::map<VertexId, std::vector<EdgeKey>>& at_;
  std::set<EdgeKey>& seen_;
  std::map<VertexId, std::array<TetId, 2>> sides_;
  std::vector<VertexId> found_;
  std::array<Votes, 2> votes_{};
};

std::vector<Lift> arcs_to_lift(const RepairState& state) {
  std::map<VertexId, std::vector<EdgeKey>> at;
  std::vector<EdgeKey> edges;
  for (const auto& entry : state.codes) {
    if (!crosses_at_an_edge(state, entry.first) || sectors_at(state, entry.first).size() != 2) continue;
    edges.push_back(entry.first);
    for (VertexId v : entry.first) at[v].push_back(entry.first);
  }
  std::set<EdgeKey> seen;
  std::vector<Lift> lifts;
  for (const EdgeKey& e : edges)
    if (!seen.contains(e))
      if (Lift lift = Tracing(state, at, seen).from(e); !lift.vertices.empty()) lifts.push_back(std::move(lift));
  return lifts;
}

// The tet of the side on which both edges of an arc meet the surface at v without crossing it; invalid elsewhere.
TetId touched_from(const RepairState& state, VertexId v) {
  const auto arcs = singular_edges_at(state, v);
  if (arcs.size() != 2 || on_feature_curve(state, v) || on_boundary(state.mesh, v)) return TetId();
  for (const EdgeKey& e : arcs)
    if (std::abs(code_of(state, e)) != 1 || in_feature_face(state, e)) return TetId();
  const TetId seed = ring_of(state.mesh, arcs[0][0], arcs[0][1]).tets.front();
  const auto sheet = sheet_at(state, v, seed);
  return sheet && on_side(state, sheet->side, arcs[1]) ? seed : TetId();
}

}  // namespace

int lift_arcs_from_surfaces(RepairState& state) {
  std::map<VertexId, TetId> sides;
  for (const Lift& lift : arcs_to_lift(state))
    for (std::size_t i = 0; i < lift.vertices.size(); ++i) sides.emplace(lift.vertices[i], lift.sides[i]);
  for (const auto& entry : state.codes)
    for (VertexId v : entry.first)
      if (const TetId side = touched_from(state, v); side.valid()) sides.emplace(v, side);
  std::vector<Place> places;
  for (const auto& entry : sides) places.push_back({{entry.first}, 0});
  const auto commits = for_places(state, places, [&](Neighbourhood& copy, std::span<const VertexId> seeds) {
    const TetId side = copy.to_local(sides.at(copy.to_parent(seeds[0])));
    return side.valid() && push_off_surface(copy.local, seeds[0], side);
  });
  std::vector<VertexId> pushed;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (commits[i] != 0) pushed.push_back(places[i].seeds[0]);
  smooth(state, tets_around(state.mesh, pushed, 0), frame_sweeps, SingularSign::by_code);
  return static_cast<int>(pushed.size());
}

}  // namespace hexfield
