#include "carry_features.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <optional>

#include "hexfield/base/parallel.hpp"

namespace hexfield::hex {
namespace {

constexpr std::size_t grain = 1024;

// One side of a hex that lies on a mesh triangle.
struct Side {
  std::int64_t slot;  ///< 6 * hex + outward label in the chart of the hex; the lower one of an interior side
  int border;         ///< 0 when the triangle holds the centre of the side, else 1
  int colour;
};

HalfFaceId find_face(const TetMesh& mesh, const VertexTets& star, const FaceKey& face) {
  for (const TetId* t = star.begin(face[0]); t != star.end(face[0]); ++t)
    for (int i = 0; i < 4; ++i)
      if (mesh.key(HalfFaceId(*t, i)) == face) return HalfFaceId(*t, i);
  return HalfFaceId();
}

[[noreturn]] void fail(const std::string& what, std::vector<std::int64_t> ids, std::vector<Vec3> places) {
  throw Error(ExitCode::bad_hex_mesh, what, std::move(ids), std::move(places));
}

class Carrier {
 public:
  Carrier(const TetMesh& mesh, const Features& features, const FixedMap& map, const VertexTets& star,
          const LatticeVertices& vertices, const Cells& cells, HexMesh& out, bool partial)
      : mesh_(mesh),
        features_(features),
        map_(map),
        star_(star),
        vertices_(vertices),
        cells_(cells),
        out_(out),
        partial_(partial) {}

  void points();
  void lines();
  void quads();
  void boundary();

 private:
  std::array<std::size_t, 2> plane_of(HalfFaceId h) const;
  std::array<Fixed3, 3> corners_of(HalfFaceId h) const;
  std::vector<HalfFaceId> behind(HalfFaceId h) const;
  std::int64_t slot(TetId t, const Lattice3& cube, octahedral::Label outward) const {
    return side_of_cube(cells_, t, cube, outward);
  }
  template <class Body>
  void for_each_square(HalfFaceId h, const Body& body) const;
  bool holds_centre(HalfFaceId h, std::size_t axis, const Lattice3& cube) const;
  std::optional<HexMesh::Line> line_at(TetId t, std::size_t axis, const Lattice3& from, int colour) const;
  void edge_lines(const EdgeKey& edge, int colour);
  bool owns_midpoint(VertexId v, const EdgeKey& edge, int colour) const;

