#pragma once

#include <span>
#include <utility>
#include <vector>

#include "hexfield/field/edge_codes.hpp"
#include "hexfield/repair/remesh.hpp"

namespace hexfield {

/// Where vertices lie, for the legality of edits; kept by vertex slot.
struct VertexMarks {
  std::vector<char> on_face, on_curve, singular;  ///< on feature faces, feature edges, edges with a code
  explicit VertexMarks(const RepairState& state);
};

/// What the passes of one remeshing share.
struct RemeshContext {
  RepairState& state;
  const RemeshOptions& options;
  RemeshReport& report;

  bool editable(TetId t) const { return !options.editable || options.editable(t); }
  bool editable(std::span<const TetId> tets) const;
  /// Notes tets that are new or have other vertices.
  void touch(std::span<const TetId> tets) { report.touched.insert(report.touched.end(), tets.begin(), tets.end()); }
  void touch_new(std::size_t first_slot);
  /// Length in units of the mean target length of the ends.
  double relative_length(const EdgeKey& e) const;
};

struct SizedEdge {
  EdgeKey edge;
  TetId seed;
  double length;
};
/// Edges of these tets with a tet of each, by key.
std::vector<SizedEdge> sized_edges(const RemeshContext& context, std::span<const TetId> tets);
/// Longest or shortest first, ties by key. `edges` comes ordered by key.
void sort_by_length(std::vector<SizedEdge>& edges, bool longest_first);

/// Largest distortion (mesh/quality.hpp) of some tets.
double worst_distortion(const TetMesh& mesh, std::span<const TetId> tets);

/// Code from frames and matchings as they are now.
EdgeCode computed_code(const RepairState& state, const EdgeKey& e, TetId seed);

void split_pass(RemeshContext& context, std::span<const TetId> region);
void collapse_pass(RemeshContext& context, std::span<const TetId> region);
void swap_pass(RemeshContext& context, std::span<const TetId> region);

/// One attempt each; false, and nothing has changed, where it is not legal (or, for swaps, no improvement).
bool try_collapse(RemeshContext& context, const VertexMarks& marks, VertexId from, VertexId to);
bool try_swap(RemeshContext& context, const VertexMarks& marks, TetId seed, VertexId a, VertexId b);

}  // namespace hexfield
