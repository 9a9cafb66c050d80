#include <algorithm>
#include <cmath>

#include "wall_cells.hpp"

namespace hexfield::quantize {

using octahedral::Label;
using octahedral::Rotation;
using Integer3 = BlockComplex::Integer3;

// Positions of the nodes in the charts of their blocks; a block that meets itself has a node twice.
void WallCells::place_nodes() {
  struct Corner {
    std::int32_t node, tet;
    auto operator<=>(const Corner&) const = default;
  };
  std::vector<Corner> corners;
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(mesh_.num_tets()); ++t)
    if (mesh_.alive(t))
      for (std::int32_t v : mesh_.tet(t).vertices)
        if (node_[static_cast<std::size_t>(v)] >= 0) corners.push_back({node_[static_cast<std::size_t>(v)], t});
  std::sort(corners.begin(), corners.end());
  std::vector<std::vector<std::pair<std::int32_t, Integer3>>> places(complex.blocks.size());
  std::vector<char> seen(mesh_.num_tets(), 0);
  std::vector<std::int32_t> stack;
  for (std::size_t first = 0; first < corners.size();) {
    std::size_t last = first;
    while (last < corners.size() && corners[last].node == corners[first].node) ++last;
    const std::int32_t node = corners[first].node;
    const std::int32_t v = complex.nodes[static_cast<std::size_t>(node)].vertex;
    for (std::size_t c = first; c < last; ++c) {
      const std::int32_t seed = corners[c].tet;
      if (seen[static_cast<std::size_t>(seed)] != 0) continue;
      stack.assign(1, seed);
      seen[static_cast<std::size_t>(seed)] = 1;
      for (std::size_t k = 0; k < stack.size(); ++k)
        for (std::int32_t h = 4 * stack[k]; h < 4 * stack[k] + 4; ++h) {
          if (mesh_.is_wall(h) || mesh_.tet(h / 4).vertices[static_cast<std::size_t>(h % 4)] == v) continue;
          const auto next = static_cast<std::size_t>(mesh_.opposite(h) / 4);
          if (std::exchange(seen[next], 1) == 0) stack.push_back(static_cast<std::int32_t>(next));
        }
      std::array<double, 3> x;
      for (int k = 0; k < 3; ++k) {
        std::int64_t value = 0;
        if (!mesh_.points.integer(mesh_.point(seed, mesh_.local(seed, v)), k, value))
          fail("a node does not lie on the grid of the map.", v);
        x[static_cast<std::size_t>(k)] = static_cast<double>(value);
      }
      x = transport(to_block_[static_cast<std::size_t>(seed)], x);
      places[static_cast<std::size_t>(block_[static_cast<std::size_t>(seed)])].push_back(
          {node, {std::llround(x[0]), std::llround(x[1]), std::llround(x[2])}});
    }
    for (std::size_t c = first; c < last; ++c) seen[static_cast<std::size_t>(corners[c].tet)] = 0;
    first = last;
  }
  for (std::size_t b = 0; b < places.size(); ++b) {
    auto& block = complex.blocks[b];
    block.nodes = std::move(places[b]);
    if (block.nodes.empty()) fail("a block has no node.", mesh_.tet(0).vertices[0]);
    block.low = block.high = block.nodes[0].second;
    for (const auto& [node, place] : block.nodes)
      for (std::size_t k = 0; k < 3; ++k) {
        block.low[k] = std::min(block.low[k], place[k]);
        block.high[k] = std::max(block.high[k], place[k]);
      }
    find_self_cuts(static_cast<std::int32_t>(b), block.nodes);
  }
  for (auto& node : complex.nodes)
    if (node.vertex >= mesh_.num_input_vertices()) node.vertex = -1;
}

