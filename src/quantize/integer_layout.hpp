#pragma once

#include "hexfield/quantize/block_complex.hpp"

namespace hexfield::quantize {

/// An axis-aligned box, all sides closed.
struct IntegerBox {
  BlockComplex::Integer3 low{}, high{};

  bool meets(const IntegerBox& other) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (high[k] < other.low[k] || other.high[k] < low[k]) return false;
    return true;
  }
  void add(const BlockComplex::Integer3& x) {
    for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], x[k]), high[k] = std::max(high[k], x[k]);
  }
};

BlockComplex::Integer3 rotate(octahedral::Rotation r, const BlockComplex::Integer3& x);
IntegerBox rotate(octahedral::Rotation r, const IntegerBox& box);
/// The box moved by x.
IntegerBox moved(const IntegerBox& box, const BlockComplex::Integer3& x, int sign = 1);
BlockComplex::Integer3 step(octahedral::Label direction, std::int64_t length);

/// The blocks of a complex with integer arc lengths: every node's place in the chart of each of its blocks.
class IntegerLayout {
 public:
  /// Lengths that satisfy the equations of all patches.
  IntegerLayout(const BlockComplex& complex, const std::vector<std::int64_t>& lengths);

  const BlockComplex::Integer3& place(std::int32_t block, std::int32_t node) const;
  /// Place in the real layout, grid steps.
  const BlockComplex::Integer3& real_place(std::int32_t block, std::int32_t node) const;
  const IntegerBox& cuboid(std::int32_t block) const { return cuboids_[static_cast<std::size_t>(block)]; }
  /// Of a patch of the block, in the block's chart.
  const IntegerBox& rectangle(std::int32_t block, std::int32_t patch) const {
    const auto p = static_cast<std::size_t>(patch);
    return rectangles_[p][complex_.patches[p].blocks[0] == block ? 0 : 1];
  }
  std::int64_t length(std::int32_t arc) const { return lengths_[static_cast<std::size_t>(arc)]; }

 private:
  std::size_t entry(std::int32_t block, std::int32_t node) const;
  IntegerBox find_rectangle(std::int32_t block, std::int32_t patch) const;

  const BlockComplex& complex_;
  std::vector<std::int64_t> lengths_;
  std::vector<std::vector<BlockComplex::Integer3>> places_;  // beside Block::nodes
  std::vector<IntegerBox> cuboids_;
  std::vector<std::array<IntegerBox, 2>> rectangles_;  // beside Patch::blocks
};

}  // namespace hexfield::quantize
