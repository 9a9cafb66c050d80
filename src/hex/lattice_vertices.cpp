#include "lattice_vertices.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "hexfield/base/parallel.hpp"

namespace hexfield::hex {
namespace {

constexpr std::size_t grain = 1024;

// A lattice point seen from one tet.
struct Sight {
  TetId tet;
  Lattice3 place;
};

// The local vertices of tets at an edge besides its ends.
std::array<int, 2> wings(const TetMesh& mesh, TetId t, VertexId a, VertexId b) {
  std::array<int, 2> other{};
  std::size_t n = 0;
  for (int k = 0; k < 4; ++k) {
    const VertexId v = mesh.vertices(t)[static_cast<std::size_t>(k)];
    if (v != a && v != b) other[n++] = k;
  }
  return other;
}

// The lowest tet around the edge (a, b) of `from.tet`, and the point, which lies on that edge, in its chart.
Sight lowest_around_edge(const TetMesh& mesh, const FixedMap& map, const Sight& from, VertexId a, VertexId b) {
  Sight lowest = from;
  for (std::size_t direction = 0; direction < 2; ++direction) {
    Sight at = from;
    int out = wings(mesh, from.tet, a, b)[direction];
    for (;;) {
      const HalfFaceId h(at.tet, out);
      const HalfFaceId o = mesh.opposite_half_face(h);
      if (!o.valid()) break;
      at = {o.tet(), map.transition(h).point(at.place)};
      if (at.tet == from.tet) return lowest;
      if (at.tet < lowest.tet && !map.is_flat(at.tet)) lowest = at;
      const auto w = wings(mesh, at.tet, a, b);
      out = w[0] == o.local() ? w[1] : w[0];
    }
  }
  return lowest;
}

class VertexFinder {
 public:
  VertexFinder(const TetMesh& mesh, const FixedMap& map, const VertexTets& star)
      : mesh_(mesh), map_(map), star_(star) {}

  LatticeVertices run() {
    out_.points = rasterise_points(map_);
    out_.ids.assign(static_cast<std::size_t>(out_.points.size), -1);
    out_.at_mesh_vertex.assign(mesh_.num_vertices(), -1);
    number_owned();
    copy_to_others();
    if (!map_.flat.empty()) unite_at_flat_tets();
    return std::move(out_);
  }

 private:
  static std::uint8_t mask(const Row& row, std::int32_t x) {
    if (x == row.begin) return row.first_mask;
    return x + 1 == row.end ? row.last_mask : static_cast<std::uint8_t>(row.first_mask & row.last_mask);
  }
  template <class Body>
  void for_each_item(const Body& body) const {
    const auto& rows = out_.points.rows;
    parallel_for(rows.size(), grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t r = begin; r < end; ++r) {
        if (map_.is_flat(rows[r].tet)) continue;
        for (std::int32_t x = rows[r].begin; x < rows[r].end; ++x)
          body(rows[r], x, static_cast<std::size_t>(rows[r].first + (x - rows[r].begin)));
      }
    });
  }
  std::array<VertexId, 2> carrier_edge(TetId t, std::uint8_t faces) const {
    std::array<VertexId, 2> ends;
    std::size_t n = 0;
    for (std::size_t k = 0; k < 4; ++k)
      if ((faces >> k & 1U) == 0) ends[n++] = mesh_.vertices(t)[k];
    return ends;
  }
  VertexId carrier_vertex(TetId t, std::uint8_t faces) const {
    return mesh_.vertices(t)[static_cast<std::size_t>(std::countr_one(faces))];
  }
  // The owner's sight of a point that lies on the faces `faces` of its tet. Not for vertices.
  Sight owner(const Sight& from, std::uint8_t faces) const {
    if (faces == 0) return from;
    if (std::popcount(faces) == 2) {
      const auto edge = carrier_edge(from.tet, faces);
      return lowest_around_edge(mesh_, map_, from, edge[0], edge[1]);
    }
    const HalfFaceId h(from.tet, std::countr_zero(faces));
    const HalfFaceId o = mesh_.opposite_half_face(h);
    if (!o.valid() || from.tet < o.tet() || map_.is_flat(o.tet())) return from;
    return {o.tet(), map_.transition(h).point(from.place)};
  }
  bool owned(const Row& row, std::int32_t x, std::uint8_t faces) const {
    if (std::popcount(faces) == 3) {
      const VertexId v = carrier_vertex(row.tet, faces);
      return *std::find_if(star_.begin(v), star_.end(v), [&](TetId t) { return !map_.is_flat(t); }) == row.tet;
    }
    return owner({row.tet, {x, row.y, row.z}}, faces).tet == row.tet;
  }
  Vec3 place(const Row& row, std::int32_t x, std::uint8_t faces) const;
  void number_owned();
  void copy_to_others();
  void unite_at_flat_tets();
  void renumber(const std::vector<std::int32_t>& lowest);

