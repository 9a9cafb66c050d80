#include "raster.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "hexfield/base/parallel.hpp"
#include "hexfield/mesh/tet_mesh.hpp"

namespace hexfield::hex {
namespace {

std::int32_t floor_lattice(std::int64_t x, std::int64_t one) {
  const std::int64_t q = x / one;
  return static_cast<std::int32_t>(q * one > x ? q - 1 : q);
}
std::int32_t ceil_lattice(std::int64_t x, std::int64_t one) { return -floor_lattice(-x, one); }

// Lowest corners of items that meet the bounding box of the corners.
template <class Corners>
void bound(const Corners& corners, ConvexItems& items) {
  for (std::size_t a = 0; a < 3; ++a) {
    std::int64_t low = corners[0][a];
    std::int64_t high = low;
    for (const Fixed3& c : corners) {
      low = std::min(low, c[a]);
      high = std::max(high, c[a]);
    }
    if (items.kind == ConvexItems::Kind::cubes) {
      items.low[a] = floor_lattice(low, items.one);
      items.high[a] = ceil_lattice(high, items.one) - 1;
    } else {
      items.low[a] = ceil_lattice(low, items.one);
      items.high[a] = floor_lattice(high, items.one);
    }
  }
}

// Lines of the projection along `axis` through corners i, j that have all corners on one closed side.
template <class Corners>
void add_silhouette(const Corners& corners, std::size_t axis, ConvexItems& items) {
  Fixed3 along{};
  along[axis] = 1;
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t j = i + 1; j < corners.size(); ++j) {
      const std::array<Wide, 3> normal = exact_cross(along, minus(corners[j], corners[i]));
      if (normal[0] == 0 && normal[1] == 0 && normal[2] == 0) continue;
      const HalfSpace line(normal, corners[i]);
      int lowest = 0;
      int highest = 0;
      for (std::size_t k = 0; k < corners.size(); ++k) {
        if (k == i || k == j) continue;
        const int side = line.side(corners[k]);
        lowest = std::min(lowest, side);
        highest = std::max(highest, side);
      }
      if (lowest >= 0) items.add(line);
      if (highest <= 0) items.add(line.flipped());
    }
}

ConvexItems start(const FixedMap& map, ConvexItems::Kind kind) {
  ConvexItems items;
  items.kind = kind;
  items.one = map.one();
  return items;
}

// The rows of all four faces of a flat tet; a row meets a convex polygon in one stretch.
template <class ItemsOfTriangle>
void add_flat_rows(const FixedMap& map, TetId t, const ItemsOfTriangle& items_of, std::vector<Row>& rows) {
  std::vector<Row> parts;
  for (int i = 0; i < 4; ++i)
    items_of(corners_of_face(map, HalfFaceId(t, i)))
        .for_each_row([&](std::int32_t y, std::int32_t z, std::int32_t begin, std::int32_t end) {
          parts.push_back({y, z, begin, end, t});
        });
  std::sort(parts.begin(), parts.end(),
            [](const Row& a, const Row& b) { return std::tie(a.z, a.y, a.begin) < std::tie(b.z, b.y, b.begin); });
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (k == 0 || parts[k].y != parts[k - 1].y || parts[k].z != parts[k - 1].z)
      rows.push_back(parts[k]);
    else
      rows.back().end = std::max(rows.back().end, parts[k].end);
  }
}

// Layers of rows of one z per tet, for find().
void add_layers(RowTable& table) {
  const std::size_t n = table.tet_rows.size() - 1;
  table.tet_layers.assign(n + 1, 0);
  for (std::size_t t = 0; t < n; ++t) {
    const std::size_t begin = table.tet_rows[t];
    const std::size_t end = table.tet_rows[t + 1];
    for (std::size_t r = begin; r < end; ++r)
      for (auto z = r == begin ? table.rows[r].z - 1 : table.rows[r - 1].z; z < table.rows[r].z; ++z)
        table.layers.push_back(r);
    table.tet_layers[t + 1] = table.layers.size();
  }
  table.layers.push_back(table.rows.size());
}

