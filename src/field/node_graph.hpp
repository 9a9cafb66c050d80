#pragma once

#include <mpi.h>
#include <petscsf.h>

#include <cstdint>
#include <span>
#include <vector>

#include "hexfield/field/octahedral_smoothing.hpp"

namespace hexfield {

/// The share of one rank: its owned nodes as rows, and the neighbours that other ranks own as ghosts.
/// Nodes are renumbered such that each rank owns a contiguous range; local columns: owned, then ghosts.
/// Owned nodes, and the neighbours in each row, keep the order of the whole graph: a sum over a row has the
/// same bits for any number of ranks.
class NodeGraph {
 public:
  /// Cuts `graph` (read on rank 0) with METIS between groups of nodes: `group` gives one of `num_groups` to each
  /// node. Deterministic for a fixed number of ranks. Collective.
  NodeGraph(MPI_Comm comm, const RootGraph& graph, const std::vector<std::int32_t>& group, std::int32_t num_groups);
  ~NodeGraph();
  NodeGraph(const NodeGraph&) = delete;
  NodeGraph& operator=(const NodeGraph&) = delete;

  MPI_Comm comm() const { return comm_; }
  std::size_t owned() const { return offsets.size() - 1; }
  std::size_t local() const { return owned() + num_ghosts_; }

  std::vector<std::int64_t> offsets{0};  ///< rows of the owned nodes
  std::vector<std::int32_t> columns;     ///< local ids
  std::vector<double> weights;

  /// `width` doubles per node from rank 0 (old order) to all local nodes. Collective.
  std::vector<double> scatter(std::span<const double> on_root, int width) const;
  /// Owned values to rank 0 in old order. Collective.
  std::vector<double> gather(std::span<const double> values, int width) const;
  /// Overwrites the ghosts. Collective.
  void update_ghosts(std::span<double> values, int width) const;

 private:
  MPI_Comm comm_;
  std::size_t num_ghosts_ = 0;
  std::int64_t num_global_ = 0;
  std::vector<std::int32_t> order_;  // rank 0: old id of each node, in the new order
  std::vector<int> counts_;          // owned nodes per rank
  PetscSF halo_ = nullptr;
};

}  // namespace hexfield
