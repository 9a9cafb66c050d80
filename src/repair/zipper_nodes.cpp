#include "hexfield/repair/zipper_nodes.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>

#include "hexfield/base/parallel.hpp"
#include "hexfield/field/edge_codes.hpp"
#include "hexfield/repair/free_ends.hpp"
#include "hexfield/repair/neighbourhood.hpp"
#include "hexfield/repair/state_ops.hpp"
#include "hexfield/repair/zipping.hpp"

namespace hexfield {
namespace {

constexpr int arc_steps = 3;  // edges of an arc that tell its direction

// Direction in space of the arc that leaves v along `edge`.
Vec3 direction_of_arc(const RepairState& state, VertexId v, const EdgeKey& edge) {
  const VertexId end = along_arc(state, v, edge, arc_steps).back();
  return (state.mesh.point(end) - state.mesh.point(v)).normalized();
}

struct LabelledRing {
  std::vector<TetId> tets;
  std::vector<octahedral::Label> labels;  // along the flow of the arc away from v
};

LabelledRing ring_with_labels(const RepairState& state, VertexId v, const EdgeKey& edge) {
  const VertexId to = other_end(edge, v);
  const EdgeRing ring = ring_of(state.mesh, v, to);
  const auto out = outgoing_label(state.mesh, state.field, ring, code_of(state, edge), v, to);
  if (out == octahedral::no_label) return {};
  return {ring.tets, transport_around(state.field, ring, out)};
}

void mark_arc(RepairState& state, const std::vector<VertexId>& arc, EdgeCode code, int pair) {
  for (std::size_t i = 0; i + 1 < arc.size(); ++i) {
    const EdgeKey e = edge_key(arc[i], arc[i + 1]);
    if (!state.codes.contains(e)) continue;
    state.codes[e] = code;
    state.pairs[e] = pair;
  }
}

// First side and end of the strip to a partner: equal codes meet.
struct PartnerEnds {
  VertexId first;
  VertexId second;
};
PartnerEnds ends_at(const RepairState& state, const UnzipPath& path) {
  const VertexId node = path.partner->node, far = other_end(path.partner->edge, node);
  if (code_of(state, path.partner->edge) == code_of(state, path.seed.edge)) return {node, far};
  return {far, node};
}

bool path_is_regular(const RepairState& state, const std::vector<VertexId>& path) {
  for (std::size_t i = 0; i + 1 < path.size(); ++i)
    if (is_special(state, edge_key(path[i], path[i + 1]))) return false;
  return true;
}

void hold_ends(RepairState& state, const UnzipPath& path, StripRequest& request) {
  if (is_zipper_on_curve(state, path.seed.origin)) request.held = 1;
  if (path.partner && request.path.back() == path.partner->node && is_zipper_on_curve(state, path.partner->node))
    request.held_last = 1;
  if (request.held > 0) free_spokes(state, request.path.front());
  if (request.held_last > 0) free_spokes(state, request.path.back());
}

}  // namespace

std::vector<UnzipSeed> unzip_seeds(const RepairState& state, const FreeZipper& zipper) {
  std::array<Vec3, 2> direction{Vec3::Zero(), Vec3::Zero()};
  for (std::size_t i = 0; i < zipper.edges.size(); ++i)
    direction[i] = direction_of_arc(state, zipper.node, zipper.edges[i]);
  std::vector<UnzipSeed> seeds;
  for (std::size_t i = 0; i < zipper.edges.size(); ++i) {
    const LabelledRing ring = ring_with_labels(state, zipper.node, zipper.edges[i]);
    for (std::size_t k = 0; k < ring.tets.size(); ++k)
      seeds.push_back({ring.tets[k], octahedral::negate(ring.labels[k]), zipper.edges[i], zipper.node,
                       direction[i] - direction[1 - i]});
  }
  return seeds;
}

UnzipPartners unzip_partners(const RepairState& state, std::span<const FreeZipper> zippers) {
  UnzipPartners partners;
  for (const FreeZipper& z : zippers)
    for (const EdgeKey& edge : z.edges) {
      const LabelledRing ring = ring_with_labels(state, z.node, edge);
      for (std::size_t k = 0; k < ring.tets.size(); ++k)
        partners.emplace(ring.tets[k], UnzipPartner{z.node, edge, ring.labels[k]});
    }
  return partners;
}

bool unzip(RepairState& state, const UnzipPath& path, const ZipperOptions& options, Strip* result) {
  const EdgeCode code = code_of(state, path.seed.edge);
  if (!is_free_zipper(state, path.seed.origin) || (path.partner && !is_free_zipper(state, path.partner->node)))
    return false;
  StripRequest request;
  request.start = other_end(path.seed.edge, path.seed.origin);
  std::optional<PartnerEnds> ends;
  std::optional<Vec3> to;
  if (path.partner) {
    ends = ends_at(state, path);
    to = state.mesh.point(ends->first);
  }
  const auto inserted = insert_path(state, path.faces, state.mesh.point(path.seed.origin), to);
  request.path = {path.seed.origin};
  request.path.insert(request.path.end(), inserted.begin(), inserted.end());
  request.side = path.side;
  request.side.insert(request.side.begin(), path.seed.side);
  if (ends) {
    request.path.push_back(ends->first);
    request.side.push_back(request.side.back());
    request.end = ends->second;
  }
  if (!path_is_regular(state, request.path)) return false;
  hold_ends(state, path, request);
  const auto strip = build_strip(state, request);
  if (!strip) return false;
  ZipOptions zip;
  zip.sweeps = 0;
  if (!zip_patch(state, {strip->faces, strip->start, strip->boundary()}, octahedral::identity, zip)) return false;
  const int pair = new_pair(state);
  mark_arc(state, strip->first, -code, pair);
  mark_arc(state, strip->second, code, pair);
  smooth(state, tets_touching(state.mesh, strip->faces), options.sweeps, SingularSign::by_code);
  if (result != nullptr) *result = *strip;
  return true;
}

namespace {

bool untouched(const RepairState& state, const UnzipPath& path, const std::set<VertexId>& consumed) {
  if (path.partner && consumed.contains(path.partner->node)) return false;
  return std::all_of(path.tets.begin(), path.tets.end(), [&](TetId t) { return state.mesh.alive(t); });
}

std::vector<FreeZipper> left_of(const RepairState& state, std::span<const FreeZipper> zippers,
                                const std::set<VertexId>& consumed) {
  std::vector<FreeZipper> left;
  for (const FreeZipper& z : zippers)
    if (!consumed.contains(z.node) && is_free_zipper(state, z.node)) left.push_back(free_zipper_at(state, z.node));
  return left;
}

// The path as the copy has it; it need not know the tets.
UnzipPath path_in(const Neighbourhood& copy, const UnzipPath& path) {
  auto edge = [&](const EdgeKey& e) { return edge_key(copy.to_local(e[0]), copy.to_local(e[1])); };
  UnzipPath local = path;
  local.tets.clear();
  local.seed.tet = copy.to_local(path.seed.tet);
  local.seed.origin = copy.to_local(path.seed.origin);
  local.seed.edge = edge(path.seed.edge);
  for (FaceKey& f : local.faces) f = face_key(copy.to_local(f[0]), copy.to_local(f[1]), copy.to_local(f[2]));
  if (local.partner) {
    local.partner->node = copy.to_local(path.partner->node);
    local.partner->edge = edge(path.partner->edge);
  }
  return local;
}

// unzip() on a copy of the tets along the path: one that fails leaves no splits behind. `blocked` gets the strip.
bool unzip_on_copy(RepairState& state, const UnzipPath& path, const ZipperOptions& options,
                   std::set<FaceKey>& blocked) {
  std::vector<VertexId> places = vertices_of(state.mesh, path.tets);
  places.push_back(path.seed.origin);
  if (path.partner) places.push_back(path.partner->node);
  Neighbourhood copy(state, tets_around(state.mesh, places, 0));
  const int local_pair = new_pair(copy.local), pair = new_pair(state);
  Strip strip;
  if (!unzip(copy.local, path_in(copy, path), options, &strip)) return false;
  for (auto& entry : copy.local.pairs)
    if (entry.second == local_pair) entry.second = pair;
  const auto ids = copy.commit(state);
  for (const FaceKey& f : strip.faces)
    blocked.insert(face_key(ids[f[0].index()], ids[f[1].index()], ids[f[2].index()]));
  return true;
}

// Pairs that lie nearest to each other come first, so that none takes the partner of another; the rest as selected.
std::vector<std::size_t> partners_first(const std::vector<std::optional<UnzipPath>>& paths) {
  std::vector<std::size_t> order(paths.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto rank = [&](std::size_t i) {
    return paths[i] && paths[i]->partner ? paths[i]->distance : std::numeric_limits<double>::infinity();
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  return order;
}

}  // namespace

int unzip_free_zipper_nodes(RepairState& state, const ZipperOptions& options) {
  const auto zippers = select_free_zippers(state, options.selection);
  const UnzipPartners partners = unzip_partners(state, zippers);
  std::set<FaceKey> blocked;
  std::set<VertexId> consumed;
  std::vector<std::optional<UnzipPath>> paths(zippers.size());
  parallel_for(zippers.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      paths[i] = find_unzip_path(state, unzip_seeds(state, zippers[i]), partners, blocked, consumed, options.search);
  });
  int unzipped = 0;
  for (std::size_t i : partners_first(paths)) {
    if (unzipped >= options.cap) break;
    if (consumed.contains(zippers[i].node) || !is_free_zipper(state, zippers[i].node)) continue;
    if (paths[i] && !untouched(state, *paths[i], consumed))
      paths[i] =
          find_unzip_path(state, unzip_seeds(state, free_zipper_at(state, zippers[i].node)),
                          unzip_partners(state, left_of(state, zippers, consumed)), blocked, consumed, options.search);
    // Where there is no way, the next pass sees another field.
    if (!paths[i] || !unzip_on_copy(state, *paths[i], options, blocked)) continue;
    consumed.insert(zippers[i].node);
    if (paths[i]->partner) consumed.insert(paths[i]->partner->node);
    unzipped += paths[i]->partner ? 2 : 1;
  }
  return unzipped;
}

}  // namespace hexfield