  const TetMesh& mesh_;
  const FixedMap& map_;
  const VertexTets& star_;
  LatticeVertices out_;
};

// Barycentric coordinates in the carrier, so that points on edges and faces stay on them.
Vec3 VertexFinder::place(const Row& row, std::int32_t x, std::uint8_t faces) const {
  const Fixed3 p = map_.fixed({x, row.y, row.z});
  std::array<std::size_t, 4> v{};
  std::size_t n = 0;
  for (std::size_t k = 0; k < 4; ++k)
    if ((faces >> k & 1U) == 0) v[n++] = k;
  const auto& c = map_.corners[row.tet.index()];
  const auto difference = [](const Fixed3& a, const Fixed3& b) {
    const Fixed3 d = minus(a, b);
    return Vec3(static_cast<double>(d[0]), static_cast<double>(d[1]), static_cast<double>(d[2]));
  };
  const auto xyz = [&](std::size_t k) -> const Vec3& { return mesh_.point(mesh_.vertices(row.tet)[v[k]]); };
  if (n == 1) return xyz(0);
  const Vec3 q = difference(p, c[v[0]]);
  const Vec3 e1 = difference(c[v[1]], c[v[0]]);
  if (n == 2) {
    Eigen::Index axis = 0;
    e1.cwiseAbs().maxCoeff(&axis);
    return xyz(0) + q[axis] / e1[axis] * (xyz(1) - xyz(0));
  }
  const Vec3 e2 = difference(c[v[2]], c[v[0]]);
  if (n == 3) {
    Eigen::Index axis = 0;
    const Vec3 normal = e1.cross(e2);
    normal.cwiseAbs().maxCoeff(&axis);
    const double b1 = q.cross(e2)[axis] / normal[axis];
    const double b2 = e1.cross(q)[axis] / normal[axis];
    return xyz(0) + b1 * (xyz(1) - xyz(0)) + b2 * (xyz(2) - xyz(0));
  }
  const Vec3 e3 = difference(c[v[3]], c[v[0]]);
  const double det = e1.cross(e2).dot(e3);
  return xyz(0) + q.cross(e2).dot(e3) / det * (xyz(1) - xyz(0)) + e1.cross(q).dot(e3) / det * (xyz(2) - xyz(0)) +
         e1.cross(e2).dot(q) / det * (xyz(3) - xyz(0));
}

void VertexFinder::number_owned() {
  for_each_item([&](const Row& row, std::int32_t x, std::size_t item) {
    if (owned(row, x, mask(row, x))) out_.ids[item] = 0;
  });
  std::int32_t next = 0;
  for (std::int32_t& id : out_.ids)
    if (id == 0) id = next++;
  out_.places.resize(static_cast<std::size_t>(next));
  for_each_item([&](const Row& row, std::int32_t x, std::size_t item) {
    if (out_.ids[item] < 0) return;
    const std::uint8_t faces = mask(row, x);
    out_.places[static_cast<std::size_t>(out_.ids[item])] = place(row, x, faces);
    if (std::popcount(faces) == 3) out_.at_mesh_vertex[carrier_vertex(row.tet, faces).index()] = out_.ids[item];
  });
}

