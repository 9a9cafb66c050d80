#include "hexfield/repair/free_ends.hpp"

#include <algorithm>
#include <map>

#include "hexfield/field/edge_codes.hpp"
#include "hexfield/repair/guides.hpp"
#include "hexfield/repair/one_ring.hpp"
#include "hexfield/repair/state_ops.hpp"
#include "hexfield/repair/vertex_repair.hpp"

namespace hexfield {
namespace {

constexpr double straight = -0.7;  // dot of the directions of two edges of a curve that goes on (135 degrees)

struct EdgesAt {
  std::vector<EdgeKey> curve;  // feature edges
  std::vector<EdgeKey> arcs;   // other singular edges
};

// A feature point on a curve that goes on straight is one of a CAD model's seams, not a corner.
bool is_end_on_curve(const RepairState& state, VertexId v, const EdgesAt& edges) {
  if (edges.arcs.size() != 1 || edges.curve.size() != 2) return false;
  if (code_of(state, edges.curve[0]) != code_of(state, edges.curve[1])) return false;
  if (state.features.points.contains(v)) {
    const auto direction = [&](const EdgeKey& e) {
      return (state.mesh.point(other_end(e, v)) - state.mesh.point(v)).normalized();
    };
    if (direction(edges.curve[0]).dot(direction(edges.curve[1])) > straight) return false;
  }
  return ring_of(state.mesh, edges.arcs[0][0], edges.arcs[0][1]).closed;
}

EdgesAt edges_of_end(const RepairState& state, VertexId v) {
  EdgesAt found;
  for (const EdgeKey& e : edges_at(state.mesh, v)) {
    if (state.features.edges.contains(e))
      found.curve.push_back(e);
    else if (state.codes.contains(e))
      found.arcs.push_back(e);
  }
  return found;
}

}  // namespace

bool is_zipper_on_curve(const RepairState& state, VertexId v) {
  const EdgesAt edges = edges_of_end(state, v);
  if (!is_end_on_curve(state, v, edges) || std::abs(code_of(state, edges.arcs[0])) != 1) return false;
  const VertexId to = other_end(edges.arcs[0], v);
  const EdgeRing ring = ring_of(state.mesh, v, to);
  const auto out = outgoing_label(state.mesh, state.field, ring, code_of(state, edges.arcs[0]), v, to);
  if (out == octahedral::no_label) return false;
  for (const FlowPlace& p : flow_star(state, {v, ring.tets.front()}))
    for (int f = 0; f < 4; ++f)
      if (const HalfFaceId h(p.tet, f);
          state.mesh.vertices(p.tet)[static_cast<std::size_t>(f)] != v && is_feature_face(state, h) &&
          closest_label(state.field.frames[p.tet.index()], outward_normal(state.mesh, h)) == label_at(p, out))
        return true;
  return false;
}

std::vector<VertexId> ends_on_curves(const RepairState& state) {
  std::map<VertexId, EdgesAt> at;
  for (const auto& entry : state.features.edges)
    for (VertexId v : entry.first) at[v].curve.push_back(entry.first);
  for (const auto& entry : state.codes)
    if (!state.features.edges.contains(entry.first))
      for (VertexId v : entry.first)
        if (const auto found = at.find(v); found != at.end()) found->second.arcs.push_back(entry.first);
  std::vector<VertexId> ends;
  for (const auto& [v, edges] : at)
    if (is_end_on_curve(state, v, edges)) ends.push_back(v);
  return ends;
}

bool free_arc_end(RepairState& local, VertexId v) {
  RepairState trial = local;
  if (!detach_to_boundary(trial, v, Flow::through)) return false;
  for (VertexId w : vertices_of(trial.mesh, vertex_star(trial.mesh, v)))
    if (needs_repair(trial, w)) return false;
  local = std::move(trial);
  return true;
}

}  // namespace hexfield
