#include "hexfield/mesh/aabb_tree.hpp"

#include <algorithm>
#include <numeric>

namespace hexfield {

AabbTree::AabbTree(const std::vector<Box>& boxes) : order_(boxes.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  if (!boxes.empty()) build(boxes, 0, static_cast<std::int32_t>(boxes.size()));
}

std::int32_t AabbTree::build(const std::vector<Box>& boxes, std::int32_t begin, std::int32_t end) {
  const auto index = static_cast<std::int32_t>(nodes_.size());
  Node node{{}, begin, end};
  Box centres;
  for (std::int32_t k = begin; k < end; ++k) {
    const Box& box = boxes[static_cast<std::size_t>(order_[static_cast<std::size_t>(k)])];
    node.box.extend(box);
    centres.extend(box.center());
  }
  nodes_.push_back(node);
  if (end - begin <= leaf_size) return index;
  Eigen::Index axis = 0;
  centres.sizes().maxCoeff(&axis);
  const std::int32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::int32_t a, std::int32_t b) {
                     const double x = boxes[static_cast<std::size_t>(a)].center()[axis];
                     const double y = boxes[static_cast<std::size_t>(b)].center()[axis];
                     return x != y ? x < y : a < b;
                   });
  build(boxes, begin, middle);
  const std::int32_t right = build(boxes, middle, end);
  nodes_[static_cast<std::size_t>(index)].right = right;
  return index;
}

}  // namespace hexfield