  const TetMesh& mesh_;
  const Features& features_;
  const FixedMap& map_;
  const VertexTets& star_;
  const LatticeVertices& vertices_;
  const Cells& cells_;
  HexMesh& out_;
  bool partial_;
};

void Carrier::points() {
  for (const auto& [v, colour] : features_.points) {
    const std::int32_t vertex = vertices_.at_mesh_vertex[v.index()];
    if (vertex < 0 && partial_) continue;
    if (vertex < 0)
      fail(fmt::format("Feature vertex {} is not on a lattice point of the integer-grid map.", v.value), {v.value},
           {mesh_.point(v)});
    out_.feature_points.push_back({vertex, colour});
  }
}

std::array<Fixed3, 3> Carrier::corners_of(HalfFaceId h) const { return corners_of_face(map_, h); }

// What lies on the boundary where half-face h does: itself, or the faces behind it when its tet is flat.
std::vector<HalfFaceId> Carrier::behind(HalfFaceId h) const {
  if (!map_.is_flat(h.tet())) return {h};
  std::vector<HalfFaceId> faces;
  const std::size_t axis = plane_of(h)[0];
  const auto area = [&](HalfFaceId face) {
    const auto c = corners_of(face);
    return exact_cross(minus(c[1], c[0]), minus(c[2], c[0]))[axis];
  };
  if (area(h) == 0) return faces;  // all of the boundary is behind another face
  for (int i = 0; i < 4; ++i) {
    const HalfFaceId inner(h.tet(), i);
    const HalfFaceId o = mesh_.opposite_half_face(inner);
    if (o.valid() && !map_.is_flat(o.tet()) && area(inner) != 0) faces.push_back(o);
  }
  return faces;
}

// The axis normal to an aligned face, and whether its tet lies above it.
std::array<std::size_t, 2> Carrier::plane_of(HalfFaceId h) const {
  const auto c = corners_of(h);
  for (std::size_t a = 0; a < 3; ++a)
    if (c[0][a] == c[1][a] && c[0][a] == c[2][a] && c[0][a] % map_.one() == 0)
      return {a, map_.corner(h.tet(), h.local())[a] > c[0][a] ? 1U : 0U};
  const auto v = mesh_.face_vertices(h);
  fail(fmt::format("The {} face ({}, {}, {}) of tet {} is not on a lattice plane of the integer-grid map.",
                   mesh_.is_boundary(h) ? "boundary" : "feature", v[0].value, v[1].value, v[2].value, h.tet().value),
       {h.tet().value}, {mesh_.point(v[0]), mesh_.point(v[1]), mesh_.point(v[2])});
}

// body(cube, slot) for every unit square of the aligned face that the triangle overlaps.
template <class Body>
void Carrier::for_each_square(HalfFaceId h, const Body& body) const {
  const auto [axis, above] = plane_of(h);
  const auto outward = static_cast<octahedral::Label>(2 * axis + above);
  cubes_beside_triangle(map_, corners_of(h), axis, above != 0)
      .for_each_row([&](std::int32_t y, std::int32_t z, std::int32_t begin, std::int32_t end) {
        for (std::int32_t x = begin; x < end; ++x) body(Lattice3{x, y, z}, slot(h.tet(), {x, y, z}, outward));
      });
}

// Whether the closed triangle has the centre of the cube's side in its plane.
bool Carrier::holds_centre(HalfFaceId h, std::size_t axis, const Lattice3& cube) const {
  const auto c = corners_of(h);
  Fixed3 centre = map_.fixed(cube);
  for (std::size_t a = 0; a < 3; ++a) centre[a] = a == axis ? c[0][a] : centre[a] + map_.one() / 2;
  Fixed3 along{};
  along[axis] = 1;
  int lowest = 0;
  int highest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const int side = HalfSpace(exact_cross(along, minus(c[(k + 1) % 3], c[k])), c[k]).side(centre);
    lowest = std::min(lowest, side);
    highest = std::max(highest, side);
  }
  return lowest == 0 || highest == 0;
}

void Carrier::quads() {
  std::vector<std::pair<HalfFaceId, int>> faces;
  for (const auto& [key, colour] : features_.faces) {
    const HalfFaceId h = find_face(mesh_, star_, key);
    if (!h.valid() && partial_) continue;
    if (!h.valid())
      fail(fmt::format("The feature triangle ({}, {}, {}) is not a face of the mesh.", key[0].value, key[1].value,
                       key[2].value),
           {key[0].value, key[1].value, key[2].value}, {mesh_.point(key[0])});
    const HalfFaceId o = mesh_.opposite_half_face(h);
    if (map_.is_flat(h.tet()) && o.valid() && !map_.is_flat(o.tet()))
      faces.emplace_back(o, colour);
    else if (!o.valid() && map_.is_flat(h.tet()))
      for (HalfFaceId face : behind(h)) faces.emplace_back(face, colour);
    else
      faces.emplace_back(h, colour);
  }
  std::vector<std::vector<Side>> parts((faces.size() + grain - 1) / grain);
  parallel_for(faces.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const HalfFaceId h = faces[f].first;
      const HalfFaceId o = mesh_.opposite_half_face(h);
      const auto [axis, above] = plane_of(h);
      for_each_square(h, [&, axis = axis, above = above](const Lattice3& beside, std::int64_t here) {
        if (o.valid() && !map_.is_flat(o.tet())) {
          Lattice3 cube = beside;
          cube[axis] += above != 0 ? -1 : 1;
          const LatticeTransition& transition = map_.transition(h);
          const auto inward = static_cast<octahedral::Label>(2 * axis + (above != 0 ? 0 : 1));
          here = std::min(here, slot(o.tet(), transition.cube(cube), octahedral::image(transition.rotation, inward)));
        }
        parts[begin / grain].push_back({here, holds_centre(h, axis, beside) ? 0 : 1, faces[f].second});
      });
    }
  });
  std::vector<Side> sides;
  for (const auto& part : parts) sides.insert(sides.end(), part.begin(), part.end());
  // A side may overlap two colours where their border is no feature line: it takes that of its centre.
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.slot, a.border, a.colour) < std::tie(b.slot, b.border, b.colour);
  });
  for (std::size_t k = 0; k < sides.size(); ++k)
    if (sides[k].slot != no_side && (k == 0 || sides[k].slot != sides[k - 1].slot))
      out_.feature_quads.push_back({side_vertices(cells_, sides[k].slot), sides[k].colour});
}

// The hex edge from lattice point `from` along +axis.
std::optional<HexMesh::Line> Carrier::line_at(TetId t, std::size_t axis, const Lattice3& from, int colour) const {
  if (const auto ends = edge_vertices(cells_, t, axis, from)) return HexMesh::Line{*ends, colour};
  if (partial_) return std::nullopt;
  fail(fmt::format("Tet {}: no hex at its feature edge.", t.value), {t.value}, {centroid(mesh_, t)});
}

// A unit segment whose midpoint is the mesh vertex v is shared by two feature edges; the lower one takes it.
bool Carrier::owns_midpoint(VertexId v, const EdgeKey& edge, int colour) const {
  EdgeKey lowest = edge;
  for (const TetId* t = star_.begin(v); t != star_.end(v); ++t)
    for (VertexId w : mesh_.vertices(*t)) {
      if (w == v) continue;
      const EdgeKey key = edge_key(v, w);
      const auto found = features_.edges.find(key);
      if (found != features_.edges.end() && found->second == colour) lowest = std::min(lowest, key);
    }
  return lowest == edge;
}

