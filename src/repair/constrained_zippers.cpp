#include "hexfield/repair/constrained_zippers.hpp"

#include <algorithm>

#include "hexfield/field/edge_codes.hpp"
#include "hexfield/field/singularity_graph.hpp"
#include "hexfield/repair/field_snapshot.hpp"
#include "hexfield/repair/one_ring.hpp"
#include "hexfield/repair/state_ops.hpp"
#include "hexfield/repair/zipping.hpp"

namespace hexfield {
namespace {

using octahedral::Label;

VertexId other_end(const EdgeKey& edge, VertexId v) { return edge[0] == v ? edge[1] : edge[0]; }

bool is_defect(const RepairState& state, VertexId v) {
  const auto edges = singular_edges_at(state, v);
  if (edges.empty()) return false;
  const NodeKind kind = classify_vertex(state.mesh, state.features, state.field, state.codes, v, edges).kind;
  return kind != NodeKind::arc && kind != NodeKind::node;
}

long num_defects(const RepairState& state, const Strip& strip) {
  std::set<VertexId> vertices(strip.first.begin(), strip.first.end());
  vertices.insert(strip.second.begin(), strip.second.end());
  return std::ranges::count_if(vertices, [&](VertexId v) { return is_defect(state, v); });
}

// Inner edges of one side of a strip: their sign is known, and they repel those of the other side.
void mark_side(RepairState& state, const std::vector<VertexId>& side, EdgeCode code, int pair) {
  for (std::size_t i = 0; i + 1 < side.size(); ++i) {
    const EdgeKey e = edge_key(side[i], side[i + 1]);
    if (!state.codes.contains(e)) continue;
    if (state.features.edges.contains(e) || !ring_of(state.mesh, e[0], e[1]).closed) {
      state.kept.insert(e);
      continue;
    }
    state.codes[e] = code;
    state.pairs[e] = pair;
  }
}

int new_pair(const RepairState& state) {
  int pair = 0;
  for (const auto& [edge, id] : state.pairs) pair = std::max(pair, id + 1);
  return pair;
}

// Zips and keeps the result if there are fewer defects than before.
bool zip_strip(RepairState& state, const Strip& strip, const EdgeKey& start, octahedral::Rotation target,
               EdgeCode first_code, const ZipperOptions& options) {
  const long before = num_defects(state, strip);
  const FieldSnapshot snapshot(state, tets_touching(state.mesh, strip.faces));
  ZipOptions zip;
  zip.sweeps = 0;
  if (!zip_patch(state, {strip.faces, start, strip.boundary()}, target, zip)) return false;
  const int pair = new_pair(state);
  mark_side(state, strip.first, first_code, pair);
  mark_side(state, strip.second, -first_code, pair);
  smooth(state, tets_touching(state.mesh, strip.faces), options.sweeps, SingularSign::by_code);
  if (num_defects(state, strip) < before) return true;
  snapshot.restore(state);
  return false;
}

std::optional<Strip> strip_beside(RepairState& state, const GuidedPath& path, VertexId start, bool split_start) {
  StripRequest request;
  request.path = path.vertices;
  request.start = start;
  request.split_start = split_start;
  request.held = path.held;
  request.side = path.side;
  if (path.exit.valid()) request.exits = {path.exit};
  return build_strip(state, request);
}

HalfFaceId middle_face(const TetMesh& mesh, const SurfaceSector& sector, VertexId v) {
  double angle = 0;
  for (HalfFaceId h : sector.faces) {
    std::vector<Vec3> arms;
    for (VertexId w : mesh.face_vertices(h))
      if (w != v) arms.push_back((mesh.point(w) - mesh.point(v)).normalized());
    angle += std::acos(std::clamp(arms[0].dot(arms[1]), -1.0, 1.0));
    if (angle >= sector.angle / 2) return h;
  }
  return sector.faces.back();
}

bool open_sector(RepairState& state, VertexId v, const SurfaceSector& sector, const ZipperOptions& options) {
  const HalfFaceId face = middle_face(state.mesh, sector, v);
  const Label u = octahedral::negate(
      closest_label(state.field.frames[face.tet().index()], outward_normal(state.mesh, face)));
  Vec3 middle = Vec3::Zero();
  for (VertexId end : {sector.first, sector.last}) middle += (state.mesh.point(end) - state.mesh.point(v)).normalized();
  const VertexId inside = split_face(state, face);
  const FlowPlace start{v, find_tet_with_edge(state.mesh, v, inside)};
  const auto path = lay_guided_path(state, start, u, middle, options);
  if (!path) return false;
  const auto strip = strip_beside(state, *path, inside, true);
  if (!strip || strip->second.size() < 2) return false;
  // The first edge of the second side gets the code -1 along u.
  const VertexId from = strip->second[0];
  const EdgeKey e = edge_key(from, strip->second[1]);
  const TetId first = ring_of(state.mesh, e[0], e[1]).tets.front();
  const auto star = flow_star(state, {from, find_tet_with_edge(state.mesh, v, from)});
  const auto place = std::ranges::find(star, first, &FlowPlace::tet);
  if (place == star.end()) return false;
  const Label along = e[0] == from ? label_at(*place, u) : octahedral::negate(label_at(*place, u));
  return zip_strip(state, *strip, e, octahedral::quarter_turn(octahedral::negate(along)), 1, options);
}

}  // namespace

std::optional<GuidedPath> lay_guided_path(RepairState& state, const FlowPlace& start, Label u, const Vec3& side,
                                          const ZipperOptions& options) {
  const Vec3 reference = state.field.frames[start.tet.index()].conjugate() * side;
  const Guide guide = walk_guide(state, start, u, reference);
  const FlowPlace& last = guide.places.back();
  std::optional<UnzipPath> beyond;
  if (!guide.exit.valid()) {
    std::vector<UnzipSeed> seeds;
    for (const FlowPlace& p : flow_star(state, last))
      seeds.push_back({p.tet, label_at(p, u), {}, last.vertex, in_space(state, p, reference)});
    beyond = find_unzip_path(state, seeds, {}, {}, {}, options.search);
    if (!beyond) return {};
  }
  GuidedPath path;
  path.held = guide.places.size();
  for (const FlowPlace& p : guide.places) {
    path.vertices.push_back(p.vertex);
    path.side.push_back(in_space(state, p, reference));
  }
  if (beyond) {
    const auto inserted = insert_path(state, beyond->faces, state.mesh.point(last.vertex));
    path.vertices.insert(path.vertices.end(), inserted.begin(), inserted.end());
    path.side.insert(path.side.end(), beyond->side.begin(), beyond->side.end());
  } else {
    path.exit = split_face(state, guide.exit);
  }
  return path;
}

bool unzip_sector_transversally(RepairState& state, VertexId v, const ZipperOptions& options) {
  isolate_star(state, v);
  const OneRing ring(state, v);
  for (const SurfaceSector& sector : surface_sectors(state, ring)) {
    const bool outside = std::ranges::all_of(sector.faces, [&](HalfFaceId h) { return state.mesh.is_boundary(h); });
    if (outside && sector.quads == 0 && open_sector(state, v, sector, options)) return true;
    if (outside && sector.quads == 0) return false;  // the mesh has changed
  }
  return false;
}

bool unzip_along_guide(RepairState& state, VertexId v, const EdgeKey& edge, const ZipperOptions& options) {
  const EdgeCode code = code_of(state, edge);
  const VertexId end = other_end(edge, v);
  const EdgeRing ring = ring_of(state.mesh, v, end);
  if (std::abs(code) != 1 || !ring.closed) return false;
  const Label out = outgoing_label(state.mesh, state.field, ring, code, v, end);
  if (out == octahedral::no_label) return false;
  const FlowPlace start{v, ring.tets.front()};
  Vec3 inside = Vec3::Zero();
  for (const FlowPlace& p : flow_star(state, start))
    for (int f = 0; f < 4; ++f)
      if (const HalfFaceId h(p.tet, f); is_feature_face(state, h) &&
                                        state.mesh.vertices(p.tet)[static_cast<std::size_t>(f)] != v)
        inside -= outward_normal(state.mesh, h);
  const auto path = lay_guided_path(state, start, octahedral::negate(out), inside, options);
  if (!path) return false;
  const auto strip = strip_beside(state, *path, end, false);
  return strip && zip_strip(state, *strip, strip->start, octahedral::identity, -code, options);
}

int repair_constrained_zipper_nodes(RepairState& state, const ZipperOptions& options) {
  std::set<VertexId> nodes;
  for (const auto& [edge, code] : state.codes)
    for (VertexId v : edge)
      if (on_boundary(state.mesh, v) && is_defect(state, v) && !is_free_zipper(state, v)) nodes.insert(v);
  int repaired = 0;
  for (VertexId v : nodes) {
    if (!is_defect(state, v)) continue;
    bool done = unzip_sector_transversally(state, v, options);
    for (const EdgeKey& edge : singular_edges_at(state, v))
      if (!done && !state.features.edges.contains(edge)) done = unzip_along_guide(state, v, edge, options);
    repaired += done ? 1 : 0;
  }
  return repaired;
}

}  // namespace hexfield
