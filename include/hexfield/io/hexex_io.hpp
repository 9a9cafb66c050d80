#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "hexfield/map/corner_map.hpp"
#include "hexfield/mesh/features.hpp"
#include "hexfield/mesh/tet_mesh.hpp"

namespace hexfield {

/// A triangle of a motorcycle complex as a .hexex file lists it.
struct WallTriangle {
  std::array<VertexId, 3> vertices;
  double distance = 0;
};

/// A tet mesh with a map to parameter space from a .hexex file.
struct HexexInput {
  TetMesh mesh;
  Features features;                ///< colour 1 each: the format has no colours
  CornerMap map;                    ///< rationals rounded to the nearest double
  std::vector<WallTriangle> walls;  ///< empty when the file has none
  std::vector<TetId> turned;        ///< tets that were listed with negative volume; two corners were exchanged
  std::vector<TetId> flat;          ///< tets of no volume; the file is taken nevertheless
};

/// Reads a .hexex file: points; tets with 12 parameters (decimal or num/den); optionally walls; optionally
/// features. The rotations of the transitions are derived from the parameters (derive_rotations). All points
/// are kept. Error(bad_input) as in read_tet_mesh(). Not collective.
HexexInput read_hexex(const std::filesystem::path& file);

/// Rotation of every transition: over the 24 candidates the least sum over the face's edges of
/// |R df_t - df_j|, the first wins ties; so identical corners give the identity. Boundary: identity.
std::vector<std::array<octahedral::Rotation, 4>> derive_rotations(const TetMesh& mesh,
                                                                  const std::vector<std::array<Vec3, 4>>& uvw);

/// Writes mesh, map and features in that layout, numbers with 17 significant digits at most that read back
/// unchanged. Not collective.
void write_hexex(const std::filesystem::path& file, const TetMesh& mesh, const CornerMap& map,
                 const Features& features);

}  // namespace hexfield
