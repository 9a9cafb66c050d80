#include "hexfield/repair/merge_arcs.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "hexfield/mesh/edit_legality.hpp"
#include "hexfield/repair/neighbourhood_loop.hpp"
#include "hexfield/repair/state_ops.hpp"
#include "hexfield/repair/vertex_repair.hpp"
#include "strip_zipping.hpp"

namespace hexfield {
namespace {

constexpr int arc_steps = 3;             // edges of an arc that tell its direction
constexpr int end_steps = 5;             // edges from the bend to the end on the surface, at most
constexpr double bend_cosine = -0.5;     // of the two directions away from a bend: 60 degrees off straight
constexpr double reach = 2.5;            // target lengths between two arcs that meet
constexpr std::size_t longest_path = 3;  // edges
constexpr int merge_sweeps = 20;

bool is_inner_arc_vertex(const RepairState& state, VertexId v) {
  const auto edges = singular_edges_at(state, v);
  return edges.size() == 2 && code_of(state, edges[0]) == -1 && code_of(state, edges[1]) == -1 &&
         !on_feature_face(state, v);
}

// Cosine between the two directions in which the arc leaves v: -1 where it is straight.
double bend_at(const RepairState& state, VertexId v) {
  const auto edges = singular_edges_at(state, v);
  const auto direction = [&](const EdgeKey& e) {
    return (state.mesh.point(along_arc(state, v, e, arc_steps).back()) - state.mesh.point(v)).normalized();
  };
  return direction(edges[0]).dot(direction(edges[1]));
}

bool ends_on_surface(const RepairState& state, VertexId v) {
  return std::ranges::any_of(singular_edges_at(state, v), [&](const EdgeKey& e) {
    const VertexId end = along_arc(state, v, e, end_steps).back();
    return singular_edges_at(state, end).size() == 1 && on_feature_face(state, end);
  });
}

bool same_arc(const RepairState& state, VertexId v, VertexId w) {
  return std::ranges::any_of(singular_edges_at(state, v), [&](const EdgeKey& e) {
    const auto vertices = along_arc(state, v, e, 4 * end_steps);
    return std::ranges::find(vertices, w) != vertices.end();
  });
}

std::vector<VertexId> inner_arc_vertices(const RepairState& state) {
  std::vector<VertexId> found;
  for (const auto& [edge, code] : state.codes)
    if (code == -1)
      for (VertexId v : edge)
        if (is_inner_arc_vertex(state, v)) found.push_back(v);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

// Bends, the sharpest first, each with the nearest vertex of an arc that ends beside it; one bend per place.
std::vector<Place> crossings(const RepairState& state) {
  const std::vector<VertexId> vertices = inner_arc_vertices(state);
  std::vector<std::pair<double, VertexId>> bends;
  for (VertexId v : vertices)
    if (const double bend = bend_at(state, v); bend > bend_cosine) bends.emplace_back(-bend, v);
  std::sort(bends.begin(), bends.end());
  std::vector<Place> places;
  std::vector<VertexId> seen;
  for (const auto& [bend, q] : bends) {
    std::optional<VertexId> nearest;
    double least = reach * state.target_length[q.index()];
    const auto is_near = [&](VertexId v) { return (state.mesh.point(v) - state.mesh.point(q)).norm() < least; };
    if (std::ranges::any_of(seen, is_near)) continue;
    seen.push_back(q);
    for (VertexId p : vertices) {
      const double distance = (state.mesh.point(p) - state.mesh.point(q)).norm();
      if (distance < least && ends_on_surface(state, p) && !same_arc(state, p, q)) least = distance, nearest = p;
    }
    if (nearest) places.push_back({{*nearest, q}, 2});
  }
  return places;
}

// Vertices from after p to before q along the fewest edges over vertices that nothing holds.
std::optional<std::vector<VertexId>> free_path(const RepairState& state, VertexId p, VertexId q) {
  std::map<VertexId, VertexId> before{{p, p}};
  std::vector<VertexId> reached{p};
  for (std::size_t i = 0; i < reached.size() && !before.contains(q); ++i)
    for (const EdgeKey& e : edges_at(state.mesh, reached[i])) {
      const VertexId next = other_end(e, reached[i]);
      const bool held = !singular_edges_at(state, next).empty() || on_feature_face(state, next);
      if ((next == q || !held) && before.emplace(next, reached[i]).second) reached.push_back(next);
    }
  if (!before.contains(q)) return {};
  std::vector<VertexId> path;
  for (VertexId v = before.at(q); v != p; v = before.at(v)) path.push_back(v);
  if (path.size() + 1 > longest_path) return {};
  return path;  // from q back to p
}

bool contract(RepairState& state, VertexId from, VertexId to) {
  if (!collapse_keeps_topology(state.mesh, state.features, from, to)) return false;
  if (!collapse_keeps_positive(state.mesh, from, to)) return false;
  collapse_edge(state, from, to);
  return true;
}

bool merge(RepairState& state, VertexId p, VertexId q) {
  const auto path = free_path(state, p, q);
  if (!path) return false;
  for (VertexId m : *path)
    if (!contract(state, m, q)) return false;
  if (!contract(state, p, q)) return false;
  update_codes(state, edges_at(state.mesh, q));
  const std::vector<TetId> star = tets_around(state.mesh, std::span(&q, 1), 0);
  smooth(state, star, merge_sweeps, SingularSign::by_code);
  if (kind_of(state, q) != NodeKind::node || needs_repair(state, q)) return false;
  return std::ranges::none_of(vertices_of(state.mesh, star), [&](VertexId v) { return is_defect(state, v); });
}

}  // namespace

bool merge_arcs(RepairState& local, VertexId p, VertexId q) {
  RepairState trial = local;
  if (!merge(trial, p, q)) return false;
  local = std::move(trial);
  return true;
}

int merge_crossing_arcs(RepairState& state) {
  const auto commits = for_places(state, crossings(state), [](Neighbourhood& copy, std::span<const VertexId> seeds) {
    if (!is_inner_arc_vertex(copy.local, seeds[0]) || !is_inner_arc_vertex(copy.local, seeds[1])) return false;
    return merge_arcs(copy.local, seeds[0], seeds[1]);
  });
  return static_cast<int>(std::ranges::count(commits, 1));
}

}  // namespace hexfield