void WallCells::find_self_cuts(std::int32_t block, const std::vector<std::pair<std::int32_t, Integer3>>& places) {
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    if (places[i].first != places[i + 1].first) continue;
    const Integer3& p = places[i].second;
    const Integer3& r = places[i + 1].second;
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (std::abs(p[k] - r[k]) > std::abs(p[axis] - r[axis])) axis = k;
    if (std::abs(p[axis] - r[axis]) < 2)
      fail("a block meets itself in one place.", complex.nodes[static_cast<std::size_t>(places[i].first)].vertex);
    cuts_.push_back({block, static_cast<int>(axis), false, static_cast<double>(std::min(p[axis], r[axis])),
                     static_cast<double>(std::max(p[axis], r[axis]))});
    // A node that the cut may go through anyway, the one closest to the middle.
    BlockCut& cut = cuts_.back();
    const double middle = std::floor((cut.low + cut.high) / 2);
    double best = 0.5 * (cut.high - cut.low);
    cut.at = middle;
    for (const auto& place : places) {
      const auto x = static_cast<double>(place.second[axis]);
      if (x <= cut.low || x >= cut.high || std::abs(x - middle) >= best) continue;
      best = std::abs(x - middle);
      cut.at = x;
    }
    return;
  }
}

Label WallCells::direction(std::int32_t t, std::int32_t from, std::int32_t to) const {
  const int i = mesh_.local(t, from);
  const int j = mesh_.local(t, to);
  int axis = 0;
  double longest = 0;
  for (int k = 0; k < 3; ++k) {
    const double d = mesh_.points.value(mesh_.point(t, j), k) - mesh_.points.value(mesh_.point(t, i), k);
    if (std::abs(d) > std::abs(longest)) longest = d, axis = k;
  }
  return octahedral::image(to_block_[static_cast<std::size_t>(t)].rotation,
                           static_cast<Label>(2 * axis + (longest < 0 ? 1 : 0)));
}

void WallCells::fill_patches() {
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    auto& patch = complex.patches[static_cast<std::size_t>(patch_of_face_[i])];
    if (patch.blocks[0] >= 0) continue;
    std::int32_t front = walls_[i];
    std::int32_t back = mesh_.opposite(front);
    if (back >= 0 && block_of(back) < block_of(front)) std::swap(front, back);
    patch.blocks = {block_of(front), back < 0 ? -1 : block_of(back)};
    patch.normals[0] = outward_[static_cast<std::size_t>(front)];
    if (back < 0) continue;
    patch.normals[1] = outward_[static_cast<std::size_t>(back)];
    patch.rotation = octahedral::product(
        octahedral::product(to_block_[static_cast<std::size_t>(back / 4)].rotation, mesh_.step(front).rotation),
        octahedral::inverse(to_block_[static_cast<std::size_t>(front / 4)].rotation));
  }
  for (std::size_t arc = 0; arc < complex.arcs.size(); ++arc) {
    const WallEdge& e = edges_[static_cast<std::size_t>(first_edges_[arc].first)];
    for (std::int32_t f = e.first_fan; f < e.first_fan + e.num_fans; ++f)
      for (std::int32_t h : {fans_[static_cast<std::size_t>(f)].first, fans_[static_cast<std::size_t>(f)].last}) {
        auto& patch = complex.patches[static_cast<std::size_t>(
            patch_of_face_[static_cast<std::size_t>(face_[static_cast<std::size_t>(h)])])];
        if (block_of(h) != patch.blocks[0]) continue;
        // In which direction of its plane the face ends here.
        const std::int32_t t = h / 4;
        int tip = 0;
        for (int i = 0; i < 4; ++i) {
          const std::int32_t v = mesh_.tet(t).vertices[static_cast<std::size_t>(i)];
          if (i != h % 4 && v != e.a && v != e.b) tip = i;
        }
        const Rotation back = octahedral::inverse(to_block_[static_cast<std::size_t>(t)].rotation);
        const int along = octahedral::axis(octahedral::image(back, direction(t, e.a, e.b)));
        const int across = 3 - along - mesh_.wall_axis(h);
        if (along == mesh_.wall_axis(h)) fail("an arc does not run along an axis.", e.a);
        const int side = mesh_.points.compare(mesh_.point(t, tip), mesh_.point(t, mesh_.local(t, e.a)), across);
        const auto label = octahedral::image(to_block_[static_cast<std::size_t>(t)].rotation,
                                             static_cast<Label>(2 * across + (side > 0 ? 1 : 0)));
        patch.sides[label].push_back(static_cast<std::int32_t>(arc));
      }
  }
}

