#include "chart_mesh.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "hexfield/base/error.hpp"

namespace hexfield::quantize {
namespace {

using octahedral::Label;

std::array<double, 3> rotate(octahedral::Rotation r, const std::array<double, 3>& x) {
  std::array<double, 3> y{};
  for (Label k = 0; k < 3; ++k) {
    const Label to = octahedral::image(r, static_cast<Label>(2 * k));
    y[to / 2] = (to & 1) != 0 ? -x[k] : x[k];
  }
  return y;
}

// The least number of fractional bits that all coordinates fit into.
int grid_exponent_of(const SeamlessMap& map) {
  int exponent = -1074;
  double largest = 0;
  for (const auto& tet : map.uvw)
    for (const Vec3& p : tet)
      for (double x : p) {
        if (x == 0) continue;
        largest = std::max(largest, std::abs(x));
        int e = 0;
        const auto mantissa = static_cast<std::uint64_t>(std::ldexp(std::abs(std::frexp(x, &e)), 53));
        exponent = std::max(exponent, 53 - e - __builtin_ctzll(mantissa));
      }
  if (!(std::ldexp(largest, exponent) <= 0x1p51))
    throw Error(ExitCode::no_integer_grid_map, "The coordinates of the seamless map lie on no common dyadic grid.");
  return exponent;
}

}  // namespace

ChartPlane apply(const ChartStep& step, const ChartPlane& plane) {
  const Label to = octahedral::image(step.rotation, static_cast<Label>(2 * plane.axis));
  return {to / 2, ((to & 1) != 0 ? -plane.q : plane.q) + step.translation[to / 2]};
}

std::array<double, 3> transport(const ChartStep& step, const std::array<double, 3>& x) {
  std::array<double, 3> y = rotate(step.rotation, x);
  for (std::size_t k = 0; k < 3; ++k) y[k] += step.translation[k];
  return y;
}

ChartStep product(const ChartStep& a, const ChartStep& b) {
  return {octahedral::product(a.rotation, b.rotation), transport(a, b.translation)};
}

ChartStep inverse(const ChartStep& step) {
  ChartStep back{octahedral::inverse(step.rotation), {}};
  back.translation = rotate(back.rotation, step.translation);
  for (double& x : back.translation) x = 0 - x;
  return back;
}

ChartMesh::ChartMesh(const TetMesh& mesh, const Features& features, const EdgeCodes& codes, const SeamlessMap& map)
    : places(mesh.points), grid_exponent(grid_exponent_of(map)) {
  tets_.resize(mesh.num_tets());
  distances_.assign(4 * mesh.num_tets(), -1);
  steps_.resize(4 * mesh.num_tets());
  feature_face_.assign(4 * mesh.num_tets(), 0);
  read_corners(mesh, map);
  read_walls(mesh, features);
  for (const auto& [edge, code] : codes) edges_[key(edge[0].value, edge[1].value)] = {singular_edge, code};
  for (const auto& edge : features.edges) edges_[key(edge.first[0].value, edge.first[1].value)].flags |= feature_edge;
  feature_vertex_.assign(mesh.num_vertices(), 0);
  for (const auto& point : features.points) feature_vertex_[point.first.index()] = 1;
}

void ChartMesh::read_corners(const TetMesh& mesh, const SeamlessMap& map) {
  // Corners of one vertex with the same coordinates are one point.
  std::vector<std::vector<std::int32_t>> known(mesh.num_vertices());
  for (std::size_t t = 0; t < mesh.num_tets(); ++t)
    for (std::size_t i = 0; i < 4; ++i) {
      const HalfFaceId h(TetId(t), static_cast<int>(i));
      Tet& tet = tets_[t];
      tet.vertices[i] = mesh.tets[t][i].value;
      tet.opposite[i] = mesh.opposite_half_face(h).value;
      tet.original[i] = h.value;
      std::array<double, 3> x;
      for (int k = 0; k < 3; ++k) x[static_cast<std::size_t>(k)] = std::ldexp(map.uvw[t][i][k], grid_exponent);
      auto& here = known[mesh.tets[t][i].index()];
      const auto same = std::find_if(here.begin(), here.end(), [&](std::int32_t p) {
        return points.value(p, 0) == x[0] && points.value(p, 1) == x[1] && points.value(p, 2) == x[2];
      });
      tet.points[i] = same != here.end() ? *same : here.emplace_back(points.add(x));
      if (mesh.is_boundary(h)) continue;
      ChartStep& step = steps_[h.index()];
      step.rotation = map.rotation(h);
      const Vec3 translation = transition_translation(mesh, map, h);
      for (int k = 0; k < 3; ++k)
        step.translation[static_cast<std::size_t>(k)] = std::ldexp(translation[k], grid_exponent);
    }
}

void ChartMesh::read_walls(const TetMesh& mesh, const Features& features) {
  for (std::size_t t = 0; t < mesh.num_tets(); ++t)
    for (std::size_t i = 0; i < 4; ++i) {
      const HalfFaceId h(TetId(t), static_cast<int>(i));
      const bool feature = !features.faces.empty() && features.faces.contains(mesh.key(h));
      feature_face_[h.index()] = feature;
      if (!mesh.is_boundary(h) && !feature) continue;
      const auto at = [&](std::size_t k, int axis) {
        return points.value(tets_[t].points[static_cast<std::size_t>(tet_face_vertices[i][k])], axis);
      };
      for (int axis = 0; axis < 3; ++axis)
        if (at(0, axis) == at(1, axis) && at(0, axis) == at(2, axis)) set_wall(h.value, axis, 0);
      if (!is_wall(h.value))
        throw Error(ExitCode::no_integer_grid_map,
                    fmt::format("A boundary or feature face of tet {} lies in no coordinate plane.", t),
                    {static_cast<std::int64_t>(t)}, {centroid(mesh, TetId(t))});
    }
}

int ChartMesh::find_local(std::int32_t t, std::int32_t v) const {
  const auto& vertices = tet(t).vertices;
  for (int i = 0; i < 4; ++i)
    if (vertices[static_cast<std::size_t>(i)] == v) return i;
  return -1;
}

int ChartMesh::local(std::int32_t t, std::int32_t v) const {
  const int i = find_local(t, v);
  require(i >= 0, "A tet does not have the vertex that is looked for.");
  return i;
}

void ChartMesh::set_wall(std::int32_t h, int axis, double distance) {
  tets_[static_cast<std::size_t>(h / 4)].wall_axis[static_cast<std::size_t>(h % 4)] = static_cast<std::int8_t>(axis);
  distances_[static_cast<std::size_t>(h)] = distance;
  const std::int32_t o = opposite(h);
  if (o < 0) return;
  tets_[static_cast<std::size_t>(o / 4)].wall_axis[static_cast<std::size_t>(o % 4)] =
      static_cast<std::int8_t>(apply(step(h), ChartPlane{axis, 0}).axis);
  distances_[static_cast<std::size_t>(o)] = distance;
}

void ChartMesh::clear_wall(std::int32_t h) {
  for (std::int32_t side : {h, opposite(h)}) {
    if (side < 0) continue;
    tets_[static_cast<std::size_t>(side / 4)].wall_axis[static_cast<std::size_t>(side % 4)] = -1;
    distances_[static_cast<std::size_t>(side)] = -1;
  }
}

std::uint8_t ChartMesh::edge_flags(std::int32_t a, std::int32_t b) const {
  const auto found = edges_.find(key(a, b));
  return found == edges_.end() ? 0 : found->second.flags;
}

int ChartMesh::edge_code(std::int32_t a, std::int32_t b) const {
  const auto found = edges_.find(key(a, b));
  return found == edges_.end() ? 0 : found->second.code;
}

void ChartMesh::ring_of(std::int32_t t, std::int32_t a, std::int32_t b, const ChartPlane& plane) {
  ring_.assign(1, {t, plane});
  const auto walk = [&](int leave) {
    RingTet here = ring_[0];
    for (;;) {
      const std::int32_t h = 4 * here.tet + leave;
      const std::int32_t o = opposite(h);
      if (o < 0) return false;
      if (o / 4 == t) return true;
      here = {o / 4, apply(step(h), here.plane)};
      ring_.push_back(here);
      // Leave by the other face at the edge: the one opposite to the vertex that came along.
      for (int i = 0; i < 4; ++i) {
        const std::int32_t v = tet(here.tet).vertices[static_cast<std::size_t>(i)];
        if (i != o % 4 && v != a && v != b) leave = i;
      }
    }
  };
  std::array<int, 2> others{};
  std::size_t n = 0;
  for (int i = 0; i < 4; ++i) {
    const std::int32_t v = tet(t).vertices[static_cast<std::size_t>(i)];
    if (v != a && v != b) others[n++] = i;
  }
  if (!walk(others[0])) walk(others[1]);
}

void ChartMesh::make_children(std::int32_t t, std::int32_t a, std::int32_t b, std::int32_t n, std::int32_t point) {
  const auto ia = static_cast<std::size_t>(local(t, a));
  const auto ib = static_cast<std::size_t>(local(t, b));
  const auto first = static_cast<std::int32_t>(tets_.size());
  tets_.resize(tets_.size() + 2);
  distances_.resize(distances_.size() + 8, -1);
  Tet& old = tets_[static_cast<std::size_t>(t)];
  old.child = first;
  old.split = static_cast<std::int32_t>(splits_.size()) - 1;
  // The first child keeps a, the second keeps b.
  for (std::int32_t c = 0; c < 2; ++c) {
    Tet& child = tets_[static_cast<std::size_t>(first + c)];
    const std::size_t lost = c == 0 ? ib : ia;
    const std::size_t kept = c == 0 ? ia : ib;
    child = old;
    child.child = child.split = none;
    child.vertices[lost] = n;
    child.points[lost] = point;
    for (std::size_t i = 0; i < 4; ++i)
      distances_[static_cast<std::size_t>(4 * (first + c)) + i] = distances_[static_cast<std::size_t>(4 * t) + i];
    // Towards the other child.
    child.opposite[kept] = 4 * (first + 1 - c) + static_cast<std::int32_t>(c == 0 ? ib : ia);
    child.original[kept] = none;
    child.wall_axis[kept] = -1;
    distances_[static_cast<std::size_t>(4 * (first + c)) + kept] = -1;
    const std::int32_t outside = child.opposite[lost];
    if (outside >= 0)
      tets_[static_cast<std::size_t>(outside / 4)].opposite[static_cast<std::size_t>(outside % 4)] =
          4 * (first + c) + static_cast<std::int32_t>(lost);
  }
}

void ChartMesh::link_children(std::int32_t t, std::int32_t a, std::int32_t b) {
  const Tet old = tet(t);
  for (std::size_t i = 0; i < 4; ++i) {
    if (old.vertices[i] == a || old.vertices[i] == b || old.opposite[i] < 0) continue;
    const std::int32_t other = tet(old.opposite[i] / 4).child;
    for (std::int32_t c = 0; c < 2; ++c)
      tets_[static_cast<std::size_t>(old.child + c)].opposite[i] = 4 * (other + c) + old.opposite[i] % 4;
  }
}

std::int32_t ChartMesh::cut_edge(std::int32_t t, std::int32_t a, std::int32_t b, int axis, double q) {
  ring_of(t, a, b, {axis, q});
  const std::int32_t pa = point(t, local(t, a));
  const std::int32_t pb = point(t, local(t, b));
  const std::int32_t split = points.add_split(pa, pb, axis, q);
  const auto n = static_cast<std::int32_t>(places.size());
  const double ratio = points.ratio(split);
  places.push_back((1 - ratio) * places[static_cast<std::size_t>(a)] + ratio * places[static_cast<std::size_t>(b)]);
  splits_.push_back({a, b, n});
  std::array<std::int32_t, 3> last{-1, -1, -1};  // ends and middle in the chart of the tet before
  for (const RingTet& r : ring_) {
    const std::int32_t ra = point(r.tet, local(r.tet, a));
    const std::int32_t rb = point(r.tet, local(r.tet, b));
    if (last[0] != ra || last[1] != rb) {
      last = {ra, rb, points.add_point(split, ra, rb)};
      points.fix(last[2], r.plane.axis, r.plane.q);
    }
    make_children(r.tet, a, b, n, last[2]);
  }
  for (const RingTet& r : ring_) link_children(r.tet, a, b);
  const auto found = edges_.find(key(a, b));
  if (found != edges_.end()) {
    const EdgeInfo info = found->second;
    edges_[key(a, n)] = info;
    edges_[key(n, b)] = info;
  }
  return n;
}

}  // namespace hexfield::quantize
