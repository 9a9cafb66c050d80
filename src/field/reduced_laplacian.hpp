#pragma once

#include <petscksp.h>

#include <vector>

#include "hexfield/field/spherical_harmonics.hpp"
#include "node_graph.hpp"

namespace hexfield {

/// Per node an orthogonal-column basis B_i (9 x k_i) of the directions in which its harmonics vector may
/// move; k = 9 means the identity, k = 0 a fixed vector.
struct NodeBasis {
  int size = 0;
  Eigen::Matrix<double, 9, 9> columns;  ///< the first `size` are used; unused for size 9
};

struct LinearReport {
  int iterations = 0;
  double residual = 0;  ///< relative to the right-hand side
};

/// The matrix P^T (L x I_9) P of a graph Laplacian L, P = diag(B_i), and its solves: conjugate gradients
/// with algebraic multigrid, distributed. Its pattern is fixed by the sizes given to the constructor.
class ReducedLaplacian {
 public:
  /// `sizes`: k of every local node (ghosts included). Collective.
  ReducedLaplacian(const NodeGraph& graph, std::vector<int> sizes);
  ~ReducedLaplacian();
  ReducedLaplacian(const ReducedLaplacian&) = delete;
  ReducedLaplacian& operator=(const ReducedLaplacian&) = delete;

  /// Computes the values for these bases (all local nodes). With `keep_preconditioner` the multigrid
  /// hierarchy of the last values serves on. Collective.
  void set(const std::vector<NodeBasis>& bases, bool keep_preconditioner);
  /// Solves for x (k_i values per owned node, concatenated) to a relative residual. Collective.
  LinearReport solve(const std::vector<double>& rhs, std::vector<double>& x, double tolerance, int max_iterations);
  /// First unknown of an owned node in rhs and x.
  std::size_t start(std::size_t node) const { return static_cast<std::size_t>(starts_[node] - starts_[0]); }
  std::size_t num_owned_unknowns() const { return owned_unknowns_; }

 private:
  void build_pattern();
  void fill_row(std::size_t node, const std::vector<NodeBasis>& bases);

  const NodeGraph& graph_;
  std::vector<int> sizes_;
  std::vector<PetscInt> starts_;  // number of the first unknown of each local node
  std::size_t owned_unknowns_ = 0;
  std::vector<PetscInt> rows_, columns_;
  std::vector<double> values_;
  Mat matrix_ = nullptr;
  KSP solver_ = nullptr;
  PetscOptions options_ = nullptr;
};

}  // namespace hexfield
