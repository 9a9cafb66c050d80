#include "hexfield/hex/hex_complex.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "hex_topology.hpp"
#include "hexfield/base/parallel.hpp"

namespace hexfield {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

Vec3 centre(const HexMesh& mesh, std::size_t h) {
  Vec3 sum = Vec3::Zero();
  for (int v : mesh.hexes[h]) sum += mesh.points[at(v)];
  return sum / 8;
}

void refuse_bad_ids(const HexMesh& mesh) {
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h) {
    auto sorted = mesh.hexes[h];
    std::sort(sorted.begin(), sorted.end());
    const auto id = static_cast<std::int64_t>(h);
    if (sorted.front() < 0 || at(sorted.back()) >= mesh.points.size())
      throw Error(ExitCode::bad_input, fmt::format("Hex {} has a vertex id out of range.", h), {id});
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
      throw Error(ExitCode::bad_input, fmt::format("Hex {} has a vertex twice.", h), {id}, {centre(mesh, h)});
  }
}

// Lists of the numbers 0..n-1 of `keys` by key.
IncidenceLists lists_by_key(std::size_t lists, std::size_t n, const auto& keys_of) {
  IncidenceLists out;
  out.first.assign(lists + 1, 0);
  for (std::size_t i = 0; i < n; ++i)
    for (int key : keys_of(i)) ++out.first[at(key) + 1];
  std::partial_sum(out.first.begin(), out.first.end(), out.first.begin());
  out.entries.resize(at(out.first.back()));
  std::vector<int> next(out.first.begin(), out.first.end() - 1);
  for (std::size_t i = 0; i < n; ++i) {
    int part = 0;
    const auto& keys = keys_of(i);
    for (int key : keys) {
      out.entries[at(next[at(key)]++)] = keys.size() == 8 ? static_cast<int>(8 * i) + part : static_cast<int>(i);
      ++part;
    }
  }
  return out;
}

void make_quads(const HexMesh& mesh, HexComplex& out) {
  const std::vector<hex::HexSide> sides = hex::sorted_sides(mesh);
  out.hex_quads.resize(mesh.hexes.size());
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t j = i;
    const int q = static_cast<int>(out.quads.size());
    std::array<int, 2> hexes{-1, -1};
    for (; j < sides.size() && sides[j].key == sides[i].key; ++j) {
      const auto h = static_cast<int>(sides[j].side / 6);
      if (j - i >= 2)
        throw Error(
            ExitCode::bad_input,
            fmt::format("The face ({}, {}, {}, {}) belongs to more than two hexes, among them {}, {} and {}.",
                        sides[i].key[0], sides[i].key[1], sides[i].key[2], sides[i].key[3], hexes[0], hexes[1], h),
            {h}, {centre(mesh, at(h))});
      hexes[j - i] = h;
      out.hex_quads[at(h)][static_cast<std::size_t>(sides[j].side % 6)] = q;
    }
    out.quads.push_back(hex::side_vertices(mesh, sides[i].side));
    out.quad_hexes.push_back(hexes);
    i = j;
  }
}

}  // namespace

int HexComplex::find_edge(int a, int b) const {
  const std::array<int, 2> key{std::min(a, b), std::max(a, b)};
  const auto found = std::lower_bound(edges.begin(), edges.end(), key);
  return found != edges.end() && *found == key ? static_cast<int>(found - edges.begin()) : -1;
}

int HexComplex::find_quad(std::array<int, 4> vertices) const {
  std::sort(vertices.begin(), vertices.end());
  if (vertices[0] < 0 || at(vertices[3]) >= num_vertices()) return -1;
  for (int e : vertex_edges[vertices[0]])
    for (int q : edge_quads[e]) {
      std::array<int, 4> key = quads[at(q)];
      std::sort(key.begin(), key.end());
      if (key == vertices) return q;
    }
  return -1;
}

int HexComplex::next_edge(int q, int e, int v) const {
  for (int f : quad_edges[at(q)])
    if (f != e && (edges[at(f)][0] == v || edges[at(f)][1] == v)) return f;
  return -1;
}

int HexComplex::quad_between(int e, int f) const {
  for (int q : edge_quads[e])
    if (std::find(quad_edges[at(q)].begin(), quad_edges[at(q)].end(), f) != quad_edges[at(q)].end()) return q;
  return -1;
}

HexComplex build_hex_complex(const HexMesh& mesh) {
  refuse_bad_ids(mesh);
  HexComplex out;
  make_quads(mesh, out);
  out.edges = hex::sorted_edges(mesh);
  out.vertex_edges = lists_by_key(mesh.points.size(), out.edges.size(),
                                  [&](std::size_t e) -> const std::array<int, 2>& { return out.edges[e]; });
  out.quad_edges.resize(out.quads.size());
  parallel_for(out.quads.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t q = begin; q < end; ++q)
      for (std::size_t k = 0; k < 4; ++k) {
        const int a = out.quads[q][k];
        const int b = out.quads[q][(k + 1) % 4];
        for (int e : out.vertex_edges[a])
          if (out.other_end(e, a) == b) out.quad_edges[q][k] = e;
      }
  });
  out.edge_quads = lists_by_key(out.edges.size(), out.quads.size(),
                                [&](std::size_t q) -> const std::array<int, 4>& { return out.quad_edges[q]; });
  out.vertex_corners = lists_by_key(mesh.points.size(), mesh.hexes.size(),
                                    [&](std::size_t h) -> const std::array<int, 8>& { return mesh.hexes[h]; });
  out.boundary_edge.assign(out.edges.size(), 0);
  out.boundary_vertex.assign(mesh.points.size(), 0);
  for (std::size_t q = 0; q < out.quads.size(); ++q) {
    if (out.quad_hexes[q][1] >= 0) continue;
    for (int e : out.quad_edges[q]) out.boundary_edge[at(e)] = 1;
    for (int v : out.quads[q]) out.boundary_vertex[at(v)] = 1;
  }
  return out;
}

VertexSphere vertex_sphere(const HexMesh& mesh, const HexComplex& complex, int vertex) {
  VertexSphere out;
  const auto edges = complex.vertex_edges[vertex];
  out.edges.assign(edges.begin(), edges.end());
  const auto number = [&](int other) {
    for (std::size_t k = 0; k < out.edges.size(); ++k)
      if (complex.other_end(out.edges[k], vertex) == other) return static_cast<int>(k);
    return -1;
  };
  std::vector<std::array<int, 3>> triangles;
  for (int slot : complex.vertex_corners[vertex]) {
    const auto& hex = mesh.hexes[at(slot / 8)];
    const auto& corner = hex::hex_corners[slot % 8];
    triangles.push_back({number(hex[at(corner[1])]), number(hex[at(corner[2])]), number(hex[at(corner[3])])});
  }
  std::string reason;
  for (int e : edges)
    if (!complex.is_boundary_edge(e) && complex.valence(e) < 3)
      reason =
          fmt::format("its edge to vertex {} lies between {} hexes", complex.other_end(e, vertex), complex.valence(e));
  if (complex.is_boundary_vertex(vertex)) reason = "it is on the boundary";
  if (reason.empty() && try_sphere_from_triangles(static_cast<int>(out.edges.size()), triangles, out.sphere, reason))
    return out;
  const Vec3& p = mesh.points[at(vertex)];
  throw Error(ExitCode::bad_input,
              fmt::format("The hexes at vertex {} at ({:.6g}, {:.6g}, {:.6g}) are no triangulated sphere: {}.", vertex,
                          p.x(), p.y(), p.z(), reason),
              {vertex}, {p});
}

}  // namespace hexfield
