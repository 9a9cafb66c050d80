#pragma once

#include <vector>

#include "exact.hpp"
#include "hexfield/map/corner_map.hpp"
#include "hexfield/mesh/tet_mesh.hpp"

namespace hexfield::hex {

/// A lattice point or the lowest corner of a unit cube.
using Lattice3 = std::array<std::int32_t, 3>;

/// R x + t on lattice points and, with t scaled, on fixed-point coordinates.
template <class Point>
Point rotate(octahedral::Rotation r, const Point& x) {
  Point y{};
  for (octahedral::Label axis = 0; axis < 3; ++axis) {
    const octahedral::Label to = octahedral::image(r, static_cast<octahedral::Label>(2 * axis));
    y[static_cast<std::size_t>(to / 2)] = (to & 1) != 0 ? -x[axis] : x[axis];
  }
  return y;
}

/// x -> rotation x + translation between two charts of an integer-grid map.
struct LatticeTransition {
  octahedral::Rotation rotation = octahedral::identity;
  Lattice3 translation{};

  Lattice3 point(const Lattice3& x) const {
    Lattice3 y = rotate(rotation, x);
    for (std::size_t i = 0; i < 3; ++i) y[i] += translation[i];
    return y;
  }
  /// Image of the unit cube with lowest corner x.
  Lattice3 cube(const Lattice3& x) const {
    const Lattice3 far = point({x[0] + 1, x[1] + 1, x[2] + 1});
    const Lattice3 near = point(x);
    return {std::min(near[0], far[0]), std::min(near[1], far[1]), std::min(near[2], far[2])};
  }
};

/// An integer-grid map in fixed point: everything the extraction decides, it decides on these integers.
struct FixedMap {
  int shift = 0;  ///< coordinates are multiples of 2^-shift
  std::vector<std::array<Fixed3, 4>> corners;
  std::vector<std::array<LatticeTransition, 4>> transitions;  ///< out of tet t across its face i
  std::vector<char> flat = {};                                ///< per tet: of no volume; empty: none is

  std::int64_t one() const { return std::int64_t{1} << shift; }
  bool is_flat(TetId t) const { return !flat.empty() && flat[t.index()] != 0; }
  const Fixed3& corner(TetId t, int i) const { return corners[t.index()][static_cast<std::size_t>(i)]; }
  const LatticeTransition& transition(HalfFaceId h) const {
    return transitions[h.tet().index()][static_cast<std::size_t>(h.local())];
  }
  Fixed3 fixed(const Lattice3& p) const { return {p[0] * one(), p[1] * one(), p[2] * one()}; }
};

/// The number of fractional bits such that coordinates up to `largest` keep 52 bits; -1 when they are too large.
int fixed_shift(double largest);

/// Exact when every coordinate is a multiple of 2^-shift and every transition is integer, as sanitise_igm()
/// leaves them; throws Error(bad_hex_mesh) otherwise, or tells the tets that are not in `wrong`.
FixedMap fixed_map(const TetMesh& mesh, const IntegerGridMap& map, std::vector<char>* wrong = nullptr);

/// The tets at each vertex, ascending.
struct VertexTets {
  std::vector<std::size_t> first;  ///< per vertex, and one more
  std::vector<TetId> tets;

  const TetId* begin(VertexId v) const { return tets.data() + first[v.index()]; }
  const TetId* end(VertexId v) const { return tets.data() + first[v.index() + 1]; }
};
VertexTets vertex_tets(const TetMesh& mesh);

}  // namespace hexfield::hex
