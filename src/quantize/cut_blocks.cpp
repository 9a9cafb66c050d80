#include <algorithm>
#include <cmath>
#include <functional>

#include "brush_fire.hpp"
#include "wall_cells.hpp"

namespace hexfield::quantize {

using octahedral::Label;

namespace {

// The axis of the chart of a tet that is axis `axis` of its block's.
int axis_in_tet(const ChartStep& to_block, int axis) {
  return octahedral::axis(octahedral::image(octahedral::inverse(to_block.rotation), static_cast<Label>(2 * axis)));
}

// A living descendant of t with a wall face that has both vertices.
std::int32_t wall_with(const ChartMesh& mesh, std::int32_t t, std::int32_t a, std::int32_t b) {
  if (!mesh.alive(t)) {
    const std::int32_t found = wall_with(mesh, mesh.tet(t).child, a, b);
    return found >= 0 ? found : wall_with(mesh, mesh.tet(t).child + 1, a, b);
  }
  const int i = mesh.find_local(t, a);
  const int j = mesh.find_local(t, b);
  if (i < 0 || j < 0) return -1;
  for (int f = 0; f < 4; ++f)
    if (f != i && f != j && mesh.is_wall(4 * t + f)) return 4 * t + f;
  return -1;
}

}  // namespace

void WallCells::ignite(const BlockCut& cut, BrushFire& fire) {
  if (cut.torus && ignite_at_arc(cut, fire)) return;
  for (std::int32_t h = 0; h < static_cast<std::int32_t>(outward_.size()); ++h) {
    if (outward_[static_cast<std::size_t>(h)] == octahedral::no_label || block_of(h) != cut.block) continue;
    if (octahedral::axis(outward_[static_cast<std::size_t>(h)]) == cut.axis) continue;
    if (ignite_at_face(cut, h, fire)) return;
  }
  fail("a block cannot be cut.", mesh_.tet(0).vertices[0]);
}

// At an arc on the hull across the axis of the block.
bool WallCells::ignite_at_arc(const BlockCut& cut, BrushFire& fire) {
  for (const WallEdge& e : edges_) {
    if (!e.arc) continue;
    for (std::int32_t f = e.first_fan; f < e.first_fan + e.num_fans; ++f) {
      const std::int32_t h = fans_[static_cast<std::size_t>(f)].first;
      if (block_of(h) != cut.block || octahedral::axis(direction(h / 4, e.a, e.b)) == cut.axis) continue;
      ignite_fan(axis_in_tet(to_block_[static_cast<std::size_t>(h / 4)], cut.axis), h, e.a, e.b, fire);
      return true;
    }
  }
  return false;
}

// Cuts face h of the hull along the plane, where that crosses it, and ignites there.
bool WallCells::ignite_at_face(const BlockCut& cut, std::int32_t h, BrushFire& fire) {
  const std::int32_t t = h / 4;
  const ChartStep& to_block = to_block_[static_cast<std::size_t>(t)];
  const int axis = axis_in_tet(to_block, cut.axis);
  std::array<int, 3> corner{};
  for (std::size_t k = 0; k < 3; ++k) corner[k] = tet_face_vertices[static_cast<std::size_t>(h % 4)][k];
  const auto vertex = [&](std::size_t k) { return mesh_.tet(t).vertices[static_cast<std::size_t>(corner[k])]; };
  std::array<double, 3> x;
  for (std::size_t k = 0; k < 3; ++k) x[k] = mesh_.points.value(mesh_.point(t, corner[k]), axis);
  const double q = cut.torus ? std::floor((std::min({x[0], x[1], x[2]}) + std::max({x[0], x[1], x[2]})) / 2)
                             : apply(inverse(to_block), ChartPlane{cut.axis, cut.at}).q;
  std::array<int, 3> side;
  for (std::size_t k = 0; k < 3; ++k) side[k] = mesh_.points.side(mesh_.point(t, corner[k]), axis, q);
  std::array<std::int32_t, 3> ends{};
  std::size_t n = 0;
  for (std::size_t k = 0; k < 3; ++k)
    if (side[k] == 0) ends[n++] = vertex(k);
  std::array<std::pair<std::size_t, std::size_t>, 3> crossed;
  std::size_t num_crossed = 0;
  for (std::size_t k = 0; k < 3; ++k)
    if (side[k] * side[(k + 1) % 3] < 0) crossed[num_crossed++] = {k, (k + 1) % 3};
  if (n + num_crossed != 2) return false;
  // Names first: the tet dies with the first cut.
  std::array<std::pair<std::int32_t, std::int32_t>, 2> edges;
  for (std::size_t k = 0; k < num_crossed; ++k) edges[k] = {vertex(crossed[k].first), vertex(crossed[k].second)};
  std::int32_t here = h;
  for (std::size_t k = 0; k < num_crossed; ++k) {
    here = wall_with(mesh_, t, edges[k].first, edges[k].second);
    ends[n++] = mesh_.cut_edge(here / 4, edges[k].first, edges[k].second, axis, q);
  }
  here = wall_with(mesh_, t, ends[0], ends[1]);
  if (here < 0) return false;
  // Children are in the chart of their parent.
  ignite_fan(axis, here, ends[0], ends[1], fire);
  return true;
}

// Ignites in all tets of the fan that begins at wall half-face h; `axis` is in the chart of h's tet.
void WallCells::ignite_fan(int axis, std::int32_t h, std::int32_t a, std::int32_t b, BrushFire& fire) {
  std::int32_t t = h / 4;
  int came = h % 4;
  for (;;) {
    fire.ignite(t, a, b, axis);
    int leave = -1;
    for (int i = 0; i < 4; ++i) {
      const std::int32_t v = mesh_.tet(t).vertices[static_cast<std::size_t>(i)];
      if (i != came && v != a && v != b) leave = i;
    }
    const std::int32_t out = 4 * t + leave;
    if (mesh_.is_wall(out)) return;
    axis = apply(mesh_.step(out), ChartPlane{axis, 0}).axis;
    t = mesh_.opposite(out) / 4;
    came = mesh_.opposite(out) % 4;
  }
}

}  // namespace hexfield::quantize
