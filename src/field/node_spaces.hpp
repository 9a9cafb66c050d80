#pragma once

#include <Eigen/Core>
#include <vector>

#include "hexfield/field/octahedral_smoothing.hpp"

namespace hexfield {

/// The linear space in which the vector (B numbers) of each node lies: everything for free nodes, zero for
/// fixed ones, the span of K orthonormal columns for aligned ones.
template <int B, int K>
struct NodeSpaces {
  using Vector = Eigen::Matrix<double, B, 1>;
  using Columns = Eigen::Matrix<double, B, K>;
  static constexpr std::int32_t free = -1;
  static constexpr std::int32_t fixed = -2;

  std::vector<std::int32_t> slot;  ///< per node: free, fixed or the place of its columns
  std::vector<Columns> columns;

  /// `columns_of` an aligned constraint.
  template <class ColumnsOf>
  NodeSpaces(const std::vector<NodeConstraint>& constraints, const ColumnsOf& columns_of) : slot(constraints.size()) {
    using Kind = NodeConstraint::Kind;
    for (std::size_t i = 0; i < slot.size(); ++i) {
      slot[i] = constraints[i].kind == Kind::free ? free : fixed;
      if (constraints[i].kind != Kind::aligned) continue;
      slot[i] = static_cast<std::int32_t>(columns.size());
      columns.push_back(columns_of(constraints[i]));
    }
  }

  const Columns& at(std::size_t i) const { return columns[static_cast<std::size_t>(slot[i])]; }
  /// Orthogonal projection onto the space of node i.
  Vector projected(std::size_t i, const Vector& x) const {
    if (slot[i] == free) return x;
    if (slot[i] == fixed) return Vector::Zero();
    return at(i) * (at(i).transpose() * x);
  }
};

}  // namespace hexfield
