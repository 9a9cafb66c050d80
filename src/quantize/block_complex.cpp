#include "hexfield/quantize/block_complex.hpp"

#include <fmt/core.h>

#include <cmath>
#include <numeric>

namespace hexfield {

double BlockComplex::length(std::size_t arc) const {
  return std::ldexp(static_cast<double>(arcs[arc].length), -grid_exponent);
}

std::int64_t BlockComplex::euler() const {
  return static_cast<std::int64_t>(nodes.size()) - static_cast<std::int64_t>(arcs.size()) +
         static_cast<std::int64_t>(patches.size()) - static_cast<std::int64_t>(blocks.size());
}

namespace {

class Checker {
 public:
  explicit Checker(const BlockComplex& complex) : c_(complex) {}

  std::vector<Violation> run() {
    for (std::size_t p = 0; p < c_.patches.size(); ++p) check_patch(p);
    for (std::size_t b = 0; b < c_.blocks.size(); ++b) check_block(b);
    check_arcs();
    return std::move(found_);
  }

 private:
  void report(const char* what, const char* kind, std::size_t id, std::int32_t node) {
    std::vector<Vec3> places;
    if (node >= 0) places.push_back(c_.nodes[static_cast<std::size_t>(node)].place);
    found_.push_back({fmt::format("{} {}: {}", kind, id, what), {static_cast<std::int64_t>(id)}, std::move(places)});
  }
  std::int64_t sum(const std::vector<std::int32_t>& arcs) const {
    std::int64_t length = 0;
    for (std::int32_t a : arcs) length += c_.arcs[static_cast<std::size_t>(a)].length;
    return length;
  }

  void check_patch(std::size_t p) {
    const auto& patch = c_.patches[p];
    const std::int32_t node = some_node(patch);
    if (patch.blocks[0] < 0) return report("it bounds no block.", "Patch", p, node);
    int used = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto& low = patch.sides[2 * axis + 1];
      const auto& high = patch.sides[2 * axis];
      if (low.empty() != high.empty() || sum(low) != sum(high)) report("opposite sides differ.", "Patch", p, node);
      if (!low.empty()) ++used;
      if (!low.empty() && static_cast<int>(axis) == octahedral::axis(patch.normals[0]))
        report("a side runs across its plane.", "Patch", p, node);
    }
    if (used != 2) report("it has not four sides.", "Patch", p, node);
  }
  std::int32_t some_node(const BlockComplex::Patch& patch) const {
    for (const auto& side : patch.sides)
      for (std::int32_t a : side) return c_.arcs[static_cast<std::size_t>(a)].nodes[0];
    return -1;
  }

  void check_block(std::size_t b) {
    const auto& block = c_.blocks[b];
    const std::int32_t node = block.nodes.empty() ? -1 : block.nodes[0].first;
    for (std::size_t e = 0; e < 12; ++e)
      if (sum(block.edges[e]) != block.high[e / 4] - block.low[e / 4])
        report("one of its twelve edges has not the length of the block.", "Block", b, node);
    for (std::int32_t n : block.corners)
      if (n < 0) report("a corner is no node.", "Block", b, node);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (block.high[axis] <= block.low[axis]) report("it is flat.", "Block", b, node);
      for (std::size_t f : {2 * axis, 2 * axis + 1}) check_face(b, f, node);
    }
    for (const auto& [n, x] : block.nodes) {
      bool on_hull = false;
      for (std::size_t k = 0; k < 3; ++k) on_hull = on_hull || x[k] == block.low[k] || x[k] == block.high[k];
      if (!on_hull) report("a node lies inside.", "Block", b, n);
    }
  }
  // The patches of a face cover its area; sides are taken from the patch, whichever block it is told in.
  void check_face(std::size_t b, std::size_t f, std::int32_t node) {
    const auto& block = c_.blocks[b];
    const std::size_t axis = f / 2;
    const auto extent = [&](std::size_t k) { return static_cast<long double>(block.high[k] - block.low[k]); };
    long double area = 0;
    for (std::int32_t p : block.faces[f]) {
      long double product = 1;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto& side = c_.patches[static_cast<std::size_t>(p)].sides[2 * k];
        if (!side.empty()) product *= static_cast<long double>(sum(side));
      }
      area += product;
    }
    const long double whole = extent((axis + 1) % 3) * extent((axis + 2) % 3);
    if (std::abs(area - whole) > 1e-12L * whole) report("its patches do not cover a face.", "Block", b, node);
  }

  void check_arcs() {
    std::vector<int> singular(c_.nodes.size(), 0);
    std::vector<char> boundary(c_.nodes.size(), 0);
    std::vector<int> degree(c_.nodes.size(), 0);
    for (std::size_t a = 0; a < c_.arcs.size(); ++a) {
      const auto& arc = c_.arcs[a];
      if (arc.length <= 0) report("its length is not positive.", "Arc", a, arc.nodes[0]);
      for (std::int32_t n : arc.nodes) {
        ++degree[static_cast<std::size_t>(n)];
        singular[static_cast<std::size_t>(n)] += arc.singular;
        if (arc.boundary) boundary[static_cast<std::size_t>(n)] = 1;
      }
    }
    for (std::size_t n = 0; n < c_.nodes.size(); ++n) {
      if (degree[n] < 2) report("it ends an arc alone.", "Node", n, static_cast<std::int32_t>(n));
      if (boundary[n] == 0 && singular[n] == 1)
        report("a singular arc ends inside.", "Node", n, static_cast<std::int32_t>(n));
    }
  }

  const BlockComplex& c_;
  std::vector<Violation> found_;
};

}  // namespace

std::vector<Violation> check(const BlockComplex& complex) { return Checker(complex).run(); }

}  // namespace hexfield
