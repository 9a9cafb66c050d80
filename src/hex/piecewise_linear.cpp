#include "hexfield/hex/piecewise_linear.hpp"

#include <algorithm>
#include <cmath>

#include "cells.hpp"
#include "hexfield/base/parallel.hpp"
#include "hexfield/hex/extract.hpp"
#include "hexfield/hex/sanitise.hpp"

namespace hexfield {
namespace {

using namespace hex;

constexpr double negligible = 1e-9;

// One tet of the map: inverse of the affine map, and its half-spaces.
class TetPieces {
 public:
  TetPieces(const TetMesh& mesh, const FixedMap& map, const Cells& cells, TetId t)
      : mesh_(mesh), map_(map), cells_(cells), t_(t), inside_(inner_half_spaces(map.corners[t.index()])) {
    const auto place = [&](std::size_t k) {
      const Fixed3& x = map.corners[t.index()][k];
      return Vec3(Vec3(static_cast<double>(x[0]), static_cast<double>(x[1]), static_cast<double>(x[2])) /
                  static_cast<double>(map.one()));
    };
    Mat3 image, domain;
    for (std::size_t k = 0; k < 4; ++k) corner_[k] = place(k);
    for (std::size_t k = 0; k < 3; ++k) {
      image.col(static_cast<Eigen::Index>(k)) = corner_[k + 1] - corner_[0];
      domain.col(static_cast<Eigen::Index>(k)) =
          mesh.point(mesh.tets[t.index()][k + 1]) - mesh.point(mesh.tets[t.index()][0]);
    }
    back_ = domain * image.inverse();
  }

  void add_arcs(std::vector<PiecewiseLinearHexes::ArcPiece>& arcs) const;
  void add_patches(std::vector<PiecewiseLinearHexes::PatchPiece>& patches) const;

 private:
  Vec3 xyz(const Vec3& uvw) const { return mesh_.point(mesh_.tets[t_.index()][0]) + back_ * (uvw - corner_[0]); }
  std::array<std::int32_t, 2> range(std::size_t axis) const;
  bool owns(unsigned faces) const;
  void add_polygon(std::size_t axis, std::int32_t q, const std::vector<Vec3>& polygon, octahedral::Label outward,
                   std::vector<PiecewiseLinearHexes::PatchPiece>& patches) const;