template <class Fill>
RowTable rasterise(const FixedMap& map, const Fill& fill) {
  constexpr std::size_t grain = 256;
  const std::size_t n = map.corners.size();
  std::vector<std::vector<Row>> pieces((n + grain - 1) / grain);
  std::vector<std::int64_t> sizes(pieces.size(), 0);
  RowTable table;
  table.tet_rows.assign(n + 1, 0);
  parallel_for(n, grain, [&](std::size_t begin, std::size_t end) {
    std::vector<Row>& piece = pieces[begin / grain];
    for (std::size_t t = begin; t < end; ++t) {
      const std::size_t before = piece.size();
      fill(TetId(t), piece);
      table.tet_rows[t + 1] = piece.size() - before;
    }
    for (const Row& row : piece) sizes[begin / grain] += row.end - row.begin;
  });
  for (std::size_t t = 0; t < n; ++t) table.tet_rows[t + 1] += table.tet_rows[t];
  for (std::int64_t& size : sizes) table.size += std::exchange(size, table.size);
  table.rows.resize(table.tet_rows[n]);
  parallel_for(n, grain, [&](std::size_t begin, std::size_t) {
    std::vector<Row>& piece = pieces[begin / grain];
    std::int64_t first = sizes[begin / grain];
    std::size_t r = table.tet_rows[begin];
    for (Row& row : piece) {
      row.first = first;
      first += row.end - row.begin;
      table.rows[r++] = row;
    }
    piece = {};
  });
  add_layers(table);
  return table;
}

/// Bounds, in double precision, of the items of a convex set along one axis by their place on the later ones; bounds
/// by one coordinate alone are left to the box.
class Bounds {
 public:
  Bounds(const ConvexItems& items, std::size_t axis) : low_(items.low[axis]), high_(items.high[axis]) {
    const auto unit = static_cast<double>(items.one);
    for (std::size_t k = 0; k < items.count; ++k) {
      const auto& n = items.half_spaces[k].normal();
      if (n[axis] == 0 || (axis == 1 && n[0] != 0) || (n[1] == 0 && n[2] == 0)) continue;
      if (axis == 1 && n[2] == 0) continue;
      const auto at = [&](std::size_t a) {
        const bool far = items.kind == ConvexItems::Kind::cubes && n[a] > 0;
        return static_cast<double>(items.half_spaces[k].base()[a]) / unit - (far ? 1 : 0);
      };
      Bound& b = bounds_[count_++];
      b = {at(axis), axis == 0 ? n[1] / n[0] : 0, at(1), n[2] / n[axis], at(2), n[axis] > 0};
    }
  }

  /// Items outside [begin, last] are surely out, those in [sure_begin, sure_last] surely in.
  struct Range {
    std::int32_t begin, last, sure_begin, sure_last;
  };
  Range at(std::int32_t y, std::int32_t z) const {
    double low = low_ - 1.0, sure_low = low, high = high_ + 1.0, sure_high = high;
    for (std::size_t k = 0; k < count_; ++k) {
      const Bound& b = bounds_[k];
      const double from_y = b.by_y * (y - b.y);
      const double from_z = b.by_z * (z - b.z);
      const double x = b.x - (from_y + from_z);
      // Ten roundings at most; the rest is for comfort.
      const double margin = 1e-6 + 4e-15 * (std::abs(b.x) + std::abs(from_y) + std::abs(from_z));
      if (b.lower) {
        low = std::max(low, x - margin);
        sure_low = std::max(sure_low, x + margin);
      } else {
        high = std::min(high, x + margin);
        sure_high = std::min(sure_high, x - margin);
      }
    }
    const auto whole = [&](double x) { return static_cast<std::int32_t>(std::clamp(x, low_ - 1.0, high_ + 1.0)); };
    return {std::max(low_, whole(std::ceil(low))), std::min(high_, whole(std::floor(high))),
            std::max(low_, whole(std::floor(sure_low)) + 1), std::min(high_, whole(std::ceil(sure_high)) - 1)};
  }

