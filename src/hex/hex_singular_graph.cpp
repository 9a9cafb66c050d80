#include "hexfield/hex/hex_singular_graph.hpp"

#include <algorithm>

#include "hexfield/base/parallel.hpp"

namespace hexfield {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Follows chains of singular edges.
class CurveTracer {
 public:
  explicit CurveTracer(const HexComplex& complex) : complex_(complex), degree_(complex.num_vertices(), 0) {
    for (std::size_t e = 0; e < complex.edges.size(); ++e)
      if (complex.is_singular(static_cast<int>(e)))
        for (int v : complex.edges[e]) ++degree_[at(v)];
    done_.assign(complex.edges.size(), 0);
  }

  int degree(int v) const { return degree_[at(v)]; }

  HexSingularGraph::Curve trace(int edge) {
    HexSingularGraph::Curve curve{complex_.valence(edge), false, {}};
    const auto [a, b] = complex_.edges[at(edge)];
    done_[at(edge)] = 1;
    std::vector<int> forward = walk(edge, b);
    if (forward.back() == a && !ends(a) && forward.size() > 1) {
      forward.insert(forward.begin(), a);
      forward.pop_back();
      curve.closed = true;
      curve.vertices = std::move(forward);
      return curve;
    }
    const std::vector<int> backward = walk(edge, a);
    curve.vertices.assign(backward.rbegin(), backward.rend());
    curve.vertices.insert(curve.vertices.end(), forward.begin(), forward.end());
    return curve;
  }

  bool done(int edge) const { return done_[at(edge)] != 0; }

 private:
  bool ends(int v) const { return complex_.is_boundary_vertex(v) || degree_[at(v)] != 2; }

  // Vertices from v on, away from the edge.
  std::vector<int> walk(int edge, int v) {
    std::vector<int> chain{v};
    while (!ends(v)) {
      int next = -1;
      for (int e : complex_.vertex_edges[v])
        if (e != edge && complex_.is_singular(e)) next = e;
      if (done_[at(next)] != 0) break;
      done_[at(next)] = 1;
      edge = next;
      v = complex_.other_end(edge, v);
      chain.push_back(v);
    }
    return chain;
  }

  const HexComplex& complex_;
  std::vector<int> degree_;
  std::vector<char> done_;
};

}  // namespace

HexSingularGraph hex_singular_graph(const HexMesh& mesh, const HexComplex& complex) {
  HexSingularGraph graph;
  CurveTracer tracer(complex);
  for (std::size_t k = 0; k < complex.edges.size(); ++k) {
    const int e = static_cast<int>(k);
    if (complex.is_boundary_edge(e)) {
      if (complex.valence(e) > 2) ++graph.concave_edges[complex.valence(e)];
      continue;
    }
    if (!complex.is_singular(e)) continue;
    ++graph.edges[complex.valence(e)];
    if (!tracer.done(e)) graph.curves.push_back(tracer.trace(e));
  }
  for (std::size_t k = 0; k < complex.num_vertices(); ++k) {
    const int v = static_cast<int>(k);
    if (complex.is_boundary_vertex(v))
      graph.crowded_boundary_vertices += tracer.degree(v) > 1 ? 1 : 0;
    else if (tracer.degree(v) > 2)
      graph.nodes.push_back({v, "", ""});
  }
  parallel_for(graph.nodes.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const VertexSphere star = vertex_sphere(mesh, complex, graph.nodes[k].vertex);
      graph.nodes[k].signature = signature_text(star.sphere);
      graph.nodes[k].code = canonical_code(star.sphere);
    }
  });
  return graph;
}

std::map<std::string, int> nodes_by_signature(const HexSingularGraph& graph) {
  std::map<std::string, int> count;
  for (const auto& node : graph.nodes) ++count[node.signature];
  return count;
}

std::map<int, int> curves_by_valence(const HexSingularGraph& graph) {
  std::map<int, int> count;
  for (const auto& curve : graph.curves) ++count[curve.valence];
  return count;
}

}  // namespace hexfield
