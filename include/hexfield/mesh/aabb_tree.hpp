#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "hexfield/base/geometry.hpp"

namespace hexfield {

/// Axis-aligned bounding boxes of primitives 0..n-1 in one flat array; the owner of the primitives
/// measures them. The tree and every answer depend on the primitives only, not on threads or addresses.
class AabbTree {
 public:
  using Box = Eigen::AlignedBox3d;

  struct Nearest {
    std::int32_t primitive = -1;
    double squared_distance = std::numeric_limits<double>::infinity();
  };

  AabbTree() = default;
  explicit AabbTree(const std::vector<Box>& boxes);

  bool empty() const { return nodes_.empty(); }

  /// The primitive with the smallest squared_distance(primitive); the lowest id wins ties. squared_distance
  /// must be that of `p` to something inside the box of the primitive.
  template <class SquaredDistance>
  Nearest nearest(const Vec3& p, const SquaredDistance& squared_distance) const;

  /// Calls visit(primitive) once for every primitive whose box meets `box`, and for some near it, in a fixed order.
  template <class Visit>
  void overlapping(const Box& box, const Visit& visit) const;

 private:
  struct Node {
    Box box;
    std::int32_t begin, end;  // range of order_
    std::int32_t right = -1;  // second child, the first is the next node; -1 in leaves
  };
  static constexpr std::int32_t leaf_size = 4;
  static constexpr std::size_t max_depth = 64;

  std::int32_t build(const std::vector<Box>& boxes, std::int32_t begin, std::int32_t end);

  std::vector<Node> nodes_;
  std::vector<std::int32_t> order_;
};

template <class SquaredDistance>
AabbTree::Nearest AabbTree::nearest(const Vec3& p, const SquaredDistance& squared_distance) const {
  Nearest best;
  if (empty()) return best;
  struct Pending {
    std::int32_t node;
    double squared_distance;
  };
  std::array<Pending, max_depth> stack;
  std::size_t top = 0;
  stack[top++] = {0, nodes_[0].box.squaredExteriorDistance(p)};
  while (top > 0) {
    const Pending next = stack[--top];
    if (next.squared_distance > best.squared_distance) continue;
    const Node& node = nodes_[static_cast<std::size_t>(next.node)];
    if (node.right >= 0) {
      Pending near{next.node + 1, nodes_[static_cast<std::size_t>(next.node) + 1].box.squaredExteriorDistance(p)};
      Pending far{node.right, nodes_[static_cast<std::size_t>(node.right)].box.squaredExteriorDistance(p)};
      if (far.squared_distance < near.squared_distance) std::swap(near, far);
      stack[top++] = far;
      stack[top++] = near;
      continue;
    }
    for (std::int32_t k = node.begin; k < node.end; ++k) {
      const std::int32_t primitive = order_[static_cast<std::size_t>(k)];
      const double d = squared_distance(primitive);
      if (d < best.squared_distance || (d == best.squared_distance && primitive < best.primitive))
        best = {primitive, d};
    }
  }
  return best;
}

template <class Visit>
void AabbTree::overlapping(const Box& box, const Visit& visit) const {
  if (empty()) return;
  std::array<std::int32_t, max_depth> stack;
  std::size_t top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const std::int32_t index = stack[--top];
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    if (!node.box.intersects(box)) continue;
    if (node.right >= 0) {
      stack[top++] = node.right;
      stack[top++] = index + 1;
      continue;
    }
    for (std::int32_t k = node.begin; k < node.end; ++k) visit(order_[static_cast<std::size_t>(k)]);
  }
}

}  // namespace hexfield
