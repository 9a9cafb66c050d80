#include "hexfield/repair/constrained_zippers.hpp"

#include <algorithm>
#include <iterator>
#include <set>

#include "hexfield/field/edge_codes.hpp"
#include "hexfield/repair/one_ring.hpp"
#include "hexfield/repair/state_ops.hpp"

#include "strip_zipping.hpp"

namespace hexfield {
namespace {

using octahedral::Label;

std::optional<Strip> strip_beside(RepairState& state, const GuidedPath& path, VertexId start, bool split_start) {
  for (std::size_t i = 0; i < path.vertices.size(); ++i)
    if (i < path.held || i + path.held_last >= path.vertices.size()) free_spokes(state, path.vertices[i]);
  StripRequest request;
  request.path = path.vertices;
  request.start = start;
  request.split_start = split_start;
  request.held = path.held;
  request.held_last = path.held_last;
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

// Into the domain along the surface sector: against the normal of the face in its middle.
GuidePartner way_into(const RepairState& state, VertexId v, const SurfaceSector& sector) {
  GuidePartner way;
  way.face = middle_face(state.mesh, sector, v);
  way.start = {v, way.face.tet()};
  way.u = octahedral::negate(
      closest_label(state.field.frames[way.face.tet().index()], outward_normal(state.mesh, way.face)));
  return way;
}

Vec3 middle_of(const TetMesh& mesh, VertexId v, const SurfaceSector& sector) {
  Vec3 middle = Vec3::Zero();
  for (VertexId end : {sector.first, sector.last}) middle += (mesh.point(end) - mesh.point(v)).normalized();
  return middle;
}

bool open_sector(RepairState& state, VertexId v, const SurfaceSector& sector, const ZipperOptions& options,
                 std::span<const GuidePartner> partners) {
  const GuidePartner way = way_into(state, v, sector);
  const VertexId inside = split_face(state, way.face);
  const FlowPlace start{v, find_tet_with_edge(state.mesh, v, inside)};
  const auto path = lay_guided_path(state, start, way.u, middle_of(state.mesh, v, sector), options, partners);
  if (!path) return false;
  const auto strip = strip_beside(state, *path, inside, true);
  if (!strip || strip->second.size() < 2) return false;
  const VertexId from = strip->second[0];
  const auto target = code_target(state, from, strip->second[1], find_tet_with_edge(state.mesh, v, from), way.u, -1);
  return target && zip_strip(state, *strip, *target, 1, options);
}

// The guide of a partner, to be walked backwards from where it ends.
struct GuideBack {
  Guide guide;
  FaceKey face;
};

std::vector<GuideBack> guides_back(const RepairState& state, std::span<const GuidePartner> partners) {
  std::vector<GuideBack> guides;
  for (const GuidePartner& p : partners) {
    Guide guide = walk_guide(state, p.start, p.u, Vec3::Zero());
    if (!guide.exit.valid()) guides.push_back({std::move(guide), state.mesh.key(p.face)});
  }
  return guides;
}

// Goals of the free path: the tets where guides end that lead the other way.
UnzipPartners ends_of(const RepairState& state, std::span<const GuideBack> guides,
                      std::span<const GuidePartner> partners) {
  UnzipPartners goals;
  for (const GuideBack& back : guides) {
    const FlowPlace& first = back.guide.places.front();
    const auto p = std::ranges::find(partners, first.vertex, [](const GuidePartner& q) { return q.start.vertex; });
    for (const FlowPlace& q : flow_star(state, back.guide.places.back()))
      goals.emplace(q.tet, UnzipPartner{q.vertex, {}, octahedral::negate(label_at(q, p->u))});
  }
  return goals;
}

// Vertices and wanted sides of the guide that ends at the goal, from there to its node.
struct WayBack {
  std::vector<VertexId> vertices;
  std::vector<Vec3> side;
  FaceKey face;
};

WayBack way_back(const RepairState& state, std::span<const GuideBack> guides, const UnzipPath& path) {
  const auto back =
      std::ranges::find(guides, path.partner->node, [](const GuideBack& g) { return g.guide.places.back().vertex; });
  WayBack way;
  way.face = back->face;
  const auto star = flow_star(state, back->guide.places.back());
  const auto arrival = std::ranges::find(star, path.tets.back(), &FlowPlace::tet);
  const Vec3& last = path.side.empty() ? path.seed.side : path.side.back();
  const Vec3 reference =
      octahedral::apply(arrival->to_start, state.field.frames[arrival->tet.index()].conjugate() * last);
  for (auto place = back->guide.places.rbegin(); place != back->guide.places.rend(); ++place) {
    way.vertices.push_back(place->vertex);
    way.side.push_back(in_space(state, *place, reference));
  }
  return way;
}

}  // namespace

std::optional<GuidedPath> lay_guided_path(RepairState& state, const FlowPlace& start, Label u, const Vec3& side,
                                          const ZipperOptions& options, std::span<const GuidePartner> partners) {
  const Vec3 reference = state.field.frames[start.tet.index()].conjugate() * side;
  const Guide guide = walk_guide(state, start, u, reference);
  const FlowPlace& last = guide.places.back();
  GuidedPath path;
  path.held = guide.places.size();
  for (const FlowPlace& p : guide.places) {
    path.vertices.push_back(p.vertex);
    path.side.push_back(in_space(state, p, reference));
  }
  if (guide.exit.valid()) {
    path.exit = split_face(state, guide.exit);
    return path;
  }
  std::vector<UnzipSeed> seeds;
  for (const FlowPlace& p : flow_star(state, last))
    seeds.push_back({p.tet, label_at(p, u), {}, last.vertex, in_space(state, p, reference)});
  const auto others = guides_back(state, partners);
  const auto beyond = find_unzip_path(state, seeds, ends_of(state, others, partners), {}, {}, options.search);
  if (!beyond) return {};
  std::optional<WayBack> back;
  if (beyond->partner) back = way_back(state, others, *beyond);
  std::optional<Vec3> to;
  if (back) to = state.mesh.point(back->vertices.front());
  const auto inserted = insert_path(state, beyond->faces, state.mesh.point(last.vertex), to);
  path.vertices.insert(path.vertices.end(), inserted.begin(), inserted.end());
  path.side.insert(path.side.end(), beyond->side.begin(), beyond->side.end());
  if (!back) return path;
  path.held_last = back->vertices.size();
  path.vertices.insert(path.vertices.end(), back->vertices.begin(), back->vertices.end());
  path.side.insert(path.side.end(), back->side.begin(), back->side.end());
  path.exit = split_face(state, find_half_face(state.mesh, back->face));
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

bool unzip_sector_transversally(RepairState& state, VertexId v, const ZipperOptions& options,
                                std::span<const VertexId> others) {
  if (!empty_outer_sector(state, v)) return false;
  isolate_star(state, v);
  for (VertexId w : others) isolate_star(state, w);
  const auto sector = empty_outer_sector(state, v);
  if (!sector) return false;
  std::vector<GuidePartner> partners;
  for (VertexId w : others)
    if (const auto other = empty_outer_sector(state, w); other && w != v)
      partners.push_back(way_into(state, w, *other));
  return open_sector(state, v, *sector, options, partners);
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

// A zipper node on a feature curve, or another bad node where curves meet.
bool is_held_node(const RepairState& state, VertexId v) {
  const NodeKind kind = kind_of(state, v);
  return on_boundary(state.mesh, v) && ((kind == NodeKind::zipper && on_feature_edge(state, v)) ||
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

bool repair_zipper_node(RepairState& state, VertexId v, const ZipperOptions& options,
                        std::span<const VertexId> others) {
  if (!is_held_node(state, v)) return false;
  if (empty_outer_sector(state, v) &&
      on_a_copy(state, [&](RepairState& trial) { return unzip_sector_transversally(trial, v, options, others); }))
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
  int repaired = 0;
  for (VertexId v : nodes) {
    std::vector<VertexId> others;
    std::ranges::copy_if(nodes, std::back_inserter(others),
                         [&](VertexId w) { return w != v && is_held_node(state, w) && empty_outer_sector(state, w); });
    repaired += repair_zipper_node(state, v, options, others);
  }
  return repaired;
}

}  // namespace hexfield