 private:
  struct Bound {
    double x, by_y, y, by_z, z;
    bool lower;
  };
  std::array<Bound, 20> bounds_;
  std::size_t count_ = 0;
  std::int32_t low_, high_;
};

}  // namespace

std::array<HalfSpace, 4> inner_half_spaces(const std::array<Fixed3, 4>& c) {
  std::array<HalfSpace, 4> faces;
  for (std::size_t f = 0; f < 4; ++f) {
    const auto& v = tet_face_vertices[f];
    const Fixed3& a = c[static_cast<std::size_t>(v[0])];
    const auto ab = minus(c[static_cast<std::size_t>(v[1])], a);
    const auto ac = minus(c[static_cast<std::size_t>(v[2])], a);
    faces[f] = HalfSpace(exact_cross(ac, ab), a);
  }
  return faces;
}

const Row* RowTable::find(TetId t, std::int32_t y, std::int32_t z) const {
  const std::size_t layer = tet_layers[t.index()];
  const std::size_t num_layers = tet_layers[t.index() + 1] - layer;
  if (num_layers == 0) return nullptr;
  const std::int64_t above = std::int64_t{z} - rows[layers[layer]].z;
  if (above < 0 || above >= static_cast<std::int64_t>(num_layers)) return nullptr;
  const std::size_t begin = layers[layer + static_cast<std::size_t>(above)];
  const std::size_t end = layers[layer + static_cast<std::size_t>(above) + 1];
  if (begin == end || y < rows[begin].y) return nullptr;
  // Without gaps in y this is the row.
  std::size_t row = std::min(begin + static_cast<std::size_t>(std::int64_t{y} - rows[begin].y), end - 1);
  while (rows[row].y > y) --row;
  return rows[row].y == y ? &rows[row] : nullptr;
}

bool ConvexItems::contains(const Lattice3& x) const {
  for (std::size_t k = 0; k < count; ++k) {
    const auto& n = half_spaces[k].normal();
    Fixed3 p{};
    for (std::size_t a = 0; a < 3; ++a) p[a] = (x[a] + (kind == Kind::cubes && n[a] > 0 ? 1 : 0)) * one;
    const int side = half_spaces[k].side(p);
    if (kind == Kind::cubes ? side <= 0 : side < 0) return false;
  }
  return true;
}

void ConvexItems::for_each_row(
    const std::function<void(std::int32_t, std::int32_t, std::int32_t, std::int32_t)>& row) const {
  const Bounds by_z(*this, 1);
  const Bounds by_yz(*this, 0);
  for (std::int32_t z = low[2]; z <= high[2]; ++z) {
    const Bounds::Range ys = by_z.at(0, z);
    for (std::int32_t y = ys.begin; y <= ys.last; ++y) {
      const Bounds::Range xs = by_yz.at(y, z);
      std::int32_t begin = xs.begin;
      std::int32_t last = xs.last;
      const bool sure = xs.sure_begin == begin && xs.sure_last == last && y >= ys.sure_begin && y <= ys.sure_last;
      if (!sure) {
        while (begin <= last && !contains({begin, y, z})) ++begin;
        while (begin < last && !contains({last, y, z})) --last;
      }
      if (begin <= last) row(y, z, begin, last + 1);
    }
  }
}

ConvexItems cubes_of_tet(const FixedMap& map, TetId t) {
  ConvexItems items = start(map, ConvexItems::Kind::cubes);
  const auto& corners = map.corners[t.index()];
  bound(corners, items);
  if (items.low == items.high) return items;  // inside one cube
  for (const HalfSpace& h : inner_half_spaces(corners)) items.add(h);
  for (std::size_t axis = 0; axis < 3; ++axis) add_silhouette(corners, axis, items);
  return items;
}

