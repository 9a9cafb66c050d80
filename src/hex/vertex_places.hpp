#pragma once

#include <vector>

#include "hexfield/hex/hex_mesh.hpp"
#include "hexfield/mesh/surface.hpp"

namespace hexfield::hex {

/// Where each hex vertex may go: anywhere, on the surface or curve of one colour, or nowhere.
class VertexPlaces {
 public:
  enum class Kind : char { free, surface, curve, fixed };

  /// Boundary faces of the tet mesh without a feature colour are one more surface, of colour `plain_boundary`.
  VertexPlaces(const HexMesh& hexes, const TetMesh& mesh, const Features& features);

  Kind kind(std::size_t v) const { return kinds_[v]; }
  /// The nearest allowed place to p.
  Vec3 project(std::size_t v, const Vec3& p) const;
  /// Projector onto the directions in which v can go from its place p.
  Mat3 tangent(std::size_t v, const Vec3& p) const;

 private:
  static constexpr int plain_boundary = -1;
  static Features with_boundary(const TetMesh& mesh, const Features& features);
  void find_surfaces(const HexMesh& hexes);
  void find_curves(const HexMesh& hexes);

  std::vector<Kind> kinds_;
  std::vector<int> colours_;
  ClosestSurface surfaces_;
  ClosestCurve curves_;
};

}  // namespace hexfield::hex