void VertexFinder::copy_to_others() {
  std::vector<std::int32_t> ids = out_.ids;
  for_each_item([&](const Row& row, std::int32_t x, std::size_t item) {
    if (out_.ids[item] >= 0) return;
    const std::uint8_t faces = mask(row, x);
    if (std::popcount(faces) == 3) {
      ids[item] = out_.at_mesh_vertex[carrier_vertex(row.tet, faces).index()];
    } else {
      const Sight from = owner({row.tet, {x, row.y, row.z}}, faces);
      const std::int64_t there = out_.points.item(from.tet, from.place);
      ids[item] = there >= 0 ? out_.ids[static_cast<std::size_t>(there)] : -1;
    }
  });
  out_.ids = std::move(ids);
  const auto& rows = out_.points.rows;
  for (const Row& row : rows) {
    if (map_.is_flat(row.tet)) continue;
    for (std::int32_t x = row.begin; x < row.end; ++x)
      if (out_.ids[static_cast<std::size_t>(row.first + (x - row.begin))] < 0)
        throw Error(ExitCode::bad_hex_mesh,
                    fmt::format("Tet {}: lattice point ({}, {}, {}) of its chart is not one point around its carrier.",
                                row.tet.value, x, row.y, row.z),
                    {row.tet.value}, {centroid(mesh_, row.tet)});
  }
}

// The tets on the two sides of a flat tet touch each other, though no two of their faces or edges need to be the same:
// a lattice point in it is one vertex, whatever it is called on each side.
void VertexFinder::unite_at_flat_tets() {
  std::vector<std::int32_t> parent(out_.places.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (const Row& row : out_.points.rows) {
    if (!map_.is_flat(row.tet)) continue;
    for (std::int64_t i = row.first; i < row.first + (row.end - row.begin); ++i) {
      out_.ids[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(parent.size());
      parent.push_back(static_cast<std::int32_t>(parent.size()));
    }
  }
  const auto find = [&](std::int32_t i) {
    while (parent[static_cast<std::size_t>(i)] != i) i = parent[static_cast<std::size_t>(i)];
    return i;
  };
  for (std::size_t t = 0; t < mesh_.num_tets(); ++t) {
    if (!map_.is_flat(TetId(t))) continue;
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(TetId(t), f);
      const HalfFaceId o = mesh_.opposite_half_face(h);
      if (!o.valid()) continue;
      points_of_triangle(map_, corners_of_face(map_, h))
          .for_each_row([&](std::int32_t y, std::int32_t z, std::int32_t begin, std::int32_t end) {
            for (std::int32_t x = begin; x < end; ++x) {
              const std::int64_t here = out_.points.item(TetId(t), {x, y, z});
              const std::int64_t there = out_.points.item(o.tet(), map_.transition(h).point({x, y, z}));
              require(here >= 0 && there >= 0, "A lattice point of a face is in only one of its tets.");
              const std::int32_t a = find(out_.ids[static_cast<std::size_t>(here)]);
              const std::int32_t b = find(out_.ids[static_cast<std::size_t>(there)]);
              parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
            }
          });
    }
  }
  std::vector<std::int32_t> lowest(parent.size());
  for (std::size_t i = 0; i < parent.size(); ++i) lowest[i] = find(static_cast<std::int32_t>(i));
  renumber(lowest);
}

// Gives all ids of one lowest id one new number, in the order of the lowest.
void VertexFinder::renumber(const std::vector<std::int32_t>& lowest) {
  std::vector<std::int32_t> number(lowest.size(), -1);
  std::vector<Vec3> places;
  for (std::size_t i = 0; i < lowest.size(); ++i) {
    const auto root = static_cast<std::size_t>(lowest[i]);
    if (root == i) {
      // A point of flat tets alone has no place of its own; nothing uses it.
      number[i] = static_cast<std::int32_t>(places.size());
      places.push_back(i < out_.places.size() ? out_.places[i] : Vec3::Zero());
    }
    number[i] = number[root];
  }
  for (auto* ids : {&out_.ids, &out_.at_mesh_vertex})
    for (std::int32_t& id : *ids)
      if (id >= 0) id = number[static_cast<std::size_t>(id)];
  out_.places = std::move(places);
}

}  // namespace

LatticeVertices find_vertices(const TetMesh& mesh, const FixedMap& map, const VertexTets& star) {
  return VertexFinder(mesh, map, star).run();
}

}  // namespace hexfield::hex
