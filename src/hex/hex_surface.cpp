#include "hexfield/hex/hex_surface.hpp"

#include <algorithm>
#include <set>

#include "hex_topology.hpp"
#include "hexfield/hex/hex_complex.hpp"

namespace hexfield {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Two triangles of a quad along the diagonal at its lowest vertex, so that both hexes at it agree.
std::array<std::array<int, 3>, 2> triangles_of(const std::array<int, 4>& quad) {
  const auto low = static_cast<std::size_t>(std::min_element(quad.begin(), quad.end()) - quad.begin());
  const auto v = [&](std::size_t k) { return quad[(low + k) % 4]; };
  return {{{v(0), v(1), v(2)}, {v(0), v(2), v(3)}}};
}

FaceKey key_of(const std::array<int, 3>& t) { return face_key(VertexId(t[0]), VertexId(t[1]), VertexId(t[2])); }

HexSurface shape_of(const HexMesh& mesh) {
  std::vector<Vec3> points = mesh.points;
  std::vector<std::array<VertexId, 4>> tets;
  HexSurface out;
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h) {
    const VertexId middle(static_cast<std::int64_t>(points.size()));
    Vec3 sum = Vec3::Zero();
    for (int v : mesh.hexes[h]) sum += mesh.points[at(v)];
    points.emplace_back(sum / 8);
    for (std::int64_t f = 0; f < 6; ++f)
      for (const auto& t : triangles_of(hex::side_vertices(mesh, static_cast<std::int64_t>(6 * h) + f))) {
        tets.push_back({middle, VertexId(t[0]), VertexId(t[1]), VertexId(t[2])});
        if (!mesh.hex_colours.empty()) out.features.tet_colours.push_back(mesh.hex_colours[h]);
      }
  }
  out.mesh = build_tet_mesh(std::move(points), std::move(tets));
  for (const auto& quad : mesh.feature_quads)
    for (const auto& t : triangles_of(quad.vertices)) out.features.faces[key_of(t)] = quad.colour;
  for (const auto& line : mesh.feature_lines)
    out.features.edges[edge_key(VertexId(line.vertices[0]), VertexId(line.vertices[1]))] = line.colour;
  for (const auto& point : mesh.feature_points) out.features.points[VertexId(point.vertex)] = point.colour;
  out.features.names = mesh.names;
  return out;
}

}  // namespace

HexSurface complete_hex_features(HexMesh& mesh, double degrees) {
  HexSurface out = shape_of(mesh);
  complete_features(out.mesh, out.features, degrees);
  const HexComplex complex = build_hex_complex(mesh);
  const std::size_t given_quads = mesh.feature_quads.size();
  std::set<std::array<int, 4>> tagged;
  for (std::size_t k = 0; k < given_quads; ++k) {
    auto key = mesh.feature_quads[k].vertices;
    std::sort(key.begin(), key.end());
    tagged.insert(key);
  }
  for (const auto& quad : complex.quads) {
    auto key = quad;
    std::sort(key.begin(), key.end());
    const auto found = out.features.faces.find(key_of(triangles_of(quad)[0]));
    if (found != out.features.faces.end() && !tagged.contains(key)) mesh.feature_quads.push_back({quad, found->second});
  }
  // Diagonals of strongly bent quads are no edges of the mesh and no features of it.
  mesh.feature_lines.clear();
  for (auto entry = out.features.edges.begin(); entry != out.features.edges.end();) {
    const auto [a, b] = entry->first;
    if (b.index() < mesh.points.size() && complex.find_edge(a.value, b.value) >= 0) {
      mesh.feature_lines.push_back({{a.value, b.value}, entry->second});
      ++entry;
    } else {
      entry = out.features.edges.erase(entry);
    }
  }
  mesh.feature_points.clear();
  for (const auto& [v, colour] : out.features.points) mesh.feature_points.push_back({v.value, colour});
  return out;
}

}  // namespace hexfield
