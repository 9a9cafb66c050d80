#include "vertex_places.hpp"

#include <algorithm>
#include <set>

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
  link_chords(hexes);
  Eigen::AlignedBox3d box;
  for (const Vec3& p : mesh.points) box.extend(p);
  diagonal_ = box.isEmpty() ? 0 : box.diagonal().norm();
}

VertexPlaces::VertexPlaces(std::size_t vertices)
    : kinds_(vertices, Kind::free),
      colours_(vertices, plain_boundary),
      first_chord_(vertices + 1, 0),
      surfaces_(TetMesh{}, Features{}),
      curves_(TetMesh{}, Features{}) {}

void VertexPlaces::link_chords(const HexMesh& hexes) {
  first_chord_.assign(hexes.points.size() + 1, 0);
  for (const Chord& chord : chords_)
    for (int v : chord.vertices)
      if (v >= 0) ++first_chord_[static_cast<std::size_t>(v) + 1];
  for (std::size_t v = 0; v < hexes.points.size(); ++v) first_chord_[v + 1] += first_chord_[v];
  chords_at_.resize(first_chord_.back());
  std::vector<std::size_t> next(first_chord_.begin(), first_chord_.end() - 1);
  for (std::size_t c = 0; c < chords_.size(); ++c)
    for (int v : chords_[c].vertices)
      if (v >= 0) chords_at_[next[static_cast<std::size_t>(v)]++] = static_cast<std::int32_t>(c);
}

double VertexPlaces::chord_error(std::size_t v, const Vec3& p, const std::vector<Vec3>& points) const {
  if (kinds_[v] == Kind::free) return 0;
  double worst = 0;
  for (std::size_t k = first_chord_[v]; k < first_chord_[v + 1]; ++k) {
    const Chord& chord = chords_[static_cast<std::size_t>(chords_at_[k])];
    Vec3 middle = Vec3::Zero();
    int n = 0;
    for (int w : chord.vertices)
      if (w >= 0) {
        middle += static_cast<std::size_t>(w) == v ? p : points[static_cast<std::size_t>(w)];
        ++n;
      }
    middle /= n;
    worst = std::max(worst, n == 2 ? curves_.project(middle, chord.colour).distance
                                   : surfaces_.project(middle, chord.colour).distance);
  }
  return worst;
}

// A vertex between two colours without a feature line stays: nothing says along which curve it may slide.
void VertexPlaces::find_surfaces(const HexMesh& hexes) {
  std::set<std::array<int, 4>> coloured;
  const auto sorted = [](std::array<int, 4> key) {
    std::sort(key.begin(), key.end());
    return key;
  };
  for (const auto& quad : hexes.feature_quads) {
    coloured.insert(sorted(quad.vertices));
    if (surfaces_.has(quad.colour)) chords_.push_back({quad.vertices, quad.colour});
  }
  for (std::int64_t side : boundary_sides(sorted_sides(hexes))) {
    const std::array<int, 4> vertices = side_vertices(hexes, side);
    if (!surfaces_.has(plain_boundary) || coloured.contains(sorted(vertices))) continue;
    chords_.push_back({vertices, plain_boundary});
    for (int v : vertices) kinds_[static_cast<std::size_t>(v)] = Kind::surface;
  }
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
    if (curves_.has(line.colour)) chords_.push_back({{line.vertices[0], line.vertices[1], -1, -1}, line.colour});
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
