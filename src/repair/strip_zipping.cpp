#include "strip_zipping.hpp"

#include <algorithm>

#include "hexfield/repair/field_snapshot.hpp"
#include "hexfield/repair/state_ops.hpp"
#include "hexfield/repair/zipping.hpp"

namespace hexfield {

NodeKind kind_of(const RepairState& state, VertexId v) {
  const auto edges = singular_edges_at(state, v);
  if (edges.empty()) return NodeKind::arc;
  return classify_vertex(state.mesh, state.features, state.field, state.codes, v, edges).kind;
}

bool is_defect(const RepairState& state, VertexId v) {
  const NodeKind kind = kind_of(state, v);
  return kind != NodeKind::arc && kind != NodeKind::node;
}

namespace {

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

}  // namespace

std::optional<ZipTarget> code_target(const RepairState& state, VertexId from, VertexId to, TetId tet,
                                     octahedral::Label label, EdgeCode code) {
  const EdgeKey e = edge_key(from, to);
  const TetId first = ring_of(state.mesh, e[0], e[1]).tets.front();
  const auto star = flow_star(state, {from, tet});
  const auto place = std::ranges::find(star, first, &FlowPlace::tet);
  if (place == star.end()) return {};
  // The monodromy of e[0] -> e[1] is the turn by +90 degrees about its outgoing label for code +1, against it for -1.
  const bool reversed = (e[0] != from) != (code < 0);
  const octahedral::Label along = label_at(*place, label);
  return ZipTarget{e, octahedral::quarter_turn(reversed ? octahedral::negate(along) : along)};
}

bool zip_strip(RepairState& state, const Strip& strip, const ZipTarget& target, EdgeCode first_code,
               const ZipperOptions& options) {
  const long before = num_defects(state, strip);
  const FieldSnapshot snapshot(state, tets_touching(state.mesh, strip.faces));
  ZipOptions zip;
  zip.sweeps = 0;
  if (!zip_patch(state, {strip.faces, target.start, strip.boundary()}, target.monodromy, zip)) return false;
  const int pair = new_pair(state);
  mark_side(state, strip.first, first_code, pair);
  mark_side(state, strip.second, -first_code, pair);
  smooth(state, tets_touching(state.mesh, strip.faces), options.sweeps, SingularSign::by_code);
  if (num_defects(state, strip) < before) return true;
  snapshot.restore(state);
  return false;
}

}  // namespace hexfield
