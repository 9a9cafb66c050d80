#include "cells.hpp"

#include <fmt/core.h>

#include <limits>

#include "hexfield/base/parallel.hpp"

namespace hexfield::hex {
namespace {

constexpr std::size_t grain = 512;

// Two pieces of one hex; `rotation` leads from the chart of the first to that of the second.
struct Link {
  std::int32_t from;
  std::int32_t to;
  octahedral::Rotation rotation;
};

// Union-find whose roots are the lowest members and that knows the rotation from each member to its parent.
class Pieces {
 public:
  explicit Pieces(std::size_t n) : parent_(n), rotation_(n, octahedral::identity) {
    for (std::size_t i = 0; i < n; ++i) parent_[i] = static_cast<std::int32_t>(i);
  }
  std::int32_t find(std::int32_t i, octahedral::Rotation& to_root) {
    to_root = octahedral::identity;
    std::int32_t root = i;
    while (parent_[static_cast<std::size_t>(root)] != root) {
      to_root = octahedral::product(rotation_[static_cast<std::size_t>(root)], to_root);
      root = parent_[static_cast<std::size_t>(root)];
    }
    octahedral::Rotation rest = to_root;
    while (i != root) {
      const auto k = static_cast<std::size_t>(i);
      const std::int32_t next = parent_[k];
      const octahedral::Rotation after = octahedral::product(rest, octahedral::inverse(rotation_[k]));
      parent_[k] = root;
      rotation_[k] = rest;
      rest = after;
      i = next;
    }
    return root;
  }
  // Itself for a root.
  std::int32_t parent(std::size_t i, octahedral::Rotation& to_parent) const {
    to_parent = rotation_[i];
    return parent_[i];
  }
  // False when the two are joined already by another rotation.
  bool join(const Link& link) {
    octahedral::Rotation a = 0;
    octahedral::Rotation b = 0;
    const std::int32_t from = find(link.from, a);
    const std::int32_t to = find(link.to, b);
    // chart of `from` root -> link.from -> link.to -> chart of `to` root
    const octahedral::Rotation across =
        octahedral::product(b, octahedral::product(link.rotation, octahedral::inverse(a)));
    if (from == to) return across == octahedral::identity;
    if (to < from) {
      parent_[static_cast<std::size_t>(from)] = to;
      rotation_[static_cast<std::size_t>(from)] = across;
    } else {
      parent_[static_cast<std::size_t>(to)] = from;
      rotation_[static_cast<std::size_t>(to)] = octahedral::inverse(across);
    }
    return true;
  }

 private:
  std::vector<std::int32_t> parent_;
  std::vector<octahedral::Rotation> rotation_;
};

[[noreturn]] void fail(const TetMesh& mesh, TetId t, const std::string& why) {
  throw Error(ExitCode::bad_hex_mesh, fmt::format("Tet {}: {}", t.value, why), {t.value}, {centroid(mesh, t)});
}

// Items of one tet of which many have a row in common, one after the other.
class RowFinder {
 public:
  RowFinder(const RowTable& table, TetId t) : table_(table), tet_(t) {}
  std::int64_t item(const Lattice3& x) {
    if (!known_ || x[1] != y_ || x[2] != z_) {
      row_ = table_.find(tet_, x[1], x[2]);
      y_ = x[1], z_ = x[2], known_ = true;
    }
    return row_ != nullptr && x[0] >= row_->begin && x[0] < row_->end ? row_->first + (x[0] - row_->begin) : -1;
  }

