#include "hex_topology.hpp"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <tuple>

#include "hexfield/base/parallel.hpp"
#include "hexfield/hex/check.hpp"

namespace hexfield {
namespace hex {
namespace {

template <class T, class Less>
void sort_all(std::vector<T>& values, const Less& less) {
  if (threads() == 1)
    std::sort(values.begin(), values.end(), less);
  else
    tbb::parallel_sort(values.begin(), values.end(), less);
}

// Topology from the cells' edges and faces and the boundary polygons.
template <class Edge, std::size_t K>
MeshTopology count(std::size_t vertices, std::size_t cells, std::size_t faces, const std::vector<Edge>& edges,
                   const std::vector<std::array<int, K>>& boundary) {
  MeshTopology out;
  std::vector<char> used(vertices, 0);
  DisjointSets volume(vertices);
  for (const Edge& e : edges) {
    used[static_cast<std::size_t>(e[0])] = used[static_cast<std::size_t>(e[1])] = 1;
    volume.join(static_cast<std::size_t>(e[0]), static_cast<std::size_t>(e[1]));
  }
  std::size_t used_count = 0;
  for (std::size_t v = 0; v < vertices; ++v)
    if (used[v] != 0) {
      ++used_count;
      out.components += volume.find(v) == v ? 1 : 0;
    }
  out.euler_volume = static_cast<int>(static_cast<std::int64_t>(used_count) - static_cast<std::int64_t>(edges.size()) +
                                      static_cast<std::int64_t>(faces) - static_cast<std::int64_t>(cells));
  std::vector<std::array<int, 2>> rim;
  std::fill(used.begin(), used.end(), 0);
  DisjointSets surface(vertices);
  for (const auto& polygon : boundary)
    for (std::size_t k = 0; k < K; ++k) {
      const int a = polygon[k];
      const int b = polygon[(k + 1) % K];
      used[static_cast<std::size_t>(a)] = 1;
      surface.join(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
      rim.push_back({std::min(a, b), std::max(a, b)});
    }
  sort_all(rim, std::less<>{});
  std::int64_t rim_edges = 0;
  for (std::size_t i = 0; i < rim.size();) {
    std::size_t j = i;
    while (j < rim.size() && rim[j] == rim[i]) ++j;
    out.boundary_edges_not_in_two_faces += j - i != 2 ? 1 : 0;
    ++rim_edges;
    i = j;
  }
  std::int64_t rim_vertices = 0;
  for (std::size_t v = 0; v < vertices; ++v)
    if (used[v] != 0) {
      ++rim_vertices;
      out.boundary_components += surface.find(v) == v ? 1 : 0;
    }
  out.euler_boundary = static_cast<int>(rim_vertices - rim_edges + static_cast<std::int64_t>(boundary.size()));
  return out;
}

}  // namespace

std::vector<HexSide> sorted_sides(const HexMesh& mesh) {
  std::vector<HexSide> sides(6 * mesh.hexes.size());
  parallel_for(mesh.hexes.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t h = begin; h < end; ++h)
      for (std::size_t f = 0; f < 6; ++f) {
        HexSide& side = sides[6 * h + f];
        side.side = static_cast<std::int64_t>(6 * h + f);
        side.key = side_vertices(mesh, side.side);
        std::sort(side.key.begin(), side.key.end());
      }
  });
  sort_all(sides, [](const HexSide& a, const HexSide& b) { return std::tie(a.key, a.side) < std::tie(b.key, b.side); });
  return sides;
}

std::vector<std::int64_t> boundary_sides(const std::vector<HexSide>& sides) {
  std::vector<std::int64_t> out;
  for (std::size_t i = 0; i < sides.size(); ++i)
    if ((i == 0 || sides[i - 1].key != sides[i].key) && (i + 1 == sides.size() || sides[i + 1].key != sides[i].key))
      out.push_back(sides[i].side);
  std::sort(out.begin(), out.end());
  return out;
}

std::array<int, 4> side_vertices(const HexMesh& mesh, std::int64_t side) {
  const auto& hex = mesh.hexes[static_cast<std::size_t>(side / 6)];
  const auto& local = hex_faces[side % 6];
  return {hex[static_cast<std::size_t>(local[0])], hex[static_cast<std::size_t>(local[1])],
          hex[static_cast<std::size_t>(local[2])], hex[static_cast<std::size_t>(local[3])]};
}

std::vector<std::array<int, 2>> sorted_edges(const HexMesh& mesh) {
  std::vector<std::array<int, 2>> edges(12 * mesh.hexes.size());
  parallel_for(mesh.hexes.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t h = begin; h < end; ++h)
      for (std::size_t e = 0; e < 12; ++e) {
        const int a = mesh.hexes[h][static_cast<std::size_t>(hex_edges[e][0])];
        const int b = mesh.hexes[h][static_cast<std::size_t>(hex_edges[e][1])];
        edges[12 * h + e] = {std::min(a, b), std::max(a, b)};
      }
  });
  sort_all(edges, std::less<>{});
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

}  // namespace hex

MeshTopology topology(const HexMesh& mesh) {
  const std::vector<hex::HexSide> sides = hex::sorted_sides(mesh);
  std::size_t faces = 0;
  for (std::size_t i = 0; i < sides.size(); ++i) faces += i == 0 || sides[i].key != sides[i - 1].key ? 1 : 0;
  std::vector<std::array<int, 4>> boundary;
  for (std::int64_t side : hex::boundary_sides(sides)) boundary.push_back(hex::side_vertices(mesh, side));
  return hex::count(mesh.points.size(), mesh.hexes.size(), faces, hex::sorted_edges(mesh), boundary);
}

MeshTopology topology(const TetMesh& mesh) {
  std::vector<std::array<int, 2>> edges;
  std::vector<std::array<int, 3>> boundary;
  std::size_t tets = 0;
  std::size_t half_faces = 0;
  for (std::size_t t = 0; t < mesh.num_tets(); ++t) {
    if (!mesh.alive(TetId(t))) continue;
    ++tets;
    for (const auto& e : tet_edge_vertices) {
      const int a = mesh.tets[t][static_cast<std::size_t>(e[0])].value;
      const int b = mesh.tets[t][static_cast<std::size_t>(e[1])].value;
      edges.push_back({std::min(a, b), std::max(a, b)});
    }
    for (int i = 0; i < 4; ++i) {
      const HalfFaceId h(TetId(t), i);
      if (!mesh.is_boundary(h)) {
        ++half_faces;
        continue;
      }
      const auto v = mesh.face_vertices(h);
      boundary.push_back({v[0].value, v[1].value, v[2].value});
    }
  }
  hex::sort_all(edges, std::less<>{});
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return hex::count(mesh.num_vertices(), tets, half_faces / 2 + boundary.size(), edges, boundary);
}

}  // namespace hexfield
