#pragma once

#include <cmath>

#include "hexfield/field/frame_field.hpp"
#include "hexfield/field/matchings.hpp"
#include "hexfield/mesh/tet_mesh.hpp"

namespace hexfield::testing {

/// n tets around the edge from vertex 0 (origin) to vertex 1 (0, 0, 1), from angle 0 to `degrees`
/// counter-clockwise; closed when that is 360. Tet k lies between the spokes k and k + 1.
inline TetMesh fan(int n, double degrees) {
  std::vector<Vec3> points{Vec3(0, 0, 0), Vec3(0, 0, 1)};
  const bool closed = degrees >= 360;
  const int spokes = closed ? n : n + 1;
  for (int k = 0; k < spokes; ++k) {
    const double a = k * degrees / n * M_PI / 180;
    points.emplace_back(std::cos(a), std::sin(a), 0.5);
  }
  std::vector<std::array<VertexId, 4>> tets;
  for (int k = 0; k < n; ++k) {
    const int next = closed ? (k + 1) % n : k + 1;
    tets.push_back({VertexId(0), VertexId(1), VertexId(2 + k), VertexId(2 + next)});
  }
  TetMesh mesh = build_tet_mesh(points, tets);
  if (signed_volume6(mesh, TetId(0)) < 0) {
    for (auto& t : tets) std::swap(t[2], t[3]);
    mesh = build_tet_mesh(points, tets);
  }
  return mesh;
}

/// Frames R_z(k turn / n) in tet k with closest matchings.
inline FrameField turning_field(const TetMesh& mesh, int n, double turn_degrees) {
  FrameField field;
  for (int k = 0; k < n; ++k)
    field.frames.emplace_back(Eigen::AngleAxisd(k * turn_degrees / n * M_PI / 180, Vec3::UnitZ()));
  compute_matchings(mesh, field);
  return field;
}

}  // namespace hexfield::testing