  const TetMesh& mesh_;
  const FixedMap& map_;
  const Cells& cells_;
  TetId t_;
  std::array<HalfSpace, 4> inside_;
  std::array<Vec3, 4> corner_;
  Mat3 back_;
};

// Integers between the least and largest coordinate.
std::array<std::int32_t, 2> TetPieces::range(std::size_t axis) const {
  double low = corner_[0][static_cast<Eigen::Index>(axis)], high = low;
  for (const Vec3& c : corner_) {
    low = std::min(low, c[static_cast<Eigen::Index>(axis)]);
    high = std::max(high, c[static_cast<Eigen::Index>(axis)]);
  }
  return {static_cast<std::int32_t>(std::ceil(low)), static_cast<std::int32_t>(std::floor(high))};
}

// Whether this is the lowest tet at the intersection of its faces (one or two of them).
bool TetPieces::owns(unsigned faces) const {
  std::vector<int> set;
  for (int f = 0; f < 4; ++f)
    if ((faces >> f & 1U) != 0) set.push_back(f);
  if (set.empty()) return true;
  if (set.size() == 1) {
    const HalfFaceId o = mesh_.opposite_half_face(HalfFaceId(t_, set[0]));
    return !o.valid() || t_ < o.tet();
  }
  std::array<VertexId, 2> ends;
  std::size_t n = 0;
  for (int k = 0; k < 4; ++k)
    if (k != set[0] && k != set[1]) ends[n++] = mesh_.vertices(t_)[static_cast<std::size_t>(k)];
  for (const int first : set) {
    TetId at = t_;
    int leave = first;
    for (;;) {
      const HalfFaceId o = mesh_.opposite_half_face(HalfFaceId(at, leave));
      if (!o.valid() || o.tet() == t_) break;
      at = o.tet();
      if (at < t_) return false;
      for (int k = 0; k < 4; ++k) {
        const VertexId v = mesh_.vertices(at)[static_cast<std::size_t>(k)];
        if (k != o.local() && v != ends[0] && v != ends[1]) leave = k;
      }
    }
  }
  return true;
}

void TetPieces::add_arcs(std::vector<PiecewiseLinearHexes::ArcPiece>& arcs) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t a = (axis + 1) % 3, b = (axis + 2) % 3;
    const auto [a_low, a_high] = range(a);
    const auto [b_low, b_high] = range(b);
    for (std::int32_t y = a_low; y <= a_high; ++y)
      for (std::int32_t z = b_low; z <= b_high; ++z) {
        Lattice3 p{};
        p[a] = y, p[b] = z;
        double low = -1e300, high = 1e300;
        unsigned faces = 0;
        for (std::size_t f = 0; f < 4; ++f) {
          const HalfSpace& h = inside_[f];
          const double slope = h.normal()[axis];
          if (slope == 0) {
            const int side = h.side(map_.fixed(p));
            if (side < 0) high = low - 1;
            if (side == 0) faces |= 1U << f;
            continue;
          }
          double rest = 0;
          for (std::size_t k = 0; k < 3; ++k)
            rest += h.normal()[k] *
                    (static_cast<double>(p[k]) - static_cast<double>(h.base()[k]) / static_cast<double>(map_.one()));
          (slope > 0 ? low : high) = slope > 0 ? std::max(low, -rest / slope) : std::min(high, -rest / slope);
        }
        if (!(high - low > negligible) || !owns(faces)) continue;
        for (auto x = static_cast<std::int32_t>(std::floor(low)); x < high; ++x) {
          const double from = std::max(low, static_cast<double>(x)), to = std::min(high, static_cast<double>(x) + 1);
          if (!(to - from > negligible)) continue;
          p[axis] = x;
          const auto ends = edge_vertices(cells_, t_, axis, p);
          if (!ends) continue;
          Vec3 first(p[0], p[1], p[2]), last = first;
          first[static_cast<Eigen::Index>(axis)] = from;
          last[static_cast<Eigen::Index>(axis)] = to;
          arcs.push_back({*ends, {xyz(first), xyz(last)}, t_.value});
        }
        p[axis] = 0;
      }
  }
}

// The part of a convex polygon where sign * (x[axis] - q) >= 0.
std::vector<Vec3> clipped(const std::vector<Vec3>& polygon, std::size_t axis, double q, double sign) {
  std::vector<Vec3> out;
  const auto k = static_cast<Eigen::Index>(axis);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3& a = polygon[i];
    const Vec3& b = polygon[(i + 1) % polygon.size()];
    const double da = sign * (a[k] - q), db = sign * (b[k] - q);
    if (da >= 0) out.push_back(a);
    if (da * db < 0) out.push_back(a + da / (da - db) * (b - a));
  }
  return out;
}

double area(const std::vector<Vec3>& polygon) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 2; i < polygon.size(); ++i)
    sum += 0.5 * (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
  return sum.norm();
}

void TetPieces::add_polygon(std::size_t axis, std::int32_t q, const std::vector<Vec3>& polygon,
                            octahedral::Label outward, std::vector<PiecewiseLinearHexes::PatchPiece>& patches) const {
  const std::size_t a = (axis + 1) % 3, b = (axis + 2) % 3;
  const auto bounds = [&](const std::vector<Vec3>& points, std::size_t k) {
    double low = 1e300, high = -1e300;
    for (const Vec3& p : points) {
      low = std::min(low, p[static_cast<Eigen::Index>(k)]);
      high = std::max(high, p[static_cast<Eigen::Index>(k)]);
    }
    return std::array<std::int32_t, 2>{static_cast<std::int32_t>(std::floor(low + negligible)),
                                       static_cast<std::int32_t>(std::ceil(high - negligible))};
  };
  const auto [y_low, y_high] = bounds(polygon, a);
  for (std::int32_t y = y_low; y < y_high; ++y) {
    const std::vector<Vec3> strip = clipped(clipped(polygon, a, y, 1), a, y + 1, -1);
    if (area(strip) < negligible) continue;
    const auto [z_low, z_high] = bounds(strip, b);
    for (std::int32_t z = z_low; z < z_high; ++z) {
      std::vector<Vec3> part = clipped(clipped(strip, b, z, 1), b, z + 1, -1);
      if (area(part) < negligible) continue;
      Lattice3 cube{};
      cube[axis] = (outward & 1) != 0 ? q : q - 1;
      cube[a] = y, cube[b] = z;
      if (cells_.pieces.item(t_, cube) < 0) continue;
      const std::int64_t side = side_of_cube(cells_, t_, cube, outward);
      if (side == no_side) continue;
      for (Vec3& p : part) p = xyz(p);
      patches.push_back({side_vertices(cells_, side), std::move(part), t_.value});
    }
  }
}

