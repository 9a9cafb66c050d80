#include "hexfield/repair/constrained_zippers.hpp"

#include <algorithm>

#include "hexfield/field/edge_codes.hpp"
#include "hexfield/repair/one_ring.hpp"
#include "hexfield/repair/state_ops.hpp"

#include "strip_zipping.hpp"

namespace hexfield {
namespace {

using octahedral::Label;

// In a feature face, or special itself: no spoke for a vertex on a feature.
bool is_held(const RepairState& state, VertexId a, VertexId b) {
  if (is_special(state, edge_key(a, b))) return true;
  const EdgeRing ring = ring_of(state.mesh, a, b);
  return !ring.closed || std::ranges::any_of(ring.crossings, [&](HalfFaceId h) { return is_feature_face(state, h); });
}

// Splits the inner faces at v between two held edges, so that spokes get past everywhere.
void free_spokes(RepairState& state, VertexId v) {
  std::set<FaceKey> narrow;
  for (TetId t : vertex_star(state.mesh, v))
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(t, f);
      if (state.mesh.vertices(t)[static_cast<std::size_t>(f)] == v || is_feature_face(state, h)) continue;
      const auto corners = state.mesh.face_vertices(h);
      if (std::ranges::all_of(corners, [&](VertexId w) { return w == v || is_held(state, v, w); }))
        narrow.insert(state.mesh.key(h));
    }
  for (const FaceKey& face : narrow) split_face(state, find_half_face(state.mesh, face));
}

std::optional<Strip> strip_beside(RepairState& state, const GuidedPath& path, VertexId start, bool split_start) {
  for (std::size_t i = 0; i < path.held; ++i) free_spokes(state, path.vertices[i]);
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
  const Label u =
      octahedral::negate(closest_label(state.field.frames[face.tet().index()], outward_normal(state.mesh, face)));
  Vec3 middle = Vec3::Zero();
  for (VertexId end : {sector.first, sector.last}) middle += (state.mesh.point(end) - state.mesh.point(v)).normalized();
  const VertexId inside = split_face(state, face);
  const FlowPlace start{v, find_tet_with_edge(state.mesh, v, inside)};
  const auto path = lay_guided_path(state, start, u, middle, options);
  if (!path) return false;
  const auto strip = strip_beside(state, *path, inside, true);
  if (!strip || strip->second.size() < 2) return false;
  const VertexId from = strip->second[0];
  const auto target = code_target(state, from, strip->second[1], find_tet_with_edge(state.mesh, v, from), u, -1);
  return target && zip_strip(state, *strip, *target, 1, options);
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

namespace {

// Do other than two feature edges meet at v?
bool is_feature_end(const RepairState& state, VertexId v) {
  const auto curve = std::ranges::count_if(edges_at(state.mesh, v),
                                           [&](const EdgeKey& e) { return state.features.edges.contains(e); });
  return curve != 0 && curve != 2;
}

std::optional<SurfaceSector> empty_outer_sector(RepairState& state, VertexId v) {
  const OneRing ring(state, v);
  for (const SurfaceSector& sector : surface_sectors(state, ring))
    if (sector.quads == 0 && std::ranges::all_of(sector.faces, [&](HalfFaceId h) { return state.mesh.is_boundary(h); }))
      return sector;
  return {};
}

}  // namespace

bool unzip_sector_transversally(RepairState& state, VertexId v, const ZipperOptions& options) {
  if (!empty_outer_sector(state, v)) return false;
  isolate_star(state, v);
  const auto sector = empty_outer_sector(state, v);
  return sector && open_sector(state, v, *sector, options);
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
      if (const HalfFaceId h(p.tet, f);
          is_feature_face(state, h) && state.mesh.vertices(p.tet)[static_cast<std::size_t>(f)] != v)
        inside -= outward_normal(state.mesh, h);
  const auto path = lay_guided_path(state, start, octahedral::negate(out), inside, options);
  if (!path) return false;
  const auto strip = strip_beside(state, *path, end, false);
  return strip && zip_strip(state, *strip, {strip->start, octahedral::identity}, -code, options);
}

namespace {

bool on_feature_curve(const RepairState& state, VertexId v) {
  return std::ranges::any_of(edges_at(state.mesh, v),
                             [&](const EdgeKey& e) { return state.features.edges.contains(e); });
}

// A zipper node on a feature curve, or another bad node where curves meet.
bool is_held_node(const RepairState& state, VertexId v) {
  const NodeKind kind = kind_of(state, v);
  return on_boundary(state.mesh, v) && ((kind == NodeKind::zipper && on_feature_curve(state, v)) ||
                                        (kind == NodeKind::invalid && is_feature_end(state, v)));
}

// Its way may lead anywhere, so all is copied: splits of ways that fail would add up from try to try.
template <class Operation>
bool on_a_copy(RepairState& state, const Operation& operation) {
  if (state.exhausted()) return false;
  RepairState trial = state;
  trial.begin_operation(trial.mesh.num_tets());
  if (!operation(trial)) return false;
  state = std::move(trial);
  return true;
}

bool repair_zipper_node(RepairState& state, VertexId v, const ZipperOptions& options) {
  if (!is_held_node(state, v)) return false;
  if (empty_outer_sector(state, v) &&
      on_a_copy(state, [&](RepairState& trial) { return unzip_sector_transversally(trial, v, options); }))
    return true;
  if (kind_of(state, v) != NodeKind::zipper) return false;
  return std::ranges::any_of(singular_edges_at(state, v), [&](const EdgeKey& edge) {
    return !state.features.edges.contains(edge) &&
           on_a_copy(state, [&](RepairState& trial) { return unzip_along_guide(trial, v, edge, options); });
  });
}

}  // namespace

int repair_constrained_zipper_nodes(RepairState& state, const ZipperOptions& options) {
  std::set<VertexId> nodes;
  for (const auto& [edge, code] : state.codes)
    for (VertexId v : edge)
      if (is_held_node(state, v)) nodes.insert(v);
  return static_cast<int>(
      std::ranges::count_if(nodes, [&](VertexId v) { return repair_zipper_node(state, v, options); }));
}

}  // namespace hexfield
