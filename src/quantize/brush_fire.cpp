#include "brush_fire.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "hexfield/base/error.hpp"

namespace hexfield::quantize {
namespace {

// The axis that alone varies along the edge between local vertices i and j, -1 when there is none.
int axis_of_edge(ChartMesh& mesh, std::int32_t t, int i, int j) {
  int axis = -1;
  for (int k = 0; k < 3; ++k) {
    if (mesh.points.compare(mesh.point(t, i), mesh.point(t, j), k) == 0) continue;
    if (axis >= 0) return -1;
    axis = k;
  }
  return axis;
}

}  // namespace

void BrushFire::Queue::push(const Front& front) {
  fronts_.push_back(front);
  std::push_heap(fronts_.begin(), fronts_.end(), std::greater<>());
}

BrushFire::Front BrushFire::Queue::pop() {
  std::pop_heap(fronts_.begin(), fronts_.end(), std::greater<>());
  const Front front = fronts_.back();
  fronts_.pop_back();
  return front;
}

void BrushFire::ignite_sources() {
  for (std::size_t i = 0; i < mesh_.num_tets(); ++i) {
    const auto t = static_cast<std::int32_t>(i);
    if (!mesh_.alive(t)) continue;
    for (const auto& e : tet_edge_vertices) {
      const std::int32_t b = mesh_.tet(t).vertices[static_cast<std::size_t>(e[0])];
      const std::int32_t c = mesh_.tet(t).vertices[static_cast<std::size_t>(e[1])];
      const std::uint8_t flags = mesh_.edge_flags(b, c);
      const bool source = flags != 0 && ((flags & feature_edge) != 0 || mesh_.edge_code(b, c) > -2);
      if (!source && !mesh_.is_feature_vertex(b) && !mesh_.is_feature_vertex(c)) continue;
      const int along = axis_of_edge(mesh_, t, e[0], e[1]);
      if (along < 0) {
        if (!source) continue;
        throw Error(ExitCode::no_integer_grid_map, "A feature or singular edge runs along no axis of the map.", {b, c},
                    {mesh_.places[static_cast<std::size_t>(b)], mesh_.places[static_cast<std::size_t>(c)]});
      }
      for (int k = 0; k < 3; ++k)
        if (k != along) ignite(t, b, c, k);
    }
  }
}

void BrushFire::ignite(std::int32_t t, std::int32_t b, std::int32_t c, int axis) {
  const int ib = mesh_.local(t, b);
  const int ic = mesh_.local(t, c);
  int along = axis_of_edge(mesh_, t, ib, ic);
  require(along >= 0 && along != axis, "A wall is ignited at an edge that runs along no axis in it.");
  Front front{t, b, c, axis, 3 - along - axis, mesh_.points.value(mesh_.point(t, ib), axis), 0, 0, 0, serial_};
  if (mesh_.points.side(mesh_.point(t, ib), axis, front.q) != 0)
    throw Error(ExitCode::no_integer_grid_map, "A source of walls does not lie on the grid of the map.");
  front.origin = mesh_.points.value(mesh_.point(t, ib), front.travel);
  std::array<int, 2> sides{};
  std::size_t n = 0;
  for (int i = 0; i < 4; ++i)
    if (i != ib && i != ic) sides[n++] = mesh_.points.side(mesh_.point(t, i), axis, front.q);
  if (sides[0] * sides[1] > 0) return;
  ++serial_;
  global_.push(front);
}

void BrushFire::burn() {
  while (!global_.empty()) {
    local_.push(global_.pop());
    while (!local_.empty()) {
      const Front front = local_.pop();
      visit(front, front.tet, front.b, front.c);
    }
  }
}

// Goes down to the living descendants of the tet that have (a part of) the edge.
void BrushFire::visit(const Front& front, std::int32_t t, std::int32_t b, std::int32_t c) {
  if (mesh_.alive(t)) {
    Front here = front;
    here.tet = t, here.b = b, here.c = c;
    burn_tet(here);
    return;
  }
  const std::int32_t child = mesh_.tet(t).child;
  const ChartMesh::Split split = mesh_.split(mesh_.tet(t).split);
  if ((b == split.first && c == split.second) || (c == split.first && b == split.second)) {
    const bool turned = c == split.first;
    visit(front, child + (turned ? 1 : 0), b, split.middle);
    visit(front, child + (turned ? 0 : 1), split.middle, c);
    return;
  }
  if (b != split.second && c != split.second) visit(front, child, b, c);
  if (b != split.first && c != split.first) visit(front, child + 1, b, c);
}

void BrushFire::burn_tet(Front front) {
  std::array<int, 2> other{};
  std::size_t n = 0;
  for (int i = 0; i < 4; ++i) {
    const std::int32_t v = mesh_.tet(front.tet).vertices[static_cast<std::size_t>(i)];
    if (v != front.b && v != front.c) other[n++] = i;
  }
  const int a = mesh_.points.side(mesh_.point(front.tet, other[0]), front.iso, front.q);
  const int d = mesh_.points.side(mesh_.point(front.tet, other[1]), front.iso, front.q);
  if (a * d > 0) return;
  if (a == 0 && d == 0)
    throw Error(ExitCode::no_integer_grid_map, "A wall of the motorcycle complex meets a flat tet.", {front.tet},
                {mesh_.places[static_cast<std::size_t>(front.b)]});
  std::int32_t wall = 0;
  if (a == 0) {
    wall = 4 * front.tet + other[1];
  } else if (d == 0) {
    wall = 4 * front.tet + other[0];
  } else {
    const std::int32_t va = mesh_.tet(front.tet).vertices[static_cast<std::size_t>(other[0])];
    const std::int32_t vd = mesh_.tet(front.tet).vertices[static_cast<std::size_t>(other[1])];
    mesh_.cut_edge(front.tet, va, vd, front.iso, front.q);
    const std::int32_t child = mesh_.tet(front.tet).child;
    wall = 4 * child + mesh_.local(child, va);
  }
  if (mesh_.is_wall(wall)) return;
  if (mesh_.opposite(wall) < 0) return;
  mesh_.set_wall(wall, front.iso, front.burnt);
  std::int32_t tip = 0;
  for (int i = 0; i < 4; ++i) {
    const std::int32_t v = mesh_.tet(wall / 4).vertices[static_cast<std::size_t>(i)];
    if (i != wall % 4 && v != front.b && v != front.c) tip = v;
  }
  spread(front, wall, front.b, tip);
  spread(front, wall, tip, front.c);
}

// Hands the fire on from the new wall face across its edge (b, c), unless that stops it.
void BrushFire::spread(const Front& front, std::int32_t wall, std::int32_t b, std::int32_t c) {
  if ((mesh_.edge_flags(b, c) & singular_edge) != 0) return;
  ChartPlane iso{front.iso, front.q};
  ChartPlane travel{front.travel, front.origin};
  bool crossed = false;
  std::optional<Front> next;
  std::int32_t t = wall / 4;
  int leave = 0;  // the first step leaves by the face opposite to the wall's third vertex
  for (int i = 0; i < 4; ++i) {
    const std::int32_t v = mesh_.tet(t).vertices[static_cast<std::size_t>(i)];
    if (i != wall % 4 && v != b && v != c) leave = i;
  }
  for (;;) {
    const std::int32_t h = 4 * t + leave;
    if (t != wall / 4 && mesh_.opposite(h) == wall) break;
    if (mesh_.is_wall(h)) return;  // with the new face two walls
    const std::int32_t o = mesh_.opposite(h);
    if (o < 0) return;
    iso = apply(mesh_.step(h), iso);
    travel = apply(mesh_.step(h), travel);
    crossed = crossed || mesh_.crosses_original(h);
    t = o / 4;
    std::array<int, 2> sides{};
    std::size_t n = 0;
    for (int i = 0; i < 4; ++i) {
      const std::int32_t v = mesh_.tet(t).vertices[static_cast<std::size_t>(i)];
      if (v == b || v == c) continue;
      if (i != o % 4) leave = i;
      if (!next) sides[n++] = mesh_.points.side(mesh_.point(t, i), iso.axis, iso.q);
    }
    if (next || sides[0] * sides[1] > 0 || mesh_.opposite(4 * t + leave) == wall) continue;
    Front f = front;
    f.tet = t, f.b = b, f.c = c;
    f.iso = iso.axis, f.q = iso.q, f.travel = travel.axis, f.origin = travel.q;
    next = f;
    next->serial = crossed ? 1 : 0;  // which queue, until it gets its number
  }
  if (!next) return;
  const bool outside = next->serial != 0;
  const auto away = [&](std::int32_t v) {
    return std::abs(mesh_.points.value(mesh_.point(next->tet, mesh_.local(next->tet, v)), next->travel) - next->origin);
  };
  next->straight = 0.5 * (away(b) + away(c));
  next->burnt = front.burnt + std::abs(next->straight - front.straight);
  next->serial = serial_++;
  (outside ? global_ : local_).push(*next);
}

}  // namespace hexfield::quantize
