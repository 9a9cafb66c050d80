#pragma once

#include <map>
#include <string>
#include <vector>

#include "hexfield/field/frame_field.hpp"
#include "hexfield/mesh/features.hpp"

namespace hexfield {

/// A chain of singular edges of one code, all inside or all on the boundary, between two nodes or closed.
struct SingularArc {
  std::vector<VertexId> vertices;  ///< first = last when closed
  EdgeCode code = 0;
  bool boundary = false;
  bool closed = false;
};

/// What the codes of the edges at a vertex tell (spec-lmff section 3). Counts are necessary conditions only.
enum class NodeKind {
  arc,       ///< inner point of an arc, or an arc that meets the surface
  node,      ///< an admissible node or corner
  zipper,    ///< two parallel arcs meet with opposite codes, or an arc meets the surface with reversed flow
  compound,  ///< has compound or undetermined edges
  invalid,   ///< any other combination
};
const char* name(NodeKind kind);

/// Numbers of singular edges at a vertex: on the boundary and inside, with code -1 and +1, and all others.
struct EdgeCounts {
  int boundary_minus = 0, boundary_plus = 0, inner_minus = 0, inner_plus = 0, other = 0, undetermined = 0;
};

struct SingularNode {
  VertexId vertex;
  NodeKind kind = NodeKind::node;
  EdgeCounts counts;
};

/// Kind of a vertex from the codes of the singular edges at it: all of them, each once. Not collective.
SingularNode classify_vertex(const TetMesh& mesh, const Features& features, const FrameField& field,
                             const EdgeCodes& codes, VertexId v, const std::vector<EdgeKey>& edges);

/// The singular edges of a field as arcs and nodes, ordered by vertex ids.
struct SingularityGraph {
  std::vector<SingularArc> arcs;
  std::vector<SingularNode> nodes;        ///< every vertex where arcs end, and every zipper node
  std::map<EdgeCode, std::size_t> edges;  ///< number of edges per code; compound and undetermined included
};

/// Not collective.
SingularityGraph singularity_graph(const TetMesh& mesh, const Features& features, const FrameField& field,
                                   const EdgeCodes& codes);

/// Violations of the graph against the field: a listed inner edge whose monodromy does not fit its code, a
/// singular edge that is not listed, vertices of an arc that are no edge of the mesh.
std::vector<Violation> check(const TetMesh& mesh, const FrameField& field, const EdgeCodes& codes,
                             const SingularityGraph& graph);

/// Gives the inner arcs of one quarter-turn one sign where it flips only because a zigzag of edges runs
/// against the flow (defect D2; spec-lmff section 3 "sign ambiguity"). Along every maximal chain the stretch
/// with the least flow length (sum of |axis . edge|) takes the sign of its neighbours while it holds less than
/// `share` of the whole chain; undetermined edges count nothing. The monodromies stay. Returns the number of
/// changed codes. Not collective.
int unify_codes(const TetMesh& mesh, const FrameField& field, EdgeCodes& codes, double share = 0.2);

/// A reason why the field cannot be meshable there.
struct Defect {
  std::string sentence;
  std::vector<VertexId> vertices;  ///< one: a node; two: an edge
  std::vector<Vec3> places;
};

/// Necessary conditions of local meshability (spec-lmff section 7, without the geometric test): no compound or
/// undetermined edges, at least one quad in every sector and around every edge, admissible counts at vertices,
/// no zipper nodes. Not collective.
std::vector<Defect> find_defects(const TetMesh& mesh, const Features& features, const FrameField& field,
                                 const EdgeCodes& codes);

}  // namespace hexfield
