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

  /// Every vertex may go anywhere.
  explicit VertexPlaces(std::size_t vertices);

  Kind kind(std::size_t v) const { return kinds_[v]; }
  /// The nearest allowed place to p.
  Vec3 project(std::size_t v, const Vec3& p) const;
  /// Projector onto the directions in which v can go from its place p.
  Mat3 tangent(std::size_t v, const Vec3& p) const;
  /// Largest distance of a side's centre or a line's middle at v from its surface or curve, with v at p. Sides
  /// and lines are chords: this is how far they cut through a curved shape. 0 for free vertices.
  double chord_error(std::size_t v, const Vec3& p, const std::vector<Vec3>& points) const;
  /// Chord errors up to this length are harmless.
  double small_chord_error() const { return 1e-3 * diagonal_; }

 private:
  // A feature side or line; lines repeat nothing: the last two vertices are -1.
  struct Chord {
    std::array<int, 4> vertices;
    int colour;
  };
  void link_chords(const HexMesh& hexes);

  static constexpr int plain_boundary = -1;
  static Features with_boundary(const TetMesh& mesh, const Features& features);
  void find_surfaces(const HexMesh& hexes);
  void find_curves(const HexMesh& hexes);

  std::vector<Kind> kinds_;
  std::vector<int> colours_;
  std::vector<Chord> chords_;
  std::vector<std::size_t> first_chord_;  ///< into chords_at_, per vertex
  std::vector<std::int32_t> chords_at_;
  double diagonal_ = 0;
  ClosestSurface surfaces_;
  ClosestCurve curves_;
};

}  // namespace hexfield::hex
