#pragma once

#include <mpi.h>
#include <petscsf.h>

#include <cstdint>
#include <span>
#include <vector>

#include "hexfield/mesh/tet_mesh.hpp"

namespace hexfield {

/// One rank's share of a mesh that rank 0 holds: its owned tets (first) and one layer of ghost tets
/// across their faces, with everything in local ids. With one rank: all tets, no ghosts.
/// Owned tets ascend by global id, so do the ghosts, and so do the local vertices (those of local tets).
/// Tets keep the order of their vertices, so local face i of a tet is the same everywhere.
/// A face of a ghost whose other side is not local looks like a boundary face; owned tets have all neighbours.
/// Empty shares are legal (more ranks than tets).
/// Rank 0 sends the shares one after the other, so no other rank ever holds more than its share.
class DistributedMesh {
 public:
  /// Partitions the dual graph of `root_mesh` (read on rank 0 only, no tombstones) with METIS and sends
  /// every rank its share. Deterministic for a fixed number of ranks. `comm` must outlive the object. Collective.
  /// Throws Error(bug) on all ranks when the mesh has tombstones.
  DistributedMesh(MPI_Comm comm, const TetMesh& root_mesh);
  ~DistributedMesh();
  DistributedMesh(const DistributedMesh&) = delete;
  DistributedMesh& operator=(const DistributedMesh&) = delete;

  MPI_Comm comm() const { return comm_; }
  const TetMesh& local() const { return local_; }
  std::size_t num_owned() const { return num_owned_; }
  std::int64_t num_global_tets() const { return num_global_tets_; }
  std::int64_t num_global_vertices() const { return num_global_vertices_; }
  /// Id on rank 0 of each local tet / vertex.
  std::span<const std::int64_t> global_tets() const { return global_tets_; }
  std::span<const std::int64_t> global_vertices() const { return global_vertices_; }

  /// Copies per-tet values from rank 0 (`width` doubles per global tet) to all local tets. Collective.
  /// Throws Error(bug) on all ranks when a size is wrong on one.
  std::vector<double> scatter_tets(std::span<const double> on_root, int width) const;
  /// Collects owned values into global order on rank 0 (empty elsewhere). Collective.
  std::vector<double> gather_tets(std::span<const double> local, int width) const;
  /// Overwrites the ghosts of `values` (`width` doubles per local tet) with their owners' values. Collective.
  void update_ghosts(std::span<double> values, int width) const;

 private:
  MPI_Comm comm_;
  TetMesh local_;
  std::size_t num_owned_ = 0;
  std::int64_t num_global_tets_ = 0;
  std::int64_t num_global_vertices_ = 0;
  std::vector<std::int64_t> global_tets_;
  std::vector<std::int64_t> global_vertices_;
  PetscSF halo_ = nullptr;  // roots: owned tets, leaves: ghosts
  PetscSF root_ = nullptr;  // roots: tets on rank 0, leaves: owned tets
};

}  // namespace hexfield
