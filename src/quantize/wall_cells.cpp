#include "wall_cells.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace hexfield::quantize {
namespace {

constexpr double smallest_bend = 1e-6;  // radians: less is rounding where walls cut a straight edge

using octahedral::Label;

struct EdgeOfWall {
  std::int32_t a, b, h;
  auto operator<=>(const EdgeOfWall&) const = default;
};

}  // namespace

void WallCells::fail(const char* what, std::int32_t vertex) const {
  throw Error(ExitCode::no_integer_grid_map, fmt::format("Motorcycle complex: {}", what), {vertex},
              {mesh_.places[static_cast<std::size_t>(vertex)]});
}

void WallCells::build() {
  complex = {};
  cuts_.clear();
  flood();
  collect_walls();
  collect_edges();
  find_torus_cuts();
  if (!cuts_.empty()) return;
  find_nodes();
  chain_arcs();
  join_patches();
  complex.blocks.resize(torus_.size());
  place_nodes();
  if (!cuts_.empty()) return;
  fill_patches();
  fill_blocks();
  complex.grid_exponent = mesh_.grid_exponent;
  draw();
}

void WallCells::flood() {
  const auto n = static_cast<std::int32_t>(mesh_.num_tets());
  block_.assign(mesh_.num_tets(), -1);
  to_block_.assign(mesh_.num_tets(), {});
  torus_.clear();
  std::vector<std::int32_t> stack;
  for (std::int32_t seed = 0; seed < n; ++seed) {
    if (!mesh_.alive(seed) || block_[static_cast<std::size_t>(seed)] >= 0) continue;
    const auto block = static_cast<std::int32_t>(torus_.size());
    torus_.push_back(0);
    block_[static_cast<std::size_t>(seed)] = block;
    stack.assign(1, seed);
    for (std::size_t k = 0; k < stack.size(); ++k) {
      const std::int32_t t = stack[k];
      for (std::int32_t h = 4 * t; h < 4 * t + 4; ++h) {
        if (mesh_.is_wall(h)) continue;
        const auto next = static_cast<std::size_t>(mesh_.opposite(h) / 4);
        const ChartStep& step = mesh_.step(h);
        const ChartStep& here = to_block_[static_cast<std::size_t>(t)];
        const ChartStep there = step.is_identity() ? here : product(here, inverse(step));
        if (block_[next] < 0) {
          block_[next] = block;
          to_block_[next] = there;
          stack.push_back(static_cast<std::int32_t>(next));
        } else if (!(to_block_[next] == there)) {
          torus_.back() = 1;
        }
      }
    }
  }
}

Label WallCells::outward(std::int32_t h) {
  const std::int32_t t = h / 4;
  const int axis = mesh_.wall_axis(h);
  const int on_face = (h + 1) % 4;
  const int side = mesh_.points.compare(mesh_.point(t, h % 4), mesh_.point(t, on_face), axis);
  const auto label = static_cast<Label>(2 * axis + (side > 0 ? 1 : 0));
  return octahedral::image(to_block_[static_cast<std::size_t>(t)].rotation, label);
}

void WallCells::collect_walls() {
  walls_.clear();
  face_.assign(4 * mesh_.num_tets(), -1);
  outward_.assign(4 * mesh_.num_tets(), octahedral::no_label);
  for (std::int32_t h = 0; h < static_cast<std::int32_t>(4 * mesh_.num_tets()); ++h) {
    if (!mesh_.alive(h / 4) || !mesh_.is_wall(h)) continue;
    outward_[static_cast<std::size_t>(h)] = outward(h);
    const std::int32_t o = mesh_.opposite(h);
    if (o >= 0 && o < h) continue;
    face_[static_cast<std::size_t>(h)] = static_cast<std::int32_t>(walls_.size());
    if (o >= 0) face_[static_cast<std::size_t>(o)] = static_cast<std::int32_t>(walls_.size());
    walls_.push_back(h);
  }
}

void WallCells::collect_edges() {
  std::vector<EdgeOfWall> found;
  found.reserve(3 * walls_.size());
  for (std::int32_t h : walls_)
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j) {
        if (i == h % 4 || j == h % 4) continue;
        std::int32_t a = mesh_.tet(h / 4).vertices[static_cast<std::size_t>(i)];
        std::int32_t b = mesh_.tet(h / 4).vertices[static_cast<std::size_t>(j)];
        if (a > b) std::swap(a, b);
        found.push_back({a, b, h});
      }
  std::sort(found.begin(), found.end());
  edges_.clear();
  fans_.clear();
  for (std::size_t i = 0; i < found.size();) {
    std::size_t j = i;
    std::int32_t seed = found[i].h;
    int boundary = 0;
    for (; j < found.size() && found[j].a == found[i].a && found[j].b == found[i].b; ++j)
      if (mesh_.opposite(found[j].h) < 0) seed = found[j].h, ++boundary;
    if (boundary != 0 && boundary != 2) fail("the mesh touches itself in an edge.", found[i].a);
    make_edge(found[i].a, found[i].b, seed, boundary != 0);
    i = j;
  }
}

