#pragma once

#include <map>
#include <string>
#include <vector>

#include "hexfield/hex/hex_complex.hpp"

namespace hexfield {

/// Singular edges of a hex mesh joined to curves, and the nodes where they meet (section 2.1 of the paper).
struct HexSingularGraph {
  /// Chain of singular edges of one valence from node or boundary to node or boundary.
  struct Curve {
    int valence;
    bool closed;                ///< the last vertex is then joined to the first
    std::vector<int> vertices;  ///< in order along the curve
  };
  /// Interior vertex with more than two singular edges.
  struct Node {
    int vertex;
    std::string signature;
    std::string code;
  };

  std::vector<Curve> curves;          ///< ascending by their lowest edge
  std::vector<Node> nodes;            ///< ascending by vertex
  std::map<int, int> edges;           ///< singular edges per valence
  int crowded_boundary_vertices = 0;  ///< boundary vertices where more than one singular curve ends
  /// Boundary edges per number of hexes, without those of one hex (convex edges) and two (flat ones).
  std::map<int, int> concave_edges;
};
HexSingularGraph hex_singular_graph(const HexMesh& mesh, const HexComplex& complex);

/// Nodes per signature.
std::map<std::string, int> nodes_by_signature(const HexSingularGraph& graph);
/// Curves per valence.
std::map<int, int> curves_by_valence(const HexSingularGraph& graph);

}  // namespace hexfield
