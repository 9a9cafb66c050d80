#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "hexfield/field/singularity_graph.hpp"
#include "hexfield/repair/repair_state.hpp"

/// Local meshability (Liu & Bommes 2023, section 3 conditions C1 to C3 and section 5; spec-lmff section 7): does the
/// field around an edge or vertex admit a seamless map without inversion? Nothing here is collective.
namespace hexfield {

/// A field on a mesh as the checks read it. Codes are trusted up to what the matchings tell.
struct FieldView {
  const TetMesh& mesh;
  const Features& features;
  const FrameField& field;
  const EdgeCodes& codes;
  RepairWatch* watch = nullptr;  ///< hears of every vertex that is solved; may be null

  FieldView(const TetMesh& m, const Features& f, const FrameField& q, const EdgeCodes& c)
      : mesh(m), features(f), field(q), codes(c) {}
  FieldView(const RepairState& state)  // NOLINT(google-explicit-constructor): every state is one
      : FieldView(state.mesh, state.features, state.field, state.codes) {
    watch = state.watch.get();
  }
};

/// An edge is meshable when its monodromy fits its code, the code is neither compound nor undetermined and leaves
/// at least one quad, and, where feature faces meet at it, every sector between them holds at least one quad and
/// the sectors sum up to 4 + code (2 + code on the boundary).
bool edge_meshable(const FieldView& view, const EdgeKey& edge);

class VerdictMemory;

struct VertexMapOptions {
  int refinements = 1;         ///< how often a one-ring too coarse for its constraints may be split
  int sweeps = 40;             ///< of Algorithm 1 on the one-ring alone, for a guess; four times as many for another
  int max_iterations = 100;    ///< Newton steps of one solve
  double smallest_det = 1e-7;  ///< of the unit images of three ring vertices, to count as positive
  const VerdictMemory* memory = nullptr;  ///< verdicts to take instead of looking for a map again
};

enum class VertexVerdict {
  meshable,             ///< the one-ring has a map
  meshable_when_split,  ///< it has one after every edge opposite to the vertex is split
  not_meshable,         ///< no map was found: no proof that there is none
};

/// Verdicts on one-rings. Which maps there are depends on the triangulation of the link, matchings, feature faces,
/// sectors and axes alone, which the key is a hash of: the geometry of a one-ring only guides the search. So a map that
/// was found once is there as long as the key stays; that none was found says only that this search is not worth its
/// time again.
class VerdictMemory {
 public:
  using Key = std::uint64_t;

  std::optional<VertexVerdict> find(Key key) const;
  void note(Key key, VertexVerdict verdict) { verdicts_[key] = verdict; }
  const std::map<Key, VertexVerdict>& all() const { return verdicts_; }
  /// Only the maps that were found.
  VerdictMemory found() const;

 private:
  std::map<Key, VertexVerdict> verdicts_;
};

/// One tet of a mapped one-ring (of the split one where the verdict says so): directions from the vertex to the
/// three other corners, unit, in world axes; their images in the chart of `tet`, the tet it is (part of).
struct MappedTet {
  TetId tet;
  std::array<Vec3, 3> directions;
  std::array<Vec3, 3> images;
};

/// Looks for a seamless map of the one-ring of v that maps v to the origin: continuous across every inner face by
/// its matching, feature faces in coordinate planes, feature and singular edges on coordinate axes, all exact because
/// they are eliminated; det > 0 in every tet; image angles around every edge, sector by sector between feature faces,
/// as its code says. Features and codes that are not at v play no part (spec-lmff section 7).
///
/// Lengths of the images do not change any sign, so the map is a drawing of the link of v on the unit sphere. What the
/// frames see is tried first, then it is untangled (Garanzha et al. 2021), then the same with the frames aligned to
/// features and, by code, to arcs (on a copy). `map` receives the one that was found. A vertex of an edge that is not
/// meshable is not meshable.
///
/// With options.memory `map` stays as it is where the memory knows the one-ring. `key` receives what to note the
/// verdict by; nothing when an edge at v decides already.
VertexVerdict vertex_verdict(const FieldView& view, VertexId v, const VertexMapOptions& options = {},
                             std::vector<MappedTet>* map = nullptr, std::optional<VerdictMemory::Key>* key = nullptr);
/// An inner vertex without special edge or feature face: all charts around it are one.
bool is_trivially_regular(const FieldView& view, VertexId v);
bool vertex_meshable(const FieldView& view, VertexId v, const VertexMapOptions& options = {});

/// Where a field is not locally meshable.
struct Meshability {
  std::size_t edges = 0;               ///< all edges of the mesh
  std::size_t vertices = 0;            ///< all vertices with tets
  std::size_t solved = 0;              ///< vertices that needed a map: at special edges or feature faces
  std::vector<EdgeKey> bad_edges;      ///< not meshable, ascending
  std::vector<VertexId> bad_vertices;  ///< not meshable, ascending
  std::vector<VertexId> split_first;   ///< meshable once their one-ring is split, ascending
  VerdictMemory verdicts;              ///< of all vertices that needed a map
  bool meshable() const { return bad_edges.empty() && bad_vertices.empty(); }
};

/// Every edge and every vertex, on all threads of this process; the same result for any number of them. A vertex
/// inside that has no special edge needs no solve: around it all charts are one, and the identity is a map.
Meshability check_meshability(const FieldView& view, const VertexMapOptions& options = {});
/// These edges and vertices only.
Meshability check_meshability(const FieldView& view, std::span<const EdgeKey> edges, std::span<const VertexId> vertices,
                              const VertexMapOptions& options = {});

/// find_defects() without the vertices where a map refutes it: the counts of codes that it knows are those of nodes
/// where at most three feature edges meet.
std::vector<Defect> unrefuted_defects(const FieldView& view, const VertexMapOptions& options = {});

}  // namespace hexfield
