#pragma once

#include <functional>
#include <vector>

#include "fixed_map.hpp"

namespace hexfield::hex {

/// The lattice points or unit cubes (y, z fixed, x in [begin, end)) of one tet: items first .. first + end - begin.
struct Row {
  std::int32_t y = 0;
  std::int32_t z = 0;
  std::int32_t begin = 0;
  std::int32_t end = 0;
  TetId tet;
  /// Of rows of points: on which faces of the tet (bit i: opposite vertex i) the first and last point lie.
  std::uint8_t first_mask = 0;
  std::uint8_t last_mask = 0;
  std::int64_t first = 0;
};

/// Rows of all tets, sorted by tet, then z, then y.
struct RowTable {
  std::vector<Row> rows;
  std::vector<std::size_t> tet_rows;  ///< first row per tet, and one more
  /// Per tet its first layer, and one more; first row per layer of one z, without gaps in z, and one more.
  std::vector<std::size_t> tet_layers, layers;
  std::int64_t size = 0;  ///< number of items

  /// The row of tet t at (y, z), or nullptr.
  const Row* find(TetId t, std::int32_t y, std::int32_t z) const;
  /// Index of the item, or -1.
  std::int64_t item(TetId t, const Lattice3& x) const {
    const Row* row = find(t, x[1], x[2]);
    return row != nullptr && x[0] >= row->begin && x[0] < row->end ? row->first + (x[0] - row->begin) : -1;
  }
};

/// A convex set of lattice items: all with lowest corner in [low, high] that satisfy every half-space.
struct ConvexItems {
  enum class Kind {
    points,  ///< lattice points in the closed half-spaces
    cubes,   ///< open unit cubes that meet every open half-space
  };
  Kind kind = Kind::cubes;
  std::int64_t one = 1;
  Lattice3 low{};
  Lattice3 high{};
  std::array<HalfSpace, 20> half_spaces{};
  std::size_t count = 0;

  void add(const HalfSpace& h) { half_spaces[count++] = h; }
  bool contains(const Lattice3& x) const;
  /// Calls row(y, z, begin, end) for all non-empty rows, z outermost, both ascending.
  void for_each_row(const std::function<void(std::int32_t, std::int32_t, std::int32_t, std::int32_t)>& row) const;
};

/// The unit cubes whose interior meets the interior of the tet. By the separating-axis theorem for two convex
/// polytopes: bounding box, the four faces, and the silhouettes along the three axes.
ConvexItems cubes_of_tet(const FixedMap& map, TetId t);
/// The unit cubes whose interior meets the triangle (corners in one chart).
ConvexItems cubes_of_triangle(const FixedMap& map, const std::array<Fixed3, 3>& corners);
/// Of the four faces of a positive tet, towards its inside.
std::array<HalfSpace, 4> inner_half_spaces(const std::array<Fixed3, 4>& corners);
/// The lattice points in the closed tet.
ConvexItems points_of_tet(const FixedMap& map, TetId t);
/// The lattice points in the closed triangle, which may be a segment or a point.
ConvexItems points_of_triangle(const FixedMap& map, const std::array<Fixed3, 3>& corners);
std::array<Fixed3, 3> corners_of_face(const FixedMap& map, HalfFaceId h);
/// The unit cubes next to the triangle, which lies in the lattice plane x[axis] = plane: those on the `above`
/// side whose face in that plane overlaps the triangle.
ConvexItems cubes_beside_triangle(const FixedMap& map, const std::array<Fixed3, 3>& corners, std::size_t axis,
                                  bool above);

/// Faces of tet t that hold the lattice point x of the closed tet, as a bit mask.
std::uint8_t carrier_mask(const ConvexItems& points, const Lattice3& x, std::int64_t one);

/// Of a flat tet: the cubes and points of its four faces. Rows of points of flat tets have no masks.
RowTable rasterise_cubes(const FixedMap& map);
RowTable rasterise_points(const FixedMap& map);

}  // namespace hexfield::hex