void Carrier::edge_lines(const EdgeKey& edge, int colour) {
  const TetId* t = star_.begin(edge[0]);
  while (t != star_.end(edge[0]) && (!mesh_.has_vertex(*t, edge[1]) || map_.is_flat(*t))) ++t;
  if (t == star_.end(edge[0]) && partial_) return;
  if (t == star_.end(edge[0]))
    fail(fmt::format("The feature line ({}, {}) is not an edge of the mesh.", edge[0].value, edge[1].value),
         {edge[0].value, edge[1].value}, {mesh_.point(edge[0]), mesh_.point(edge[1])});
  const Fixed3& a = map_.corner(*t, mesh_.local_index(*t, edge[0]));
  const Fixed3& b = map_.corner(*t, mesh_.local_index(*t, edge[1]));
  const std::int64_t one = map_.one();
  std::size_t axis = 3;
  int fixed = 0;
  for (std::size_t k = 0; k < 3; ++k)
    if (a[k] == b[k] && a[k] % one == 0)
      ++fixed;
    else
      axis = k;
  if (fixed != 2)
    fail(fmt::format("The feature edge ({}, {}) is not on a lattice line of the integer-grid map.", edge[0].value,
                     edge[1].value),
         {edge[0].value, edge[1].value}, {mesh_.point(edge[0]), mesh_.point(edge[1])});
  const bool up = a[axis] < b[axis];
  const std::int64_t low = up ? a[axis] : b[axis];
  const std::int64_t high = up ? b[axis] : a[axis];
  // Unit segments whose midpoint lies on the edge.
  Lattice3 from{static_cast<std::int32_t>(a[0] / one), static_cast<std::int32_t>(a[1] / one),
                static_cast<std::int32_t>(a[2] / one)};
  const auto floor_div = [one](std::int64_t x) { return x >= 0 ? x / one : -((-x + one - 1) / one); };
  for (std::int64_t x = floor_div(low - one / 2); x * one + one / 2 <= high; ++x) {
    const std::int64_t middle = x * one + one / 2;
    if (middle < low) continue;
    if (middle == low && !owns_midpoint(up ? edge[0] : edge[1], edge, colour)) continue;
    if (middle == high && !owns_midpoint(up ? edge[1] : edge[0], edge, colour)) continue;
    from[axis] = static_cast<std::int32_t>(x);
    if (const auto line = line_at(*t, axis, from, colour)) out_.feature_lines.push_back(*line);
  }
}

void Carrier::lines() {
  for (const auto& [edge, colour] : features_.edges) edge_lines(edge, colour);
}

// Each boundary side once, and as many as the area of the boundary in the map.
void Carrier::boundary() {
  const std::size_t n = mesh_.num_tets();
  struct Part {
    std::vector<std::int64_t> slots;
    Wide area2 = 0;
  };
  std::vector<Part> parts((n + grain - 1) / grain);
  parallel_for(n, grain, [&](std::size_t begin, std::size_t end) {
    Part& part = parts[begin / grain];
    for (std::size_t k = 4 * begin; k < 4 * end; ++k) {
      const HalfFaceId h(static_cast<std::int64_t>(k));
      if (!mesh_.is_boundary(h)) continue;
      for (HalfFaceId face : behind(h)) {
        const std::size_t axis = plane_of(face)[0];
        const auto c = corners_of(face);
        const Wide area2 = exact_cross(minus(c[1], c[0]), minus(c[2], c[0]))[axis];
        part.area2 += area2 < 0 ? -area2 : area2;
        for_each_square(face, [&](const Lattice3&, std::int64_t slot) { part.slots.push_back(slot); });
      }
    }
  });
  std::vector<std::int64_t> slots;
  Wide area2 = 0;
  for (const Part& part : parts) {
    slots.insert(slots.end(), part.slots.begin(), part.slots.end());
    area2 += part.area2;
  }
  std::sort(slots.begin(), slots.end());
  slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
  if (area2 != Wide{2} * map_.one() * map_.one() * static_cast<std::int64_t>(slots.size()))
    fail(fmt::format("The boundary of the integer-grid map is not covered by {} hex sides exactly once.", slots.size()),
         {}, {});
}

}  // namespace

void carry_features(const TetMesh& mesh, const Features& features, const FixedMap& map, const VertexTets& star,
                    const LatticeVertices& vertices, const Cells& cells, HexMesh& out, bool partial) {
  Carrier carrier(mesh, features, map, star, vertices, cells, out, partial);
  if (!partial) carrier.boundary();
  carrier.points();
  carrier.lines();
  carrier.quads();
}

}  // namespace hexfield::hex
