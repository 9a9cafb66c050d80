#include "share.hpp"

#include <algorithm>

namespace hexfield {
namespace {

constexpr int share_tag = 611;

// Pieces small enough that a count of bytes is always an int.
constexpr std::size_t piece_bytes = std::size_t{1} << 28;

template <class T>
void send_values(const std::vector<T>& values, int rank, MPI_Comm comm) {
  const auto bytes = static_cast<std::uint64_t>(values.size() * sizeof(T));
  MPI_Send(&bytes, 1, MPI_UINT64_T, rank, share_tag, comm);
  const char* data = reinterpret_cast<const char*>(values.data());
  for (std::size_t done = 0; done < bytes; done += piece_bytes)
    MPI_Send(data + done, static_cast<int>(std::min(piece_bytes, bytes - done)), MPI_BYTE, rank, share_tag, comm);
}

template <class T>
void receive_values(std::vector<T>& values, int from, MPI_Comm comm) {
  std::uint64_t bytes = 0;
  MPI_Recv(&bytes, 1, MPI_UINT64_T, from, share_tag, comm, MPI_STATUS_IGNORE);
  values.resize(bytes / sizeof(T));
  char* data = reinterpret_cast<char*>(values.data());
  for (std::size_t done = 0; done < bytes; done += piece_bytes)
    MPI_Recv(data + done, static_cast<int>(std::min(piece_bytes, bytes - done)), MPI_BYTE, from, share_tag, comm,
             MPI_STATUS_IGNORE);
}

}  // namespace

ShareCutter::ShareCutter(const TetMesh& mesh, std::vector<int> part, int ranks)
    : mesh_(mesh),
      part_(std::move(part)),
      owned_(static_cast<std::size_t>(ranks)),
      index_(mesh.num_tets()),
      local_tet_(mesh.num_tets(), -1),
      local_vertex_(mesh.num_vertices(), -1) {
  for (std::size_t t = 0; t < mesh.num_tets(); ++t) {
    auto& list = owned_[static_cast<std::size_t>(part_[t])];
    index_[t] = static_cast<std::int32_t>(list.size());
    list.emplace_back(static_cast<std::int64_t>(t));
  }
}

void ShareCutter::number_tets(int rank, Share& share) {
  const auto& owned = owned_[static_cast<std::size_t>(rank)];
  std::vector<TetId> ghosts;
  for (TetId t : owned)
    for (HalfFaceId h : mesh_.opposite[t.index()])
      if (h.valid() && part_[h.tet().index()] != rank) ghosts.push_back(h.tet());
  std::sort(ghosts.begin(), ghosts.end());
  ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
  share.num_owned = static_cast<std::int64_t>(owned.size());
  for (const auto* list : {&owned, static_cast<const std::vector<TetId>*>(&ghosts)})
    for (TetId t : *list) {
      local_tet_[t.index()] = static_cast<std::int32_t>(share.global_tets.size());
      share.global_tets.push_back(t.value);
    }
  for (TetId t : ghosts) share.ghost_owners.push_back({part_[t.index()], index_[t.index()]});
}

void ShareCutter::number_vertices(Share& share) {
  for (std::int64_t t : share.global_tets)
    for (VertexId v : mesh_.vertices(TetId(t))) share.global_vertices.push_back(v.value);
  std::sort(share.global_vertices.begin(), share.global_vertices.end());
  share.global_vertices.erase(std::unique(share.global_vertices.begin(), share.global_vertices.end()),
                              share.global_vertices.end());
  for (std::int64_t v : share.global_vertices) {
    local_vertex_[VertexId(v).index()] = static_cast<std::int32_t>(share.points.size());
    share.points.push_back(mesh_.point(VertexId(v)));
  }
}

Share ShareCutter::cut(int rank) {
  Share share;
  number_tets(rank, share);
  number_vertices(share);
  for (std::int64_t global : share.global_tets) {
    const TetId t(global);
    auto& vertices = share.tets.emplace_back();
    auto& opposite = share.opposite.emplace_back();
    for (std::size_t i = 0; i < 4; ++i) {
      vertices[i] = VertexId(local_vertex_[mesh_.vertices(t)[i].index()]);
      const HalfFaceId h = mesh_.opposite[t.index()][i];
      if (h.valid() && local_tet_[h.tet().index()] >= 0)
        opposite[i] = HalfFaceId(TetId(local_tet_[h.tet().index()]), h.local());
    }
  }
  for (std::int64_t t : share.global_tets) local_tet_[TetId(t).index()] = -1;
  for (std::int64_t v : share.global_vertices) local_vertex_[VertexId(v).index()] = -1;
  return share;
}

void send_share(const Share& share, int rank, MPI_Comm comm) {
  send_values(std::vector<std::int64_t>{share.num_owned}, rank, comm);
  send_values(share.tets, rank, comm);
  send_values(share.opposite, rank, comm);
  send_values(share.points, rank, comm);
  send_values(share.global_tets, rank, comm);
  send_values(share.global_vertices, rank, comm);
  send_values(share.ghost_owners, rank, comm);
}

Share receive_share(int from, MPI_Comm comm) {
  Share share;
  std::vector<std::int64_t> num_owned;
  receive_values(num_owned, from, comm);
  share.num_owned = num_owned.at(0);
  receive_values(share.tets, from, comm);
  receive_values(share.opposite, from, comm);
  receive_values(share.points, from, comm);
  receive_values(share.global_tets, from, comm);
  receive_values(share.global_vertices, from, comm);
  receive_values(share.ghost_owners, from, comm);
  return share;
}

}  // namespace hexfield