void WallCells::fill_blocks() {
  const auto place = [&](const BlockComplex::Block& block, std::int32_t node) -> const Integer3& {
    const auto found = std::lower_bound(block.nodes.begin(), block.nodes.end(), node,
                                        [](const auto& entry, std::int32_t n) { return entry.first < n; });
    if (found == block.nodes.end() || found->first != node) fail("an arc leaves its block.", mesh_.tet(0).vertices[0]);
    return found->second;
  };
  for (std::size_t p = 0; p < complex.patches.size(); ++p)
    for (std::size_t s = 0; s < 2; ++s)
      if (complex.patches[p].blocks[s] >= 0)
        complex.blocks[static_cast<std::size_t>(complex.patches[p].blocks[s])]
            .faces[complex.patches[p].normals[s]]
            .push_back(static_cast<std::int32_t>(p));
  for (std::size_t a = 0; a < complex.arcs.size(); ++a) {
    auto& arc = complex.arcs[a];
    const auto [first, turned] = first_edges_[a];
    const WallEdge& e = edges_[static_cast<std::size_t>(first)];
    for (std::int32_t f = e.first_fan; f < e.first_fan + e.num_fans; ++f) {
      const Fan& fan = fans_[static_cast<std::size_t>(f)];
      auto& block = complex.blocks[static_cast<std::size_t>(block_of(fan.first))];
      const Label along = direction(fan.first / 4, turned != 0 ? e.b : e.a, turned != 0 ? e.a : e.b);
      block.arcs.emplace_back(static_cast<std::int32_t>(a), along);
      const auto axis = static_cast<std::size_t>(along / 2);
      if (fan.quarters == 1) {
        const auto high = [&](std::size_t k) {
          return outward_[static_cast<std::size_t>(fan.first)] == 2 * k ||
                 outward_[static_cast<std::size_t>(fan.last)] == 2 * k;
        };
        block.edges[4 * axis + 2 * (high((axis + 1) % 3) ? 1 : 0) + (high((axis + 2) % 3) ? 1 : 0)].push_back(
            static_cast<std::int32_t>(a));
      }
      const Integer3& p = place(block, arc.nodes[0]);
      const Integer3& r = place(block, arc.nodes[1]);
      const std::int64_t length = ((along & 1) != 0 ? -1 : 1) * (r[axis] - p[axis]);
      if (length <= 0 || (arc.length != 0 && arc.length != length)) fail("an arc has two lengths.", e.a);
      arc.length = length;
    }
  }
  for (auto& block : complex.blocks) {
    block.corners.fill(-1);
    for (const auto& [node, x] : block.nodes) {
      unsigned bits = 0;
      int on = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        on += x[k] == block.low[k] || x[k] == block.high[k];
        if (x[k] == block.high[k]) bits |= 1U << k;
      }
      if (on == 3) block.corners[bits] = node;
    }
  }
}

void WallCells::draw() {
  complex.picture_points = mesh_.places;
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    std::array<std::int32_t, 3> v{};
    for (std::size_t k = 0; k < 3; ++k)
      v[k] = mesh_.tet(walls_[i] / 4)
                 .vertices[static_cast<std::size_t>(tet_face_vertices[static_cast<std::size_t>(walls_[i] % 4)][k])];
    complex.picture_triangles.emplace_back(v, patch_of_face_[i]);
  }
  for (std::size_t e = 0; e < edges_.size(); ++e)
    if (edges_[e].arc) complex.picture_lines.push_back({{edges_[e].a, edges_[e].b}, arc_of_edge_[e]});
}

}  // namespace hexfield::quantize
