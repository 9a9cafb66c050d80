#include <algorithm>

#include "hexfield/base/parallel.hpp"
#include "hexfield/mesh/quality.hpp"
#include "hexfield/repair/state_ops.hpp"
#include "remesh_context.hpp"

namespace hexfield {
namespace {

// Does the worst tet get better when the edge is split at its midpoint?
bool split_improves(const TetMesh& mesh, std::span<const TetId> ring, const EdgeKey& e) {
  const double before = worst_distortion(mesh, ring);
  const Vec3 middle = (mesh.point(e[0]) + mesh.point(e[1])) / 2;
  for (TetId t : ring)
    for (VertexId replaced : e) {
      std::array<Vec3, 4> x;
      for (std::size_t k = 0; k < 4; ++k) {
        const VertexId v = mesh.vertices(t)[k];
        x[k] = v == replaced ? middle : mesh.point(v);
      }
      if (!(tet_distortion(x[0], x[1], x[2], x[3]) < before)) return false;
    }
  return true;
}

}  // namespace

void split_pass(RemeshContext& context, std::span<const TetId> region) {
  RepairState& state = context.state;
  std::vector<SizedEdge> edges = sized_edges(context, region);
  std::erase_if(edges, [&](const SizedEdge& e) { return e.length < context.options.split_above; });
  sort_by_length(edges, true);
  for (const SizedEdge& e : edges) {
    const TetId seed = state.mesh.alive(e.seed) ? e.seed : find_tet_with_edge(state.mesh, e.edge[0], e.edge[1]);
    const EdgeRing ring = edge_ring(state.mesh, seed, e.edge[0], e.edge[1]);
    state.begin_operation(ring.tets.size());
    if (!context.editable(ring.tets) || !split_improves(state.mesh, ring.tets, e.edge)) continue;
    const std::size_t slots = state.mesh.num_tets();
    split_edge(state, e.edge[0], e.edge[1]);
    context.touch_new(slots);
    ++context.report.splits;
  }
}

}  // namespace hexfield
