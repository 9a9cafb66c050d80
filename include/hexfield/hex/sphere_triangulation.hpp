#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace hexfield {

/// Sphere triangulation T(v) of an interior vertex v of a hex mesh (spec-sheets section 1): a vertex per mesh edge
/// at v (its degree is the valence of the edge), an edge per quad at v, a triangle per hex corner at v.
/// Stored as a rotation system: the neighbours of each vertex, counter-clockwise seen from outside the sphere.
struct SphereTriangulation {
  std::vector<std::vector<int>> rings;

  int size() const { return static_cast<int>(rings.size()); }
  int degree(int vertex) const { return static_cast<int>(rings[static_cast<std::size_t>(vertex)].size()); }
  int max_degree() const;
  bool has_edge(int a, int b) const;
  /// Each triangle once, lowest vertex first, counter-clockwise seen from outside.
  std::vector<std::array<int, 3>> triangles() const;
  bool operator==(const SphereTriangulation&) const = default;
};

/// The triangulation with these triangles, all counter-clockwise seen from outside, over vertices 0..vertices-1.
/// Throws Error(bad_input) when they are not a simple triangulation of the sphere with degrees of at least 3.
SphereTriangulation sphere_from_triangles(int vertices, const std::vector<std::array<int, 3>>& triangles);
/// The same, but false and a reason instead of an error.
bool try_sphere_from_triangles(int vertices, const std::vector<std::array<int, 3>>& triangles,
                               SphereTriangulation& sphere, std::string& reason);

/// Vertices per degree: element k counts degree 3 + k; at least three elements (3, 4, 5).
std::vector<int> signature(const SphereTriangulation& sphere);
/// "(n3,n4,n5[,n6...])" as in the paper.
std::string signature_text(const SphereTriangulation& sphere);

/// What a vertex of this type is (section 2.1 of the paper).
enum class VertexType : std::uint8_t { regular, curve, node };
VertexType vertex_type(const SphereTriangulation& sphere);

/// Text that is equal for two triangulations exactly when they are isomorphic, mirror images included: the number
/// of vertices and the neighbours of each ('a' is the first) after the smallest breadth-first renumbering.
std::string canonical_code(const SphereTriangulation& sphere);
/// Inverse of canonical_code() up to isomorphism. Throws Error(bad_input) for any other text.
SphereTriangulation sphere_from_code(const std::string& code);
/// All automorphisms, mirror images included, as images of the vertices; ascending.
std::vector<std::vector<int>> automorphisms(const SphereTriangulation& sphere);
/// An isomorphism, mirror images included: the vertex of `to` for each vertex of `from`; empty when there is none.
std::vector<int> isomorphism(const SphereTriangulation& from, const SphereTriangulation& to);

/// All simple cycles of at most `longest` vertices, each once: lowest vertex first, then the lower of its two
/// neighbours on the cycle; in lexicographic order.
std::vector<std::vector<int>> simple_cycles(const SphereTriangulation& sphere, int longest);

/// The two sides of a cycle, each closed by a cone (spec-sheets section 2). The apex of the cone is the last vertex
/// of each half, before it stand the vertices of the side in ascending order.
struct SphereSplit {
  SphereTriangulation left;   ///< what lies left of the cycle, seen from outside
  SphereTriangulation right;  ///< what lies right of it
  std::vector<int> left_of;   ///< vertex of the split triangulation per vertex of `left`, -1 for the apex
  std::vector<int> right_of;
};
SphereSplit split(const SphereTriangulation& sphere, const std::vector<int>& cycle);

/// One triangulation per isomorphism class for each number of vertices 4..most: element n - 4 holds those with n.
/// Each comes from a smaller one by a vertex of degree 3, 4 or 5. Takes a second of CPU for most = 10.
std::vector<std::vector<SphereTriangulation>> all_sphere_triangulations(int most);

}  // namespace hexfield