// Walks around the edge from wall half-face `seed`, wall by wall.
void WallCells::make_edge(std::int32_t a, std::int32_t b, std::int32_t seed, bool has_boundary) {
  WallEdge edge{a, b, static_cast<std::int32_t>(fans_.size()), 0, false};
  int sum = 0;
  std::int32_t first = seed;
  do {
    std::int32_t t = first / 4;
    int came = first % 4;
    ChartStep back;  // chart of t -> chart of the fan's first tet
    for (;;) {
      int leave = -1;
      for (int i = 0; i < 4; ++i) {
        const std::int32_t v = mesh_.tet(t).vertices[static_cast<std::size_t>(i)];
        if (i != came && v != a && v != b) leave = i;
      }
      const std::int32_t h = 4 * t + leave;
      if (mesh_.is_wall(h)) {
        const int axis = apply(back, ChartPlane{mesh_.wall_axis(h), 0}).axis;
        fans_.push_back({first, h, axis == mesh_.wall_axis(first) ? 2 : 1});
        break;
      }
      if (!mesh_.step(h).is_identity()) back = product(back, inverse(mesh_.step(h)));
      const std::int32_t o = mesh_.opposite(h);
      t = o / 4;
      came = o % 4;
    }
    ++edge.num_fans;
    sum += fans_.back().quarters;
    first = mesh_.opposite(fans_.back().last);
  } while (first >= 0 && first != seed);
  if ((first < 0) != has_boundary) fail("walls around an edge do not close.", a);
  // A fan of three quarters, or of a whole turn, makes the sum too small.
  if (sum != (has_boundary ? 2 : 4) + mesh_.edge_code(a, b))
    fail("the walls around an edge leave more than half a turn open.", a);
  edge.arc = sum != (has_boundary ? 2 : 4) || edge.num_fans > (has_boundary ? 1 : 2) ||
             fans_[static_cast<std::size_t>(edge.first_fan)].quarters == 1;
  if (!edge.arc && mesh_.edge_flags(a, b) != 0) fail("a feature or singular edge is on no arc.", a);
  edges_.push_back(edge);
}

// Solid tori have no walls across their axis.
void WallCells::find_torus_cuts() {
  std::vector<unsigned> normals(torus_.size(), 0);
  for (std::size_t h = 0; h < outward_.size(); ++h)
    if (outward_[h] != octahedral::no_label) normals[static_cast<std::size_t>(block_[h / 4])] |= 1U << outward_[h];
  for (std::size_t b = 0; b < torus_.size(); ++b) {
    if (torus_[b] == 0) continue;
    int axis = -1;
    for (int k = 0; k < 3; ++k)
      if ((normals[b] & 3U << 2 * k) == 0) axis = k;
    const auto inside = std::find(block_.begin(), block_.end(), static_cast<std::int32_t>(b)) - block_.begin();
    if (axis < 0 || normals[b] != (63U & ~(3U << 2 * axis)))
      fail("a block is neither a cuboid nor a solid torus.", mesh_.tet(static_cast<std::int32_t>(inside)).vertices[0]);
    cuts_.push_back({static_cast<std::int32_t>(b), axis, true});
  }
}

void WallCells::find_nodes() {
  node_.assign(mesh_.places.size(), -1);
  struct Seen {
    int arcs = 0;
    std::uint8_t flags = 0;
    bool mixed = false;
  };
  std::vector<Seen> seen(mesh_.places.size());
  for (const WallEdge& e : edges_) {
    if (!e.arc) continue;
    const std::uint8_t flags = mesh_.edge_flags(e.a, e.b);
    for (std::int32_t v : {e.a, e.b}) {
      Seen& s = seen[static_cast<std::size_t>(v)];
      s.mixed = s.mixed || (s.arcs > 0 && s.flags != flags);
      s.flags = flags;
      ++s.arcs;
    }
  }
  for (std::size_t v = 0; v < seen.size(); ++v) {
    const auto vertex = static_cast<std::int32_t>(v);
    if (seen[v].arcs == 1) fail("an arc ends at no other arc.", vertex);
    const bool feature = mesh_.is_feature_vertex(vertex);
    if (feature && seen[v].arcs == 0) fail("a feature point is on no arc.", vertex);
    if (seen[v].arcs <= 2 && !feature && !seen[v].mixed) continue;
    node_[v] = static_cast<std::int32_t>(complex.nodes.size());
    complex.nodes.push_back({mesh_.places[v], vertex, feature});
  }
}

