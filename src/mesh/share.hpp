#pragma once

#include <mpi.h>
#include <petscsf.h>

#include <cstdint>
#include <vector>

#include "hexfield/mesh/tet_mesh.hpp"

namespace hexfield {

/// What one rank gets of a mesh, in its local ids (see DistributedMesh).
struct Share {
  std::vector<std::array<VertexId, 4>> tets;
  std::vector<std::array<HalfFaceId, 4>> opposite;
  std::vector<Vec3> points;
  std::vector<std::int64_t> global_tets;
  std::vector<std::int64_t> global_vertices;
  std::vector<PetscSFNode> ghost_owners;  ///< rank and local id there of each ghost
  std::int64_t num_owned = 0;
};

/// Cuts the shares of a partitioned mesh, one rank at a time, on the rank that holds the mesh.
class ShareCutter {
 public:
  /// part[t] is the rank of tet t. The mesh must outlive the object.
  ShareCutter(const TetMesh& mesh, std::vector<int> part, int ranks);
  Share cut(int rank);

 private:
  void number_tets(int rank, Share& share);
  void number_vertices(Share& share);

  const TetMesh& mesh_;
  std::vector<int> part_;
  std::vector<std::vector<TetId>> owned_;   // per rank, ascending
  std::vector<std::int32_t> index_;         // of each tet in its owner's list
  std::vector<std::int32_t> local_tet_;     // -1 between two calls of cut()
  std::vector<std::int32_t> local_vertex_;  // -1 between two calls of cut()
};

void send_share(const Share& share, int rank, MPI_Comm comm);
Share receive_share(int from, MPI_Comm comm);

}  // namespace hexfield
