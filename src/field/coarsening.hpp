#pragma once

#include <vector>

#include "hexfield/field/octahedral_smoothing.hpp"
#include "sparse_rows.hpp"

namespace hexfield {

/// One step of smoothed aggregation [Vanek, Mandel and Brezina 1996] for the Laplacian of a graph.
struct Coarsening {
  std::vector<std::int32_t> aggregate;  ///< per finer node; -1 where it has no unknown
  SparseRows prolongation;              ///< rows: finer nodes
  SparseRows matrix;                    ///< of the coarser nodes: prolongation^T (finer matrix) prolongation
};

/// Laplacian of the graph; rows and columns of `fixed` nodes are empty, their weights stay in the diagonals.
SparseRows laplacian(const RootGraph& graph, const std::vector<char>& fixed);
/// Coarser and coarser matrices until one has at most `smallest` rows, or hardly gets smaller. Deterministic,
/// the same for any number of threads. Not collective.
std::vector<Coarsening> coarsen(const SparseRows& fine, std::size_t smallest);

}  // namespace hexfield