// A polyline inscribed in a curve shows none of the turning in the first and the last half of its end edges.
double WallCells::turning(const std::vector<std::int32_t>& chain) const {
  const auto place = [&](std::size_t k) -> const Vec3& { return mesh_.places[static_cast<std::size_t>(chain[k])]; };
  double sum = 0, length = 0, first_bend = 0, last_bend = 0;
  for (std::size_t k = 1; k < chain.size(); ++k) {
    const Vec3 in = place(k) - place(k - 1);
    length += in.norm();
    if (k + 1 == chain.size()) break;
    const Vec3 out = place(k + 1) - place(k);
    const double angle = std::atan2(in.cross(out).norm(), in.dot(out));
    if (angle < smallest_bend) continue;
    if (sum == 0) first_bend = length;
    last_bend = length;
    sum += angle;
  }
  const double shown = length - (first_bend + length - last_bend) / 2;
  return sum > 0 ? sum * length / shown : 0;
}

void WallCells::chain_arcs() {
  std::vector<std::vector<std::int32_t>> at(mesh_.places.size());
  for (std::size_t e = 0; e < edges_.size(); ++e)
    if (edges_[e].arc)
      for (std::int32_t v : {edges_[e].a, edges_[e].b})
        at[static_cast<std::size_t>(v)].push_back(static_cast<std::int32_t>(e));
  arc_of_edge_.assign(edges_.size(), -1);
  first_edges_.clear();
  for (std::size_t v = 0; v < at.size(); ++v) {
    if (node_[v] < 0) continue;
    for (std::int32_t start : at[v]) {
      if (arc_of_edge_[static_cast<std::size_t>(start)] >= 0) continue;
      const auto arc = static_cast<std::int32_t>(complex.arcs.size());
      std::int32_t e = start;
      auto here = static_cast<std::int32_t>(v);
      std::vector<std::int32_t> chain{here};
      for (;;) {
        arc_of_edge_[static_cast<std::size_t>(e)] = arc;
        const WallEdge& edge = edges_[static_cast<std::size_t>(e)];
        here = edge.a == here ? edge.b : edge.a;
        chain.push_back(here);
        if (node_[static_cast<std::size_t>(here)] >= 0) break;
        const auto& star = at[static_cast<std::size_t>(here)];
        e = star[0] == e ? star[1] : star[0];
      }
      const WallEdge& edge = edges_[static_cast<std::size_t>(start)];
      first_edges_.emplace_back(start, edge.a == static_cast<std::int32_t>(v) ? 0 : 1);
      BlockComplex::Arc made;
      made.nodes = {node_[v], node_[static_cast<std::size_t>(here)]};
      made.code = mesh_.edge_code(edge.a, edge.b);
      made.singular = made.code != 0;
      made.feature = (mesh_.edge_flags(edge.a, edge.b) & feature_edge) != 0;
      made.boundary = mesh_.opposite(fans_[static_cast<std::size_t>(edge.first_fan)].first) < 0;
      made.turning = turning(chain);
      complex.arcs.push_back(made);
    }
  }
  for (std::size_t e = 0; e < edges_.size(); ++e)
    if (edges_[e].arc && arc_of_edge_[e] < 0) fail("a closed arc meets no other.", edges_[e].a);
}

void WallCells::join_patches() {
  std::vector<std::int32_t> parent(walls_.size());
  for (std::size_t i = 0; i < parent.size(); ++i) parent[i] = static_cast<std::int32_t>(i);
  const auto find = [&](std::int32_t i) {
    while (parent[static_cast<std::size_t>(i)] != i)
      i = parent[static_cast<std::size_t>(i)] = parent[static_cast<std::size_t>(parent[static_cast<std::size_t>(i)])];
    return i;
  };
  for (const WallEdge& e : edges_) {
    if (e.arc) continue;
    const Fan& fan = fans_[static_cast<std::size_t>(e.first_fan)];
    const std::int32_t a = find(face_[static_cast<std::size_t>(fan.first)]);
    const std::int32_t b = find(face_[static_cast<std::size_t>(fan.last)]);
    parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }
  patch_of_face_.assign(walls_.size(), -1);
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    const auto root = static_cast<std::size_t>(find(static_cast<std::int32_t>(i)));
    const std::int32_t h = walls_[i];
    if (root == i) {
      patch_of_face_[i] = static_cast<std::int32_t>(complex.patches.size());
      auto& patch = complex.patches.emplace_back();
      patch.distance = mesh_.distance(h);
      patch.feature = mesh_.is_feature_face(h);
    }
    patch_of_face_[i] = patch_of_face_[root];
    auto& patch = complex.patches[static_cast<std::size_t>(patch_of_face_[i])];
    patch.distance = std::min(patch.distance, mesh_.distance(h));
  }
}

void WallCells::clear_patch(std::int32_t patch) {
  for (std::size_t i = 0; i < walls_.size(); ++i)
    if (patch_of_face_[i] == patch) mesh_.clear_wall(walls_[i]);
}

}  // namespace hexfield::quantize
