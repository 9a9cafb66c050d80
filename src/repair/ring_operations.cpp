#include <algorithm>
#include <cmath>

#include "hexfield/field/edge_codes.hpp"
#include "hexfield/repair/field_snapshot.hpp"
#include "hexfield/repair/ring_patch.hpp"
#include "hexfield/repair/state_ops.hpp"
#include "hexfield/repair/vertex_repair.hpp"

namespace hexfield {
namespace {

// Feature edges lose their arc only where several curves meet: on a curve it would come back at the next vertex.
bool may_start(const OneRing& ring, const Spoke& s, const RingScope& scope) {
  if (std::abs(s.code) != 1 || s.labels.empty()) return false;
  if (s.feature) return scope.from_features && std::ranges::count_if(ring.spokes(), &Spoke::feature) > 2;
  return s.free_arc() || scope.from_surface;
}

// How well the field follows a spoke: mean cosine of its label.
double alignment(const TetMesh& mesh, const OneRing& ring, const Spoke& s) {
  const Vec3 e = (mesh.point(s.end) - mesh.point(ring.centre())).normalized();
  double sum = 0;
  for (std::size_t k = 0; k < s.tets.size(); ++k) sum += ring.axis(s.tets[k], s.labels[k]).dot(e);
  return sum / static_cast<double>(s.tets.size());
}

// Starts of DT1: pairs of equal codes in one region, the straightest first, each with its better aligned edge; then
// the odd ones.
std::vector<VertexId> starts_by_pairs(const RepairState& state, const OneRing& ring, const RingScope& scope) {
  std::vector<const Spoke*> left;
  for (const Spoke& s : ring.spokes())
    if (may_start(ring, s, scope)) left.push_back(&s);
  auto direction = [&](const Spoke& s) {
    return Vec3((state.mesh.point(s.end) - state.mesh.point(ring.centre())).normalized());
  };
  std::vector<VertexId> order;
  for (;;) {
    const Spoke *first = nullptr, *second = nullptr;
    double best = 2;
    for (std::size_t i = 0; i < left.size(); ++i)
      for (std::size_t j = i + 1; j < left.size(); ++j) {
        if (left[i]->code != left[j]->code) continue;
        if (ring.region(left[i]->tets.front()) != ring.region(left[j]->tets.front())) continue;
        const double cosine = direction(*left[i]).dot(direction(*left[j]));
        if (cosine < best - 1e-12) first = left[i], second = left[j], best = cosine;
      }
    if (first == nullptr) break;
    if (alignment(state.mesh, ring, *second) > alignment(state.mesh, ring, *first) + 1e-12) std::swap(first, second);
    for (const Spoke* s : {first, second}) {
      order.push_back(s->end);
      std::erase(left, s);
    }
  }
  for (const Spoke* s : left) order.push_back(s->end);
  return order;
}

std::vector<VertexId> starts_by_index(const OneRing& ring, const RingScope& scope) {
  std::vector<VertexId> order;
  for (const Spoke& s : ring.spokes())
    if (may_start(ring, s, scope)) order.push_back(s.end);
  return order;
}

// Targets in feature faces may get regular only where their sectors stay what the surface needs: two quads on a
// smooth surface, one on a convex, two on a concave feature edge (spec-lmff section 5.3).
bool surface_edge_is_sound(const RepairState& state, VertexId v, VertexId end) {
  const EdgeKey e = edge_key(v, end);
  const bool feature = state.features.edges.contains(e);
  const EdgeRing ring = ring_of(state.mesh, e[0], e[1]);
  for (const Sector& s : sectors(state.mesh, state.features, state.field, ring, e[0], e[1])) {
    if (s.quads == undetermined_code) return false;
    if (!feature && s.quads != 2) return false;
    if (feature && s.quads < (s.dihedral > 1.25 * M_PI ? 2 : 1)) return false;
  }
  return true;
}

// The chain carries the arc of the start away from the vertex, so its code and direction are known and small steps
// against the flow do not matter. In a parabolic sector it turns round at one inner vertex, a zipper node: the one
// that leaves most edges along the flow.
void set_chain_codes(RepairState& state, const std::vector<VertexId>& chain, EdgeCode code, Flow flow) {
  std::vector<EdgeKey> edges;
  std::vector<double> gain{0};  // of the edges before a vertex when they keep the code
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    edges.push_back(edge_key(chain[i], chain[i + 1]));
    const EdgeCode now = code_of(state, edges.back());
    if (std::abs(now) != 1 && now != undetermined_code) return;
    const double length = (state.mesh.point(chain[i + 1]) - state.mesh.point(chain[i])).norm();
    gain.push_back(gain.back() + (now == code ? length : now == -code ? -length : 0));
  }
  std::size_t turn = edges.size();
  if (flow == Flow::parallel) {
    turn = 1;
    for (std::size_t i = 2; i + 1 < chain.size(); ++i)
      if (gain[i] > gain[turn] + 1e-9) turn = i;
  }
  for (std::size_t i = 0; i < edges.size(); ++i) state.codes[edges[i]] = i < turn ? code : -code;
}

// Unzips the start of one path; undone when something got worse (the revert rules of spec-lmff section 5.3).
// `known`: the parabolic sectors at v before.
bool zip_along(RepairState& state, VertexId v, const RingPath& path, const RingQuery& query, const RingScope& scope,
               const std::vector<ParabolicSector>& known) {
  const auto fan = ring_patch(state, v, path, query.flow);
  if (!fan) return false;
  const auto novel = [&](const ParabolicSector& p) { return !std::binary_search(known.begin(), known.end(), p); };
  const FieldSnapshot snapshot(state, tets_touching(state.mesh, fan->patch.faces));
  const EdgeCode code = code_of(state, fan->patch.start);
  if (!zip_patch(state, fan->patch, octahedral::identity)) return false;
  set_chain_codes(state, fan->chain, code, query.flow);
  const bool from_feature = state.features.edges.contains(fan->patch.start);
  bool good = from_feature ? surface_edge_is_sound(state, v, path.from) : code_of(state, fan->patch.start) == 0;
  if (path.to.valid()) {
    const EdgeKey e = edge_key(v, path.to);
    const EdgeRing ring = ring_of(state.mesh, e[0], e[1]);
    const bool in_surface = !sectors(state.mesh, state.features, state.field, ring, e[0], e[1]).empty();
    if (in_surface && !query.any_code)
      good = good && surface_edge_is_sound(state, v, path.to);
    else if (!query.any_code)
      good = good && code_of(state, e) == 0;
  }
  if (good) {
    const auto after = parabolic_sectors(state, OneRing(state, v));
    good = std::none_of(after.begin(), after.end(), novel);
  }
  good = good && (!scope.accept || scope.accept(state));
  if (!good) snapshot.restore(state);
  return good;
}

bool try_starts(RepairState& state, VertexId v, Flow flow, bool any_code, const RingScope& scope) {
  isolate_star(state, v);
  RingQuery query;
  query.flow = flow;
  query.any_code = any_code;
  query.target = scope.target;
  query.cross_surfaces = scope.cross_surfaces;
  const OneRing ring(state, v);
  const bool pairs = query.flow == Flow::through && query.target != RingTarget::surface && !query.any_code;
  const auto starts = pairs ? starts_by_pairs(state, ring, scope) : starts_by_index(ring, scope);
  const auto known = parabolic_sectors(state, ring);
  for (VertexId start : starts) {
    query.start = start;
    auto paths = find_ring_paths(state, ring, query);
    if (paths.size() > 4) paths.resize(4);
    for (const RingPath& path : paths) {
      RepairState trial = state;  // a failure would leave splits behind, in which the next try would split more
      if (!zip_along(trial, v, path, query, scope, known)) continue;
      state = std::move(trial);
      return true;
    }
  }
  return false;
}

}  // namespace

bool detach_arc(RepairState& state, VertexId v, const RingScope& scope) {
  return try_starts(state, v, Flow::through, false, scope);
}

bool detach_zipper(RepairState& state, VertexId v, const RingScope& scope) {
  return try_starts(state, v, Flow::parallel, false, scope);
}

bool unzip_arc(RepairState& state, VertexId v, const RingScope& scope) {
  return try_starts(state, v, Flow::through, true, scope);
}

bool reverse_sector(RepairState& state, VertexId v, const RingScope& scope) {
  return try_starts(state, v, Flow::parallel, true, scope);
}

bool detach_to_boundary(RepairState& state, VertexId v, Flow flow, const RingScope& scope) {
  return try_starts(state, v, flow, false, scope);
}

}  // namespace hexfield
