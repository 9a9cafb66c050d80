#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "lattice_vertices.hpp"

namespace hexfield::hex {

/// Bits (x, y, z) of the eight corners of a cube in the order of a VTK hexahedron.
inline constexpr std::array<std::uint8_t, 8> vtk_corner_bits = {0, 1, 3, 2, 4, 5, 7, 6};

/// The hexes of a map. The open unit cubes of the charts fall into pieces, one per (tet, cube) that meet;
/// pieces that touch across the inside of a mesh face belong to one hex. In a valid integer-grid map all
/// singularities, features and the boundary lie on lattice planes, so each such component is isometric to
/// an open unit cube: it is exactly one hex, whatever the charts, and has no holonomy.
struct Cells {
  RowTable pieces;
  std::vector<std::int32_t> piece_row;               ///< row of `pieces.rows` per piece
  std::vector<std::int32_t> cell;                    ///< hex per piece; -1: of none (see find_cells)
  std::vector<octahedral::Rotation> to_cell;         ///< rotation from the piece's chart to that of its hex
  std::vector<std::int32_t> root;                    ///< lowest piece per hex; its chart is the chart of the hex
  std::vector<std::array<std::int32_t, 8>> corners;  ///< hex vertex per hex and corner bits (x + 2 y + 4 z)

  Lattice3 cube(std::size_t piece) const {
    const Row& row = pieces.rows[static_cast<std::size_t>(piece_row[piece])];
    return {row.begin + static_cast<std::int32_t>(static_cast<std::int64_t>(piece) - row.first), row.y, row.z};
  }
  TetId tet(std::size_t piece) const { return pieces.rows[static_cast<std::size_t>(piece_row[piece])].tet; }
};

/// Corner bits of a cube after its rotation about its centre, by rotation and bits.
extern const std::array<std::array<std::uint8_t, 8>, octahedral::order> corner_rotations;
inline std::uint8_t rotate_corner(octahedral::Rotation r, std::uint8_t bits) { return corner_rotations[r][bits]; }

/// The ends of the hex edge that runs from lattice point `from` of tet t's chart along +axis, found through any piece
/// of the tet that touches it; nullopt when there is none that belongs to a hex.
std::optional<std::array<int, 2>> edge_vertices(const Cells& cells, TetId t, std::size_t axis, const Lattice3& from);

/// A side of a hex: 6 * hex + outward label in the chart of the hex.
inline constexpr std::int64_t no_side = std::numeric_limits<std::int64_t>::max();
/// The side of the cube of tet t's chart in a direction of that chart; no_side when the cube is no hex.
std::int64_t side_of_cube(const Cells& cells, TetId t, const Lattice3& cube, octahedral::Label outward);
/// Counter-clockwise seen from outside the hex.
std::array<int, 4> side_vertices(const Cells& cells, std::int64_t side);

/// Throws Error(bad_hex_mesh) naming tets where the map does not make whole hexes. With `open` (per half-face:
/// another tet belongs there, but is missing) cubes that meet an open face, turn into themselves or lack a corner are
/// no hexes instead; their pieces have cell -1.
Cells find_cells(const TetMesh& mesh, const FixedMap& map, const LatticeVertices& vertices,
                 const std::vector<char>* open = nullptr);

}  // namespace hexfield::hex
