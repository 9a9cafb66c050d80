#include "integer_layout.hpp"

#include <algorithm>

namespace hexfield::quantize {

using octahedral::Label;
using Integer3 = BlockComplex::Integer3;

Integer3 rotate(octahedral::Rotation r, const Integer3& x) {
  Integer3 y{};
  for (Label k = 0; k < 3; ++k) {
    const Label to = octahedral::image(r, static_cast<Label>(2 * k));
    y[to / 2] = (to & 1) != 0 ? -x[k] : x[k];
  }
  return y;
}

IntegerBox rotate(octahedral::Rotation r, const IntegerBox& box) {
  const Integer3 a = rotate(r, box.low);
  IntegerBox turned{a, a};
  turned.add(rotate(r, box.high));
  return turned;
}

IntegerBox moved(const IntegerBox& box, const Integer3& x, int sign) {
  IntegerBox result = box;
  for (std::size_t k = 0; k < 3; ++k) result.low[k] += sign * x[k], result.high[k] += sign * x[k];
  return result;
}

Integer3 step(Label direction, std::int64_t length) {
  Integer3 x{};
  x[direction / 2] = (direction & 1) != 0 ? -length : length;
  return x;
}

IntegerLayout::IntegerLayout(const BlockComplex& complex, const std::vector<std::int64_t>& lengths)
    : complex_(complex), lengths_(lengths), places_(complex.blocks.size()), cuboids_(complex.blocks.size()) {
  for (std::size_t b = 0; b < complex.blocks.size(); ++b) {
    const auto& block = complex.blocks[b];
    auto& places = places_[b];
    places.assign(block.nodes.size(), {});
    std::vector<std::vector<std::pair<std::size_t, Integer3>>> next(block.nodes.size());
    for (const auto& [arc, along] : block.arcs) {
      const auto& ends = complex.arcs[static_cast<std::size_t>(arc)].nodes;
      const std::size_t from = entry(static_cast<std::int32_t>(b), ends[0]);
      const std::size_t to = entry(static_cast<std::int32_t>(b), ends[1]);
      next[from].emplace_back(to, step(along, lengths[static_cast<std::size_t>(arc)]));
      next[to].emplace_back(from, step(along, -lengths[static_cast<std::size_t>(arc)]));
    }
    std::vector<char> reached(block.nodes.size(), 0);
    std::vector<std::size_t> stack{0};
    reached[0] = 1;
    cuboids_[b] = {places[0], places[0]};
    for (std::size_t k = 0; k < stack.size(); ++k)
      for (const auto& [to, d] : next[stack[k]]) {
        if (std::exchange(reached[to], 1) != 0) continue;
        for (std::size_t i = 0; i < 3; ++i) places[to][i] = places[stack[k]][i] + d[i];
        cuboids_[b].add(places[to]);
        stack.push_back(to);
      }
    require(stack.size() == block.nodes.size(), "The arcs of a block are not connected.");
  }
  rectangles_.resize(complex.patches.size());
  for (std::size_t p = 0; p < complex.patches.size(); ++p)
    for (std::size_t s = 0; s < 2; ++s)
      if (complex.patches[p].blocks[s] >= 0)
        rectangles_[p][s] = find_rectangle(complex.patches[p].blocks[s], static_cast<std::int32_t>(p));
}

std::size_t IntegerLayout::entry(std::int32_t block, std::int32_t node) const {
  const auto& nodes = complex_.blocks[static_cast<std::size_t>(block)].nodes;
  const auto found =
      std::lower_bound(nodes.begin(), nodes.end(), node, [](const auto& e, std::int32_t n) { return e.first < n; });
  require(found != nodes.end() && found->first == node, "A node is not on the block it is looked for on.");
  return static_cast<std::size_t>(found - nodes.begin());
}

const Integer3& IntegerLayout::place(std::int32_t block, std::int32_t node) const {
  return places_[static_cast<std::size_t>(block)][entry(block, node)];
}

const Integer3& IntegerLayout::real_place(std::int32_t block, std::int32_t node) const {
  return complex_.blocks[static_cast<std::size_t>(block)].nodes[entry(block, node)].second;
}

IntegerBox IntegerLayout::find_rectangle(std::int32_t block, std::int32_t patch) const {
  bool first = true;
  IntegerBox box;
  for (const auto& side : complex_.patches[static_cast<std::size_t>(patch)].sides)
    for (std::int32_t a : side)
      for (std::int32_t n : complex_.arcs[static_cast<std::size_t>(a)].nodes) {
        const Integer3& x = place(block, n);
        if (first) box = {x, x};
        first = false;
        box.add(x);
      }
  return box;
}

}  // namespace hexfield::quantize
