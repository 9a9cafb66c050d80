#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "hexfield/field/edge_codes.hpp"
#include "hexfield/field/singularity_graph.hpp"
#include "hexfield/mesh/quality.hpp"
#include "hexfield/repair/edge_repair.hpp"
#include "hexfield/repair/neighbourhood_loop.hpp"
#include "hexfield/repair/state_ops.hpp"

#include "extrude.hpp"

namespace hexfield {
namespace {

using octahedral::Label;
using octahedral::Rotation;

// Arcs on edges whose mean dihedral angle is farther from flat are at home there: one quad fits a right angle.
constexpr double smooth_angle = M_PI / 4;

bool is_boundary_edge(const RepairState& state, const EdgeKey& e) { return !ring_of(state.mesh, e[0], e[1]).closed; }

Label normal_label(const RepairState& state, HalfFaceId h) {
  return closest_label(state.field.frames[h.tet().index()], outward_normal(state.mesh, h));
}

// Matching across a boundary edge through the outside, from the last tet of its ring to the first.
struct Closure {
  VertexId end;
  HalfFaceId first, last;  // boundary half-faces
  Rotation matching;
};

// Where the surface is flat it takes the normal to the normal and undoes the turning inside; an arc of one or three
// quads gets the quarter-turn that takes one normal to the other. Nothing for other codes.
std::optional<Closure> closure_at(const RepairState& state, VertexId v, VertexId end) {
  const EdgeRing ring = ring_of(state.mesh, v, end);
  const EdgeCode code = code_of(state, edge_key(v, end));
  Rotation inside = octahedral::identity;
  for (std::size_t k = 0; k + 1 < ring.crossings.size(); ++k)
    inside = octahedral::product(inside, state.field.matching(ring.crossings[k]));
  const Label first = normal_label(state, ring.first_boundary);
  const Label last = octahedral::image(inside, normal_label(state, ring.crossings.back()));  // in the first chart
  for (Rotation turn = 0; octahedral::is_axial(turn); ++turn) {
    const bool quarter = octahedral::product(turn, turn) != octahedral::identity;
    if (code == 0 ? turn != octahedral::identity : !quarter || std::abs(code) != 1) continue;
    if (octahedral::image(turn, first) == last)
      return Closure{end, ring.first_boundary, ring.crossings.back(),
                     octahedral::product(octahedral::inverse(inside), turn)};
  }
  return {};
}

std::vector<Closure> closures_around(const RepairState& state, VertexId v) {
  std::vector<Closure> closures;
  for (const EdgeKey& e : edges_at(state.mesh, v)) {
    if (!is_boundary_edge(state, e)) continue;
    const auto closure = closure_at(state, v, other_end(e, v));
    if (!closure) return {};
    closures.push_back(*closure);
  }
  return closures;
}

// Monodromy of the edge from v to its cover: the closures one after the other.
Rotation turn_around(const std::vector<Closure>& closures) {
  Rotation turn = octahedral::identity;
  HalfFaceId at = closures.front().last;
  for (std::size_t steps = 0; steps < closures.size(); ++steps) {
    const auto next = std::ranges::find(closures, at, &Closure::last);
    if (next == closures.end()) return octahedral::order;
    turn = octahedral::product(turn, next->matching);
    at = next->first;
  }
  return at == closures.front().last ? turn : octahedral::order;
}

bool may_be_pushed(const RepairState& state, VertexId v) {
  if (!on_boundary(state.mesh, v) || on_feature_curve(state, v)) return false;
  for (const EdgeKey& e : edges_at(state.mesh, v))
    if (state.kept.contains(e)) return false;
  for (TetId t : vertex_star(state.mesh, v))
    for (int f = 0; f < 4; ++f)
      if (const HalfFaceId h(t, f); state.mesh.vertices(t)[static_cast<std::size_t>(f)] != v &&
                                    !state.mesh.is_boundary(h) && state.features.faces.contains(state.mesh.key(h)))
        return false;
  return true;
}

// The tet on a covered face.
TetId cover_tet(const TetMesh& mesh, HalfFaceId covered) { return mesh.opposite_half_face(covered).tet(); }

void set_closure(RepairState& state, VertexId v, VertexId cover, const Closure& closure) {
  HalfFaceId h = find_half_face(state.mesh, face_key(v, cover, closure.end));
  if (h.tet() != cover_tet(state.mesh, closure.last)) h = state.mesh.opposite_half_face(h);
  set_matching(state, h, closure.matching);
}

}  // namespace

bool push_inside(RepairState& state, VertexId v) {
  if (!may_be_pushed(state, v)) return false;
  const std::vector<Closure> closures = closures_around(state, v);
  if (closures.size() < 3) return false;
  const Rotation turn = turn_around(closures);
  if (turn == octahedral::order || octahedral::is_compound(turn)) return false;
  RepairState trial = state;
  const std::vector<HalfFaceId> covered = boundary_faces_at(trial.mesh, v);
  const VertexId cover = extrude_vertex(trial, v, covered);
  if (!move_below(trial, v, covered)) return false;
  for (const Closure& closure : closures) set_closure(trial, v, cover, closure);
  update_codes(trial, edges_at(trial.mesh, cover));
  const auto at_cover = singular_edges_at(trial, cover);
  if (at_cover.size() > 1 || (at_cover.size() == 1 && other_end(at_cover[0], cover) != v)) return false;
  state = std::move(trial);
  return true;
}

namespace {

// Non-feature singular edges on the boundary that may be pushed inside with their arc.
std::vector<EdgeKey> surface_arcs(const RepairState& state) {
  std::vector<EdgeKey> edges;
  for (const auto& [edge, code] : state.codes)
    if (std::abs(code) == 1 && !state.features.edges.contains(edge) && !state.kept.contains(edge) &&
        is_boundary_edge(state, edge))
      edges.push_back(edge);
  return edges;
}

// Groups of edges connected through vertices off the feature curves, each ascending.
std::vector<std::vector<EdgeKey>> connected(const RepairState& state, const std::vector<EdgeKey>& edges) {
  std::map<VertexId, std::vector<EdgeKey>> at;
  for (const EdgeKey& e : edges)
    for (VertexId v : e)
      if (!on_feature_curve(state, v)) at[v].push_back(e);
  std::set<EdgeKey> seen;
  std::vector<std::vector<EdgeKey>> groups;
  for (const EdgeKey& seed : edges) {
    if (!seen.insert(seed).second) continue;
    std::vector<EdgeKey> group{seed};
    for (std::size_t i = 0; i < group.size(); ++i)
      for (VertexId v : EdgeKey(group[i]))
        if (const auto here = at.find(v); here != at.end())
          for (const EdgeKey& e : here->second)
            if (seen.insert(e).second) group.push_back(e);
    std::sort(group.begin(), group.end());
    groups.push_back(std::move(group));
  }
  return groups;
}

// Does the surface bend less along the arc than its code says?
bool runs_along_smooth_surface(const RepairState& state, const std::vector<EdgeKey>& arc) {
  double bend = 0, length = 0;
  for (const EdgeKey& e : arc) {
    double angle = 0;
    for (TetId t : ring_of(state.mesh, e[0], e[1]).tets) angle += dihedral_angle(state.mesh, t, e[0], e[1]);
    const double size = (state.mesh.point(e[0]) - state.mesh.point(e[1])).norm();
    bend += size * std::abs(angle - M_PI);
    length += size;
  }
  return bend < smooth_angle * length;
}

// Arcs inside that touch the surface at v, or end there along it.
bool touches_from_inside(const RepairState& state, VertexId v) {
  const auto edges = singular_edges_at(state, v);
  if (edges.empty() || !on_boundary(state.mesh, v) || on_feature_curve(state, v)) return false;
  for (const EdgeKey& e : edges)
    if (std::abs(code_of(state, e)) != 1 || is_boundary_edge(state, e)) return false;
  return classify_vertex(state.mesh, state.features, state.field, state.codes, v, edges).kind == NodeKind::invalid;
}

}  // namespace

int push_arcs_inside(RepairState& state) {
  std::set<VertexId> vertices;
  for (const auto& arc : connected(state, surface_arcs(state))) {
    if (!runs_along_smooth_surface(state, arc)) continue;
    for (const EdgeKey& e : arc) {
      const bool held = on_feature_curve(state, e[0]) && on_feature_curve(state, e[1]);
      if (held)
        vertices.insert(split_edge(state, e[0], e[1]));
      else
        vertices.insert(e.begin(), e.end());
    }
  }
  for (const auto& entry : state.codes)
    for (VertexId v : entry.first)
      if (touches_from_inside(state, v)) vertices.insert(v);
  std::vector<Place> places;
  for (VertexId v : vertices) places.push_back({{v}, 0});
  const auto commits = for_places(state, places, [](Neighbourhood& copy, std::span<const VertexId> seeds) {
    return push_inside(copy.local, seeds[0]);
  });
  // Frames follow when the arcs are where they stay: half-way they would turn to edges that are still on the surface.
  std::vector<VertexId> pushed;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (commits[i] != 0) pushed.push_back(places[i].seeds[0]);
  smooth(state, tets_around(state.mesh, pushed, 0), 20, SingularSign::by_code);
  return static_cast<int>(pushed.size());
}

}  // namespace hexfield
