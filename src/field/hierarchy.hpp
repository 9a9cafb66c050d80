#pragma once

#include <memory>

#include "coarsening.hpp"
#include "node_graph.hpp"

namespace hexfield {

/// The graph of a field cut for the ranks along the aggregates of its Laplacian, with all coarser matrices.
/// Coarser levels live on every rank (about a tenth of the graph); the same bits for any number of ranks.
class Hierarchy {
 public:
  /// Graph and constraints are read on rank 0. Collective.
  Hierarchy(MPI_Comm comm, const RootGraph& graph, const std::vector<NodeConstraint>& constraints);

  const NodeGraph& graph() const { return *graph_; }
  std::vector<double> diagonal;      ///< of the Laplacian, per owned node
  double largest = 2;                ///< bound of the eigenvalues of (diagonal)^-1 Laplacian
  SparseRows interpolation;          ///< rows: owned nodes, columns: first coarser level
  SparseRows restriction;            ///< rows: first coarser level, those of this rank filled; columns: local nodes
  std::vector<SparseRows> matrices;  ///< of the coarser levels
  std::vector<SparseRows> prolongations;  ///< from each coarser level to the one before, without the first
  SparseRows root_matrix;                 ///< rank 0: the Laplacian
  SparseRows root_interpolation;          ///< rank 0: rows are all nodes

 private:
  void distribute(MPI_Comm comm);

  std::unique_ptr<NodeGraph> graph_;
};

}  // namespace hexfield