void TetPieces::add_patches(std::vector<PiecewiseLinearHexes::PatchPiece>& patches) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [low, high] = range(axis);
    for (std::int32_t q = low; q <= high; ++q) {
      std::array<int, 4> side{};
      int zeros = 0, above = 0, below = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        const std::int64_t d = map_.corners[t_.index()][k][axis] - q * map_.one();
        side[k] = d > 0 ? 1 : (d < 0 ? -1 : 0);
        ++(d > 0 ? above : (d < 0 ? below : zeros));
      }
      if (zeros == 3) {  // a face lies in the plane
        const auto opposite =
            static_cast<int>(std::find_if(side.begin(), side.end(), [](int s) { return s != 0; }) - side.begin());
        if (!owns(1U << opposite)) continue;
      } else if (above == 0 || below == 0) {
        continue;
      }
      std::vector<Vec3> polygon;
      const auto& v = corner_;
      for (std::size_t k = 0; k < 4; ++k)
        if (side[k] == 0) polygon.push_back(v[k]);
      for (const auto& e : tet_edge_vertices) {
        const auto i = static_cast<std::size_t>(e[0]), j = static_cast<std::size_t>(e[1]);
        if (side[i] * side[j] >= 0) continue;
        const auto k = static_cast<Eigen::Index>(axis);
        Vec3 p = v[i] + (q - v[i][k]) / (v[j][k] - v[i][k]) * (v[j] - v[i]);
        p[k] = q;
        polygon.push_back(p);
      }
      // In order around the middle.
      Vec3 middle = Vec3::Zero();
      for (const Vec3& p : polygon) middle += p / static_cast<double>(polygon.size());
      const auto a = static_cast<Eigen::Index>((axis + 1) % 3), b = static_cast<Eigen::Index>((axis + 2) % 3);
      std::sort(polygon.begin(), polygon.end(), [&](const Vec3& x, const Vec3& y) {
        return std::atan2(x[b] - middle[b], x[a] - middle[a]) < std::atan2(y[b] - middle[b], y[a] - middle[a]);
      });
      const bool from_below = below > 0;
      add_polygon(axis, q, polygon, static_cast<octahedral::Label>(2 * axis + (from_below ? 0 : 1)), patches);
    }
  }
}

}  // namespace

PiecewiseLinearHexes extract_piecewise_linear(const TetMesh& mesh, const Features& features,
                                              const IntegerGridMap& map) {
  PiecewiseLinearHexes out;
  out.mesh = extract_hex_mesh(mesh, features, map);
  const FixedMap fixed = fixed_map(mesh, sanitise_igm(mesh, features, map).map);
  const LatticeVertices vertices = find_vertices(mesh, fixed, vertex_tets(mesh));
  const Cells cells = find_cells(mesh, fixed, vertices);
  constexpr std::size_t grain = 256;
  struct Part {
    std::vector<PiecewiseLinearHexes::ArcPiece> arcs;
    std::vector<PiecewiseLinearHexes::PatchPiece> patches;
  };
  std::vector<Part> parts((mesh.num_tets() + grain - 1) / grain);
  parallel_for(mesh.num_tets(), grain, [&](std::size_t begin, std::size_t end) {
    Part& part = parts[begin / grain];
    for (std::size_t t = begin; t < end; ++t) {
      const TetPieces pieces(mesh, fixed, cells, TetId(t));
      pieces.add_arcs(part.arcs);
      pieces.add_patches(part.patches);
    }
  });
  for (Part& part : parts) {
    std::move(part.arcs.begin(), part.arcs.end(), std::back_inserter(out.arcs));
    std::move(part.patches.begin(), part.patches.end(), std::back_inserter(out.patches));
  }
  return out;
}

}  // namespace hexfield