 private:
  const RowTable& table_;
  TetId tet_;
  const Row* row_ = nullptr;
  std::int32_t y_ = 0, z_ = 0;
  bool known_ = false;
};

std::vector<std::vector<Link>> find_links(const TetMesh& mesh, const FixedMap& map, const RowTable& pieces) {
  const std::size_t n = mesh.num_tets();
  std::vector<std::vector<Link>> links((n + grain - 1) / grain);
  parallel_for(n, grain, [&](std::size_t begin, std::size_t end) {
    std::vector<Link>& out = links[begin / grain];
    for (std::size_t k = begin; k < end; ++k)
      for (int i = 0; i < 4; ++i) {
        const TetId t(k);
        const HalfFaceId h(t, i);
        const HalfFaceId o = mesh.opposite_half_face(h);
        if (!o.valid() || o < h) continue;
        const auto& v = tet_face_vertices[static_cast<std::size_t>(i)];
        const LatticeTransition& transition = map.transition(h);
        cubes_of_triangle(map, {map.corner(t, v[0]), map.corner(t, v[1]), map.corner(t, v[2])})
            .for_each_row([&](std::int32_t y, std::int32_t z, std::int32_t first, std::int32_t last) {
              RowFinder here(pieces, t);
              RowFinder there(pieces, o.tet());
              for (std::int32_t x = first; x < last; ++x) {
                const Lattice3 cube{x, y, z};
                out.push_back({static_cast<std::int32_t>(here.item(cube)),
                               static_cast<std::int32_t>(there.item(transition.cube(cube))), transition.rotation});
              }
            });
      }
  });
  return links;
}

// Pieces at open faces.
std::vector<char> open_pieces(const TetMesh& mesh, const FixedMap& map, const RowTable& pieces,
                              const std::vector<char>* open) {
  std::vector<char> touched(open == nullptr ? 0 : static_cast<std::size_t>(pieces.size), 0);
  if (open == nullptr) return touched;
  for (std::size_t i = 0; i < 4 * mesh.num_tets(); ++i) {
    if ((*open)[i] == 0) continue;
    const HalfFaceId h{static_cast<std::int64_t>(i)};
    cubes_of_triangle(map, corners_of_face(map, h))
        .for_each_row([&](std::int32_t y, std::int32_t z, std::int32_t first, std::int32_t last) {
          for (std::int32_t x = first; x < last; ++x) {
            const std::int64_t piece = pieces.item(h.tet(), {x, y, z});
            if (piece >= 0) touched[static_cast<std::size_t>(piece)] = 1;
          }
        });
  }
  return touched;
}

void number_cells(const TetMesh& mesh, const FixedMap& map, const std::vector<char>* open, Cells& cells) {
  const auto n = static_cast<std::size_t>(cells.pieces.size);
  std::vector<char> touched = open_pieces(mesh, map, cells.pieces, open);
  Pieces pieces(n);
  for (const auto& part : find_links(mesh, map, cells.pieces))
    for (const Link& link : part) {
      require(link.from >= 0 && link.to >= 0, "A cube met by a face of a tet is not met by the tet.");
      if (pieces.join(link)) continue;
      if (open != nullptr)
        touched[static_cast<std::size_t>(link.from)] = 1;
      else
        fail(mesh, cells.tet(static_cast<std::size_t>(link.from)), "a cube of the integer-grid map turns into itself.");
    }
  cells.cell.resize(n);
  cells.to_cell.assign(n, octahedral::identity);
  octahedral::Rotation unused = 0;
  for (std::size_t p = 0; p < touched.size(); ++p)
    if (touched[p] != 0) touched[static_cast<std::size_t>(pieces.find(static_cast<std::int32_t>(p), unused))] = 1;
  // Parents come before their children.
  for (std::size_t p = 0; p < n; ++p) {
    octahedral::Rotation to_parent = octahedral::identity;
    const auto parent = static_cast<std::size_t>(pieces.parent(p, to_parent));
    if (parent != p) {
      cells.cell[p] = cells.cell[parent];
      cells.to_cell[p] = octahedral::product(cells.to_cell[parent], to_parent);
    } else if (!touched.empty() && touched[p] != 0) {
      cells.cell[p] = -1;
    } else {
      cells.cell[p] = static_cast<std::int32_t>(cells.root.size());
      cells.root.push_back(static_cast<std::int32_t>(p));
    }
  }
}

// The pieces of each hex, ascending.
std::vector<std::int32_t> group_pieces(const Cells& cells, std::vector<std::size_t>& first) {
  first.assign(cells.root.size() + 1, 0);
  for (std::int32_t c : cells.cell)
    if (c >= 0) ++first[static_cast<std::size_t>(c) + 1];
  for (std::size_t c = 0; c < cells.root.size(); ++c) first[c + 1] += first[c];
  std::vector<std::int32_t> members(cells.cell.size());
  std::vector<std::size_t> next(first.begin(), first.end() - 1);
  for (std::size_t p = 0; p < cells.cell.size(); ++p)
    if (cells.cell[p] >= 0) members[next[static_cast<std::size_t>(cells.cell[p])]++] = static_cast<std::int32_t>(p);
  return members;
}

// The four rows of lattice points at the corners of a row of cubes.
struct CornerRows {
  std::int32_t of = -1;
  std::array<const Row*, 4> rows{};
};

// Corner vertices that the tet of a piece holds; false on a contradiction.
bool add_corners(const Cells& cells, const LatticeVertices& vertices, std::size_t piece, CornerRows& near,
                 std::array<std::int32_t, 8>& corners) {
  const std::int32_t row_index = cells.piece_row[piece];
  const Row& row = cells.pieces.rows[static_cast<std::size_t>(row_index)];
  if (near.of != row_index) {
    near.of = row_index;
    for (std::int32_t k = 0; k < 4; ++k)
      near.rows[static_cast<std::size_t>(k)] = vertices.points.find(row.tet, row.y + (k & 1), row.z + (k >> 1));
  }
  const std::int32_t x = cells.cube(piece)[0];
  bool good = true;
  for (std::uint8_t bits = 0; bits < 8; ++bits) {
    const Row* points = near.rows[bits >> 1U];
    const std::int32_t at = x + (bits & 1);
    if (points == nullptr || at < points->begin || at >= points->end) continue;
    const std::int32_t vertex = vertices.ids[static_cast<std::size_t>(points->first + (at - points->begin))];
    std::int32_t& slot = corners[rotate_corner(cells.to_cell[piece], bits)];
    good = good && (slot < 0 || slot == vertex);
    slot = vertex;
  }
  return good;
}

void drop_cells(const std::vector<char>& bad, Cells& cells) {
  std::vector<std::int32_t> number(bad.size(), -1);
  std::int32_t kept = 0;
  for (std::size_t c = 0; c < bad.size(); ++c) {
    if (bad[c] != 0) continue;
    cells.root[static_cast<std::size_t>(kept)] = cells.root[c];
    cells.corners[static_cast<std::size_t>(kept)] = cells.corners[c];
    number[c] = kept++;
  }
  cells.root.resize(static_cast<std::size_t>(kept));
  cells.corners.resize(static_cast<std::size_t>(kept));
  for (std::int32_t& c : cells.cell)
    if (c >= 0) c = number[static_cast<std::size_t>(c)];
}

void find_corners(const TetMesh& mesh, const LatticeVertices& vertices, bool tolerant, Cells& cells) {
  std::vector<std::size_t> first;
  const std::vector<std::int32_t> members = group_pieces(cells, first);
  cells.corners.assign(cells.root.size(), {-1, -1, -1, -1, -1, -1, -1, -1});
  std::vector<char> bad(cells.root.size(), 0);
  parallel_for(cells.root.size(), 1024, [&](std::size_t begin, std::size_t end) {
    CornerRows near;
    for (std::size_t c = begin; c < end; ++c) {
      bool good = true;
      for (std::size_t m = first[c]; m < first[c + 1]; ++m)
        good = add_corners(cells, vertices, static_cast<std::size_t>(members[m]), near, cells.corners[c]) && good;
      for (std::int32_t vertex : cells.corners[c]) good = good && vertex >= 0;
      bad[c] = !good;
    }
  });
  if (tolerant) return drop_cells(bad, cells);
  for (std::size_t c = 0; c < bad.size(); ++c)
    if (bad[c] != 0) {
      const auto piece = static_cast<std::size_t>(cells.root[c]);
      const Lattice3 cube = cells.cube(piece);
      fail(mesh, cells.tet(piece),
           fmt::format("cube ({}, {}, {}) of its chart has not exactly eight corners.", cube[0], cube[1], cube[2]));
    }
}

}  // namespace

const std::array<std::array<std::uint8_t, 8>, octahedral::order> corner_rotations = [] {
  std::array<std::array<std::uint8_t, 8>, octahedral::order> t{};
  for (octahedral::Rotation rotation = 0; rotation < octahedral::order; ++rotation)
    for (std::uint8_t b = 0; b < 8; ++b) {
      const Lattice3 centred{(b & 1) * 2 - 1, (b >> 1 & 1) * 2 - 1, (b >> 2 & 1) * 2 - 1};
      const Lattice3 image = rotate(rotation, centred);
      t[rotation][b] =
          static_cast<std::uint8_t>((image[0] > 0 ? 1 : 0) | (image[1] > 0 ? 2 : 0) | (image[2] > 0 ? 4 : 0));
    }
  return t;
}();

std::optional<std::array<int, 2>> edge_vertices(const Cells& cells, TetId t, std::size_t axis, const Lattice3& from) {
  for (unsigned quadrant = 0; quadrant < 4; ++quadrant) {
    Lattice3 cube = from;
    std::uint8_t low = 0;
    for (unsigned k = 0; k < 2; ++k)
      if ((quadrant >> k & 1U) != 0) {
        const std::size_t a = (axis + 1 + k) % 3;
        --cube[a];
        low = static_cast<std::uint8_t>(low | 1U << a);
      }
    const std::int64_t piece = cells.pieces.item(t, cube);
    if (piece < 0 || cells.cell[static_cast<std::size_t>(piece)] < 0) continue;
    const auto p = static_cast<std::size_t>(piece);
    const auto& corners = cells.corners[static_cast<std::size_t>(cells.cell[p])];
    const auto high = static_cast<std::uint8_t>(low | 1U << axis);
    return std::array<int, 2>{corners[rotate_corner(cells.to_cell[p], low)],
                              corners[rotate_corner(cells.to_cell[p], high)]};
  }
  return std::nullopt;
}

std::int64_t side_of_cube(const Cells& cells, TetId t, const Lattice3& cube, octahedral::Label outward) {
  const std::int64_t piece = cells.pieces.item(t, cube);
  require(piece >= 0, "A cube beside a lattice triangle is not met by its tet.");
  const auto p = static_cast<std::size_t>(piece);
  if (cells.cell[p] < 0) return no_side;
  return 6 * static_cast<std::int64_t>(cells.cell[p]) + octahedral::image(cells.to_cell[p], outward);
}

std::array<int, 4> side_vertices(const Cells& cells, std::int64_t side) {
  const auto& corners = cells.corners[static_cast<std::size_t>(side / 6)];
  const auto label = static_cast<unsigned>(side % 6);
  const unsigned axis = label / 2;
  const unsigned u = 1U << (axis + 1) % 3;
  const unsigned v = 1U << (axis + 2) % 3;
  const unsigned base = (label & 1U) != 0 ? 0 : 1U << axis;
  std::array<int, 4> quad{corners[base], corners[base + u], corners[base + u + v], corners[base + v]};
  if ((label & 1U) != 0) std::swap(quad[1], quad[3]);
  return quad;
}

Cells find_cells(const TetMesh& mesh, const FixedMap& map, const LatticeVertices& vertices,
                 const std::vector<char>* open) {
  Cells cells;
  cells.pieces = rasterise_cubes(map);
  if (cells.pieces.size > std::numeric_limits<std::int32_t>::max())
    throw Error(ExitCode::bad_hex_mesh,
                fmt::format("The integer-grid map has {} pieces of hexes, more than 2^31.", cells.pieces.size));
  cells.piece_row.resize(static_cast<std::size_t>(cells.pieces.size));
  const auto& rows = cells.pieces.rows;
  parallel_for(rows.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r)
      for (std::int64_t i = 0; i < rows[r].end - rows[r].begin; ++i)
        cells.piece_row[static_cast<std::size_t>(rows[r].first + i)] = static_cast<std::int32_t>(r);
  });
  number_cells(mesh, map, open, cells);
  find_corners(mesh, vertices, open != nullptr, cells);
  return cells;
}

}  // namespace hexfield::hex
