#include <algorithm>

#include "hexfield/field/edge_codes.hpp"
#include "hexfield/repair/edge_repair.hpp"
#include "hexfield/repair/neighbourhood_loop.hpp"
#include "hexfield/repair/state_ops.hpp"
#include "hexfield/repair/zipping.hpp"

namespace hexfield {
namespace {

using EdgeOperation = bool (*)(RepairState&, const EdgeKey&);

// Runs the operation at every edge of the list on a copy of its place; failures keep nothing, not even splits.
int at_edges(RepairState& state, const std::vector<EdgeKey>& edges, EdgeOperation operation) {
  std::vector<Place> places;
  for (const EdgeKey& e : edges) places.push_back({{e[0], e[1]}, 1});
  const auto commits = for_places(state, places, [&](Neighbourhood& copy, std::span<const VertexId> seeds) {
    if (!find_tet_with_edge(copy.local.mesh, seeds[0], seeds[1]).valid()) return false;
    return operation(copy.local, edge_key(seeds[0], seeds[1]));
  });
  return static_cast<int>(std::count(commits.begin(), commits.end(), 1));
}

template <class Choose>
std::vector<EdgeKey> edges_where(const RepairState& state, const Choose& choose) {
  std::vector<EdgeKey> edges;
  for (const auto& [edge, code] : state.codes)
    if (choose(edge, code)) edges.push_back(edge);
  return edges;
}

// Feature edges and singular edges of feature faces whose sectors are wrong. Regular edges off the feature edges have
// sectors of two quads.
std::vector<EdgeKey> edges_with_bad_sectors(const RepairState& state) {
  std::vector<EdgeKey> candidates = edges_where(state, [](const EdgeKey&, EdgeCode) { return true; });
  for (const auto& entry : state.features.edges) candidates.push_back(entry.first);
  std::sort(candidates.begin(), candidates.end());
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
  std::erase_if(candidates, [&](const EdgeKey& e) {
    const EdgeCode code = code_of(state, e);
    const bool wide = code >= 2 && code != compound_code && code != undetermined_code;
    return empty_sectors(state, e) == 0 && !wide;
  });
  return candidates;
}

// An inner edge of a feature face.
bool in_surface(const RepairState& state, const EdgeKey& e) {
  const EdgeRing ring = ring_of(state.mesh, e[0], e[1]);
  return ring.closed && std::any_of(ring.crossings.begin(), ring.crossings.end(),
                                    [&](HalfFaceId h) { return is_feature_face(state, h); });
}

bool meets_surface(const RepairState& state, const EdgeKey& e) {
  return on_feature_face(state, e[0]) || on_feature_face(state, e[1]);
}

int remove_triangles(RepairState& state) {
  std::set<FaceKey> faces;
  for (const auto& entry : state.codes) {
    const EdgeKey& e = entry.first;
    for (TetId t : ring_of(state.mesh, e[0], e[1]).tets)
      for (VertexId w : state.mesh.vertices(t))
        if (w != e[0] && w != e[1] && state.codes.contains(edge_key(e[0], w)) &&
            state.codes.contains(edge_key(e[1], w)))
          faces.insert(face_key(e[0], e[1], w));
  }
  int removed = 0;
  for (const FaceKey& f : faces) removed += remove_singular_triangle(state, f);
  return removed;
}

// Codes of boundary edges are sums of sectors, which frames alone can change.
void refresh_boundary_codes(RepairState& state) {
  std::vector<EdgeKey> edges =
      edges_where(state, [&](const EdgeKey& e, EdgeCode) { return !ring_of(state.mesh, e[0], e[1]).closed; });
  update_codes(state, edges);
}

}  // namespace

EdgeRepairCounts repair_edges(RepairState& state, const EdgeRepairOptions& options) {
  EdgeRepairCounts counts;
  refresh_boundary_codes(state);
  for (int round = 0; round < options.rounds; ++round) {
    const int before = counts.total();
    if (options.triangles) counts.triangles += remove_triangles(state);
    if (options.push) counts.pushed += push_arcs_inside(state);
    const auto compound = [](const EdgeKey&, EdgeCode code) { return code == compound_code; };
    if (options.contract) counts.contracted += at_edges(state, edges_where(state, compound), contract_compound_edge);
    if (options.compound) {
      std::vector<EdgeKey> edges = edges_where(state, compound);
      if (!options.compound_inside) std::erase_if(edges, [&](const EdgeKey& e) { return !meets_surface(state, e); });
      counts.compound += at_edges(state, edges, repair_compound_edge);
    }
    if (options.sectors) counts.sectors += at_edges(state, edges_with_bad_sectors(state), repair_sectors);
    if (options.lift) {
      counts.lifted += lift_arcs_from_surfaces(state);
      const auto any = [](const EdgeKey&, EdgeCode) { return true; };
      std::vector<EdgeKey> edges = edges_where(state, any);
      std::erase_if(edges, [&](const EdgeKey& e) { return state.features.edges.contains(e) || !in_surface(state, e); });
      counts.lifted += at_edges(state, edges, lift_from_surface);
    }
    if (options.index) {
      const auto high = [](const EdgeKey&, EdgeCode code) {
        return std::abs(code) >= 2 && code != compound_code && code != undetermined_code;
      };
      counts.index += at_edges(state, edges_where(state, high), lower_index);
    }
    if (counts.total() == before || state.exhausted()) break;
  }
  return counts;
}

}  // namespace hexfield
