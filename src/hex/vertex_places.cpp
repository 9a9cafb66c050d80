#include "vertex_places.hpp"

#include <algorithm>

#include "hex_topology.hpp"

namespace hexfield::hex {

Features VertexPlaces::with_boundary(const TetMesh& mesh, const Features& features) {
  Features all = features;
  for (std::size_t t = 0; t < mesh.num_tets(); ++t) {
    if (!mesh.alive(TetId(t))) continue;
    for (int i = 0; i < 4; ++i) {
      const HalfFaceId h(TetId(t), i);
      if (mesh.is_boundary(h)) all.faces.emplace(mesh.key(h), plain_boundary);
    }
  }
  return all;
}

VertexPlaces::VertexPlaces(const HexMesh& hexes, const TetMesh& mesh, const Features& features)
    : kinds_(hexes.points.size(), Kind::free),
      colours_(hexes.points.size(), plain_boundary),
      surfaces_(mesh, with_boundary(mesh, features)),
      curves_(mesh, features) {
  find_surfaces(hexes);
  find_curves(hexes);
  for (const auto& p : hexes.feature_points) kinds_[static_cast<std::size_t>(p.vertex)] = Kind::fixed;
}

// A vertex between two colours without a feature line stays: nothing says along which curve it may slide.
void VertexPlaces::find_surfaces(const HexMesh& hexes) {
  for (std::int64_t side : boundary_sides(sorted_sides(hexes)))
    for (int v : side_vertices(hexes, side))
      if (surfaces_.has(plain_boundary)) kinds_[static_cast<std::size_t>(v)] = Kind::surface;
  for (const auto& quad : hexes.feature_quads)
    for (int vertex : quad.vertices) {
      const auto v = static_cast<std::size_t>(vertex);
      if (!surfaces_.has(quad.colour) || (colours_[v] != plain_boundary && colours_[v] != quad.colour))
        kinds_[v] = Kind::fixed;
      else if (kinds_[v] != Kind::fixed)
        kinds_[v] = Kind::surface;
      colours_[v] = quad.colour;
    }
}

void VertexPlaces::find_curves(const HexMesh& hexes) {
  std::vector<int> lines(kinds_.size(), 0);
  std::vector<char> mixed(kinds_.size(), 0);
  std::vector<int> colour(kinds_.size(), 0);
  for (const auto& line : hexes.feature_lines)
    for (int vertex : line.vertices) {
      const auto v = static_cast<std::size_t>(vertex);
      if (lines[v] > 0 && colour[v] != line.colour) mixed[v] = 1;
      ++lines[v];
      colour[v] = line.colour;
    }
  for (std::size_t v = 0; v < kinds_.size(); ++v) {
    if (lines[v] == 0) continue;
    const bool slides = lines[v] == 2 && mixed[v] == 0 && curves_.has(colour[v]);
    kinds_[v] = slides ? Kind::curve : Kind::fixed;
    colours_[v] = colour[v];
  }
}

Vec3 VertexPlaces::project(std::size_t v, const Vec3& p) const {
  if (kinds_[v] == Kind::surface) return surfaces_.project(p, colours_[v]).point;
  if (kinds_[v] == Kind::curve) return curves_.project(p, colours_[v]).point;
  return p;
}

Mat3 VertexPlaces::tangent(std::size_t v, const Vec3& p) const {
  if (kinds_[v] == Kind::surface) {
    const Vec3 n = surfaces_.project(p, colours_[v]).normal;
    return Mat3::Identity() - n * n.transpose();
  }
  if (kinds_[v] == Kind::curve) {
    const Vec3 t = curves_.project(p, colours_[v]).tangent;
    return t * t.transpose();
  }
  return kinds_[v] == Kind::free ? Mat3(Mat3::Identity()) : Mat3(Mat3::Zero());
}

}  // namespace hexfield::hex
