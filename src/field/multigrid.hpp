#pragma once

#include <Eigen/Dense>

#include "hierarchy.hpp"
#include "node_spaces.hpp"

namespace hexfield {

/// V-cycles for the matrix P (L x I_B) P, with the graph Laplacian L and the projections P onto the node spaces:
/// smoothed aggregation whose coarser levels keep all B components, Chebyshev smoothing. On a coarser level
/// the matrix is (scalar) x I_B plus dense B x B blocks near aligned nodes. Fixed nodes have no unknowns.
/// Vectors have B numbers per local node. The same bits for any number of ranks and threads.
template <int B, int K>
class Multigrid {
 public:
  using Vector = Eigen::Matrix<double, B, 1>;
  using Block = Eigen::Matrix<double, B, B>;
  using Spaces = NodeSpaces<B, K>;

  /// `spaces` of the local nodes; `root_spaces` of all nodes, read on rank 0. All references must stay. Collective.
  Multigrid(const Hierarchy& hierarchy, const Spaces& spaces, const Spaces& root_spaces);

  /// y = P L x on owned nodes; x lies in the spaces, its ghosts are overwritten. Collective.
  void apply(std::vector<double>& x, std::vector<double>& y) const;
  /// One symmetric V-cycle for P L P x = b from x = 0; b lies in the spaces. Collective.
  void cycle(const std::vector<double>& b, std::vector<double>& x);

 private:
  struct Level {
    const SparseRows* matrix = nullptr;
    const SparseRows* prolongation = nullptr;  // to the level before; none on the first coarser level
    SparseRows restriction;
    std::vector<std::int32_t> block_of;  // per entry of the matrix; -1: none
    std::vector<Block> blocks;
    std::vector<double> inverse_diagonal;
    std::vector<std::int32_t> inverse_of;  // per row; -1: scalar
    std::vector<Block> inverses;
    double largest = 2;
    Eigen::MatrixXd pseudo_inverse;  // last level only, when it is small
    std::vector<double> x, b, r, d, t;
  };

  template <class Entry>
  static void add_blocks(const SparseRows& finer, const SparseRows& prolongation, const SparseRows& restriction,
                         const Entry& entry, Level& level);
  void first_blocks(const Spaces& root_spaces);
  static void invert_diagonal(Level& level);
  static void estimate_largest(Level& level);
  static void factor(Level& level);
  static void multiply(const Level& level, const std::vector<double>& x, std::vector<double>& y);
  static void scaled_by_inverse(const Level& level, const std::vector<double>& r, double factor, double keep,
                                std::vector<double>& d);
  static void smooth(Level& level, bool from_zero);
  void solve(std::size_t l);
  void smooth_fine(const std::vector<double>& b, std::vector<double>& x, bool from_zero);
  void restrict_fine(const std::vector<double>& b, std::vector<double>& x);

  const Hierarchy& hierarchy_;
  const Spaces& spaces_;
  std::vector<Level> levels_;
  std::vector<double> r_, d_, t_;  // on the nodes
};

extern template class Multigrid<3, 1>;
extern template class Multigrid<9, 2>;

}  // namespace hexfield