ConvexItems cubes_of_triangle(const FixedMap& map, const std::array<Fixed3, 3>& corners) {
  ConvexItems items = start(map, ConvexItems::Kind::cubes);
  bound(corners, items);
  if (items.low == items.high) return items;
  const HalfSpace plane(exact_cross(minus(corners[1], corners[0]), minus(corners[2], corners[0])), corners[0]);
  items.add(plane);
  items.add(plane.flipped());
  for (std::size_t axis = 0; axis < 3; ++axis) add_silhouette(corners, axis, items);
  return items;
}

ConvexItems points_of_tet(const FixedMap& map, TetId t) {
  ConvexItems items = start(map, ConvexItems::Kind::points);
  const auto& corners = map.corners[t.index()];
  bound(corners, items);
  for (std::size_t a = 0; a < 3; ++a)
    if (items.low[a] > items.high[a]) return items;
  for (const HalfSpace& h : inner_half_spaces(corners)) items.add(h);
  return items;
}

ConvexItems points_of_triangle(const FixedMap& map, const std::array<Fixed3, 3>& corners) {
  ConvexItems items = start(map, ConvexItems::Kind::points);
  bound(corners, items);
  for (std::size_t a = 0; a < 3; ++a)
    if (items.low[a] > items.high[a]) return items;
  const HalfSpace plane(exact_cross(minus(corners[1], corners[0]), minus(corners[2], corners[0])), corners[0]);
  items.add(plane);
  items.add(plane.flipped());
  for (std::size_t axis = 0; axis < 3; ++axis) add_silhouette(corners, axis, items);
  return items;
}

std::array<Fixed3, 3> corners_of_face(const FixedMap& map, HalfFaceId h) {
  const auto& v = tet_face_vertices[static_cast<std::size_t>(h.local())];
  return {map.corner(h.tet(), v[0]), map.corner(h.tet(), v[1]), map.corner(h.tet(), v[2])};
}

ConvexItems cubes_beside_triangle(const FixedMap& map, const std::array<Fixed3, 3>& corners, std::size_t axis,
                                  bool above) {
  ConvexItems items = start(map, ConvexItems::Kind::cubes);
  bound(corners, items);
  items.low[axis] = items.high[axis] = floor_lattice(corners[0][axis], items.one) - (above ? 0 : 1);
  add_silhouette(corners, axis, items);
  return items;
}

std::uint8_t carrier_mask(const ConvexItems& points, const Lattice3& x, std::int64_t one) {
  std::uint8_t mask = 0;
  for (std::size_t f = 0; f < 4; ++f)
    if (points.half_spaces[f].side({x[0] * one, x[1] * one, x[2] * one}) == 0)
      mask = static_cast<std::uint8_t>(mask | (1U << f));
  return mask;
}

RowTable rasterise_cubes(const FixedMap& map) {
  return rasterise(map, [&](TetId t, std::vector<Row>& rows) {
    if (map.is_flat(t))
      return add_flat_rows(
          map, t, [&](const auto& corners) { return cubes_of_triangle(map, corners); }, rows);
    cubes_of_tet(map, t).for_each_row([&](std::int32_t y, std::int32_t z, std::int32_t begin, std::int32_t end) {
      rows.push_back({y, z, begin, end, t});
    });
  });
}

RowTable rasterise_points(const FixedMap& map) {
  return rasterise(map, [&](TetId t, std::vector<Row>& rows) {
    if (map.is_flat(t))
      return add_flat_rows(
          map, t, [&](const auto& corners) { return points_of_triangle(map, corners); }, rows);
    const ConvexItems items = points_of_tet(map, t);
    if (items.count == 0) return;
    items.for_each_row([&](std::int32_t y, std::int32_t z, std::int32_t begin, std::int32_t end) {
      rows.push_back({y, z, begin, end, t, carrier_mask(items, {begin, y, z}, map.one()),
                      carrier_mask(items, {end - 1, y, z}, map.one())});
    });
  });
}

}  // namespace hexfield::hex
