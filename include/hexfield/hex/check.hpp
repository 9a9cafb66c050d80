#pragma once

#include <array>
#include <vector>

#include "hexfield/base/error.hpp"
#include "hexfield/hex/hex_mesh.hpp"
#include "hexfield/mesh/features.hpp"

namespace hexfield {

/// Smallest scaled Jacobian (determinant of the three unit edge vectors) over the eight corners of a hex.
double scaled_jacobian(const HexMesh& mesh, std::size_t hex);

/// Scaled Jacobians of a mesh, one per hex: the smallest of its eight corners.
struct HexQuality {
  static constexpr std::array<double, 7> percents = {0.1, 1, 5, 25, 50, 75, 95};
  double min = 1;
  double mean = 1;
  std::array<double, 7> percentiles{1, 1, 1, 1, 1, 1, 1};  ///< at `percents`
  std::size_t not_positive = 0;
};
HexQuality quality(const HexMesh& mesh);

/// Volume of a hex mesh, each hex cut into five tets as in the mid-edge consistent cut (0,1,3,4), (1,2,3,6),
/// (1,4,5,6), (3,4,6,7), (1,3,4,6); in units of the input cubed.
double volume(const HexMesh& mesh);

/// Numbers that a mesh and the mesh made from it must share.
struct MeshTopology {
  int components = 0;
  int boundary_components = 0;
  int euler_volume = 0;
  int euler_boundary = 0;
  int boundary_edges_not_in_two_faces = 0;
  bool operator==(const MeshTopology&) const = default;
};
MeshTopology topology(const HexMesh& mesh);
MeshTopology topology(const TetMesh& mesh);

/// Broken invariants: ids out of range, a hex with a vertex twice, doubled hexes, faces in more than two hexes,
/// vertices without hex, vertices whose hexes do not hang together through faces, corners that are not
/// positive, feature entities that are not vertices, edges or faces of hexes. Ids are hexes or vertices.
std::vector<Violation> check(const HexMesh& mesh);

/// How well a hex mesh is that of a tet mesh.
struct HexAgainstTets {
  struct Coverage {
    int wanted = 0;
    int wrong = 0;
  };
  MeshTopology hexes;
  MeshTopology tets;
  double volume_ratio = 0;
  Coverage points;    ///< a hex vertex of the colour within 1e-6 of the bounding-box diagonal
  Coverage curves;    ///< per colour: same ends, on the curve within `tolerance` diagonals, length within 5 tolerance
  Coverage surfaces;  ///< per colour: on the surface within `tolerance` diagonals, area within 5 tolerance
  std::vector<Violation> violations;  ///< all of the above that differ, in sentences; not those of check(HexMesh)
};
/// Compares topology, volume (within 3 tolerance) and features; `tolerance` is relative.
HexAgainstTets check_against(const HexMesh& hexes, const TetMesh& mesh, const Features& features,
                             double tolerance = 0.02);

}  // namespace hexfield
