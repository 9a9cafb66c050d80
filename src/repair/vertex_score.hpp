#pragma once

#include <set>

#include "hexfield/field/singularity_graph.hpp"
#include "hexfield/repair/vertex_repair.hpp"

/// What operations at a vertex are judged by, and their list.
namespace hexfield {

/// The vertices of the one-ring of a vertex before anything was split there; those made since count as near too.
struct Near {
  std::set<VertexId> vertices;
  std::size_t first_new = 0;
};
Near near_of(const TetMesh& mesh, VertexId v);

/// Of a neighbourhood after an operation, per tet of it, in RepairWatch::work.
inline constexpr std::size_t work_of_judging = 3;

/// What an operation must make less: near vertices that no hex mesh has by counts of codes, parabolic sectors of the
/// centre, and edges there. Zipper nodes elsewhere may appear: they are resolved by unzipping. But an arc may leave a
/// feature curve beside it only where the curve ends: in the middle it would have to be unzipped both ways.
struct VertexScore {
  int invalid = 0;          ///< without the centre
  int zippers = 0;          ///< without the centre
  bool bad = false;         ///< the centre: parabolic sectors, or counts that no hex mesh has
  std::size_t sectors = 0;  ///< parabolic ones
  long empty = 0;           ///< surface sectors without a quad among them; sequences only
  std::size_t edges = 0;
};
VertexScore score_of(RepairState& state, VertexId v, const Near& near);
/// Without what needs the one-ring: `bad` and `sectors`.
VertexScore score_near(const RepairState& state, VertexId v, const Near& near);

/// What counts of codes tell. Where three or more feature edges meet there are more nodes than they know.
bool counts_are_good(const RepairState& state, VertexId v);
/// Do three or more feature edges meet at v?
bool is_feature_node(const RepairState& state, VertexId v);

using VertexAccept = std::function<bool(RepairState&)>;
using VertexOperation = std::function<bool(RepairState&, VertexId, const VertexAccept&)>;

/// The operations of spec-lmff section 5.5 in their order.
std::vector<VertexOperation> vertex_operations(const RepairState& state, VertexId v, bool reversals);
/// What sequences are made of: DT1 and DT2 between any edges, feature edges included, DT1 through the boundary, DT5.
std::vector<VertexOperation> sequence_operations(const RepairState& state, VertexId v);

/// Looks for a sequence of operations, last resorts included, after which v is meshable: best first by score, a
/// limited number of steps. Keeps the whole sequence or nothing.
bool repair_by_sequence(RepairState& local, VertexId v, const VertexRepairOptions& options);

}  // namespace hexfield
