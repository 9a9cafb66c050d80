#pragma once

#include <array>
#include <span>
#include <vector>

#include "hexfield/hex/hex_mesh.hpp"
#include "hexfield/hex/sphere_triangulation.hpp"

namespace hexfield {

/// Lists of numbers of different length, one after the other.
struct IncidenceLists {
  std::vector<int> first;  ///< one more than there are lists
  std::vector<int> entries;

  std::size_t size() const { return first.empty() ? 0 : first.size() - 1; }
  std::span<const int> operator[](int k) const {
    const auto begin = static_cast<std::size_t>(first[static_cast<std::size_t>(k)]);
    const auto end = static_cast<std::size_t>(first[static_cast<std::size_t>(k) + 1]);
    return std::span<const int>(entries).subspan(begin, end - begin);
  }
};

/// Quads, edges and incidences of a hex mesh, about 420 bytes per hex.
struct HexComplex {
  std::vector<std::array<int, 4>> quads;       ///< counter-clockwise seen from outside quad_hexes[q][0]
  std::vector<std::array<int, 2>> quad_hexes;  ///< lower hex first; the second is -1 on the boundary
  std::vector<std::array<int, 4>> quad_edges;  ///< edge k joins vertices k and k + 1 of the quad
  std::vector<std::array<int, 6>> hex_quads;   ///< in the order of the sides of a VTK hexahedron
  std::vector<std::array<int, 2>> edges;       ///< ascending pairs in ascending order
  IncidenceLists edge_quads;                   ///< ascending
  IncidenceLists vertex_corners;               ///< 8 hex + corner, ascending
  IncidenceLists vertex_edges;                 ///< ascending
  std::vector<char> boundary_edge;
  std::vector<char> boundary_vertex;

  std::size_t num_vertices() const { return boundary_vertex.size(); }
  bool is_boundary_quad(int q) const { return quad_hexes[static_cast<std::size_t>(q)][1] < 0; }
  bool is_boundary_edge(int e) const { return boundary_edge[static_cast<std::size_t>(e)] != 0; }
  bool is_boundary_vertex(int v) const { return boundary_vertex[static_cast<std::size_t>(v)] != 0; }
  /// Number of hexes around an edge.
  int valence(int e) const { return static_cast<int>(edge_quads[e].size()) - (is_boundary_edge(e) ? 1 : 0); }
  /// Inside, and not between four hexes.
  bool is_singular(int e) const { return !is_boundary_edge(e) && valence(e) != 4; }
  int other_end(int e, int v) const {
    const auto& ends = edges[static_cast<std::size_t>(e)];
    return ends[0] == v ? ends[1] : ends[0];
  }
  /// The edge between two vertices, -1 when there is none.
  int find_edge(int a, int b) const;
  /// The quad with these vertices in any order, -1 when there is none.
  int find_quad(std::array<int, 4> vertices) const;
  /// The other edge of a quad at an end v of its edge e.
  int next_edge(int q, int e, int v) const;
  /// The quad that has both edges; -1 when there is none.
  int quad_between(int e, int f) const;
};

/// Takes parallel sorts over the sides. Throws Error(bad_input) naming hexes and places when ids are out of range,
/// a hex has a vertex twice or a face belongs to more than two hexes.
HexComplex build_hex_complex(const HexMesh& mesh);

/// T(v) of an interior vertex; sphere vertex k is mesh edge edges[k].
struct VertexSphere {
  SphereTriangulation sphere;
  std::vector<int> edges;
};
/// Throws Error(bad_input) naming the vertex and its place when its hexes are no simple triangulation with valences
/// of at least 3, which all hex meshes of manifolds without doublets are.
VertexSphere vertex_sphere(const HexMesh& mesh, const HexComplex& complex, int vertex);

/// What a hex mesh must be for sheets, beyond check(HexMesh): every interior vertex a simple sphere triangulation (so
/// no edge of valence 1 or 2), no boundary vertex or edge inside a face or edge of another hex (hanging).
std::vector<Violation> check_for_sheets(const HexMesh& mesh, const HexComplex& complex);

}  // namespace hexfield
