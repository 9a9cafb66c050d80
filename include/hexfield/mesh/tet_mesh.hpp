#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hexfield/base/error.hpp"
#include "hexfield/base/geometry.hpp"
#include "hexfield/base/ids.hpp"

namespace hexfield {

/// Local vertices of face i (opposite to vertex i), counter-clockwise seen from outside a positive tet.
inline constexpr std::array<std::array<int, 3>, 4> tet_face_vertices = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
/// Local vertices of the six edges.
inline constexpr std::array<std::array<int, 2>, 6> tet_edge_vertices = {
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// Sorted vertex pair: the key of an undirected edge.
using EdgeKey = std::array<VertexId, 2>;
/// Sorted vertex triple: the key of an undirected face.
using FaceKey = std::array<VertexId, 3>;
EdgeKey edge_key(VertexId a, VertexId b);
FaceKey face_key(VertexId a, VertexId b, VertexId c);

/// Tetrahedral mesh of one process as flat arrays: 4 vertices and 4 opposite half-faces per tet.
///
/// Every tet is positively oriented: det(p1 - p0, p2 - p0, p3 - p0) > 0. Edits append tets and leave
/// tombstones (a tet whose first vertex is invalid); compact() in mesh/edit.hpp removes them.
struct TetMesh {
  std::vector<Vec3> points;                         ///< coordinates of the input, one per vertex
  std::vector<std::array<VertexId, 4>> tets;        ///< vertices per tet; all invalid in a tombstone
  std::vector<std::array<HalfFaceId, 4>> opposite;  ///< other side of each face; invalid on the boundary
  std::vector<TetId> vertex_tet;                    ///< one alive tet per vertex; invalid if it has none

  std::size_t num_vertices() const { return points.size(); }
  /// Number of slots, tombstones included.
  std::size_t num_tets() const { return tets.size(); }
  bool alive(TetId t) const { return tets[t.index()][0].valid(); }

  const std::array<VertexId, 4>& vertices(TetId t) const { return tets[t.index()]; }
  const Vec3& point(VertexId v) const { return points[v.index()]; }
  /// Invalid on the boundary.
  HalfFaceId opposite_half_face(HalfFaceId h) const {
    return opposite[h.tet().index()][static_cast<std::size_t>(h.local())];
  }
  bool is_boundary(HalfFaceId h) const { return !opposite_half_face(h).valid(); }
  /// Vertices of a half-face, counter-clockwise seen from outside its tet.
  std::array<VertexId, 3> face_vertices(HalfFaceId h) const;
  FaceKey key(HalfFaceId h) const;
  /// Local index (0..3) of v in t; throws Error(bug) when t does not have it.
  int local_index(TetId t, VertexId v) const;
  bool has_vertex(TetId t, VertexId v) const;
};

/// Mesh from positively oriented tets; builds `opposite` and `vertex_tet`.
/// Throws Error(bad_input) naming the tets when a face belongs to more than two of them or is met twice
/// with the same orientation.
TetMesh build_tet_mesh(std::vector<Vec3> points, std::vector<std::array<VertexId, 4>> tets);

/// Six times the signed volume.
double signed_volume6(const TetMesh& mesh, TetId t);
Vec3 centroid(const TetMesh& mesh, TetId t);
/// Unit normal of a half-face, pointing out of its tet.
Vec3 outward_normal(const TetMesh& mesh, HalfFaceId h);
/// Interior dihedral angle in radians of tet t at its edge (a, b).
double dihedral_angle(const TetMesh& mesh, TetId t, VertexId a, VertexId b);

/// The tets around the oriented edge a -> b, counter-clockwise seen with b towards the viewer.
struct EdgeRing {
  std::vector<TetId> tets;
  /// crossings[k] is the half-face of tets[k] that leads on to tets[k + 1] (cyclic when closed).
  /// An open ring has one more: crossings.back() is the boundary half-face of the last tet.
  std::vector<HalfFaceId> crossings;
  /// Open rings (boundary edges): the boundary half-face of the first tet. Invalid in closed rings.
  HalfFaceId first_boundary;
  bool closed = false;
};

/// Ring of the edge a -> b, starting from the tet `seed` that contains it; an open ring starts at its
/// most clockwise tet. With several fans at a non-manifold edge: the fan of the seed.
EdgeRing edge_ring(const TetMesh& mesh, TetId seed, VertexId a, VertexId b);

/// All alive tets at v that are connected to mesh.vertex_tet[v] through faces at v, ascending.
std::vector<TetId> vertex_star(const TetMesh& mesh, VertexId v);

/// The smallest tet that contains the edge (in one fan of it), or an invalid id when no such edge exists.
TetId find_tet_with_edge(const TetMesh& mesh, VertexId a, VertexId b);
/// The smaller half-face with these vertices, or an invalid id.
HalfFaceId find_half_face(const TetMesh& mesh, const FaceKey& face);

/// Broken invariants of the mesh: opposites not mutual, wrong vertex_tet, tets not positive.
std::vector<Violation> check(const TetMesh& mesh);

}  // namespace hexfield
