#include "hexfield/mesh/distributed.hpp"

#include "hexfield/base/agree.hpp"
#include "hexfield/base/petsc.hpp"
#include "hexfield/mesh/partition.hpp"
#include "share.hpp"

namespace hexfield {
namespace {

int rank_of(MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  return rank;
}

int size_of(MPI_Comm comm) {
  int size = 1;
  MPI_Comm_size(comm, &size);
  return size;
}

// `width` doubles as one MPI unit, so that counts are counts of tets.
class Block {
 public:
  explicit Block(int width) {
    MPI_Type_contiguous(width, MPI_DOUBLE, &type_);
    MPI_Type_commit(&type_);
  }
  ~Block() { MPI_Type_free(&type_); }
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;
  operator MPI_Datatype() const { return type_; }

 private:
  MPI_Datatype type_ = MPI_DATATYPE_NULL;
};

Share distribute(MPI_Comm comm, const TetMesh& mesh) {
  const int ranks = size_of(comm);
  if (rank_of(comm) != 0) {
    agree(comm, [] {});
    return receive_share(0, comm);
  }
  std::vector<int> part;
  agree(comm, [&] {
    for (const auto& tet : mesh.tets) require(tet[0].valid(), "A mesh with tombstones cannot be distributed.");
    part = partition_tets(mesh, ranks);
  });
  ShareCutter cutter(mesh, std::move(part), ranks);
  for (int rank = 1; rank < ranks; ++rank) send_share(cutter.cut(rank), rank, comm);
  return cutter.cut(0);
}

PetscSF star_forest(MPI_Comm comm, std::int64_t roots, std::size_t first_leaf, std::vector<PetscSFNode> remote) {
  std::vector<PetscInt> leaves(remote.size());
  for (std::size_t i = 0; i < leaves.size(); ++i) leaves[i] = static_cast<PetscInt>(first_leaf + i);
  PetscSF sf = nullptr;
  check_petsc(PetscSFCreate(comm, &sf), "PetscSFCreate");
  check_petsc(PetscSFSetGraph(sf, static_cast<PetscInt>(roots), static_cast<PetscInt>(leaves.size()), leaves.data(),
                              PETSC_COPY_VALUES, remote.data(), PETSC_COPY_VALUES),
              "PetscSFSetGraph");
  check_petsc(PetscSFSetUp(sf), "PetscSFSetUp");
  return sf;
}

void broadcast(PetscSF sf, int width, const double* roots, double* leaves) {
  const Block block(width);
  check_petsc(PetscSFBcastBegin(sf, block, roots, leaves, MPI_REPLACE), "PetscSFBcastBegin");
  check_petsc(PetscSFBcastEnd(sf, block, roots, leaves, MPI_REPLACE), "PetscSFBcastEnd");
}

bool has_size(std::span<const double> values, std::int64_t tets, int width) {
  return width > 0 && values.size() == static_cast<std::size_t>(tets) * static_cast<std::size_t>(width);
}

}  // namespace

DistributedMesh::DistributedMesh(MPI_Comm comm, const TetMesh& root_mesh) : comm_(comm) {
  Share share = distribute(comm, root_mesh);
  std::int64_t totals[2] = {static_cast<std::int64_t>(root_mesh.num_tets()),
                            static_cast<std::int64_t>(root_mesh.num_vertices())};
  MPI_Bcast(totals, 2, MPI_INT64_T, 0, comm);
  num_global_tets_ = totals[0];
  num_global_vertices_ = totals[1];
  num_owned_ = static_cast<std::size_t>(share.num_owned);
  local_.tets = std::move(share.tets);
  local_.opposite = std::move(share.opposite);
  local_.points = std::move(share.points);
  local_.vertex_tet.resize(local_.points.size());
  for (std::size_t t = local_.num_tets(); t-- > 0;)
    for (VertexId v : local_.tets[t]) local_.vertex_tet[v.index()] = TetId(static_cast<std::int64_t>(t));
  global_tets_ = std::move(share.global_tets);
  global_vertices_ = std::move(share.global_vertices);

  std::vector<PetscSFNode> on_root(num_owned_);
  for (std::size_t t = 0; t < num_owned_; ++t) on_root[t] = {0, static_cast<PetscInt>(global_tets_[t])};
  halo_ = star_forest(comm, share.num_owned, num_owned_, share.ghost_owners);
  root_ = star_forest(comm, rank_of(comm) == 0 ? num_global_tets_ : 0, 0, on_root);
}

DistributedMesh::~DistributedMesh() {
  PetscSFDestroy(&halo_);
  PetscSFDestroy(&root_);
}

std::vector<double> DistributedMesh::scatter_tets(std::span<const double> on_root, int width) const {
  agree(comm_, [&] {
    require(width > 0 && (rank_of(comm_) != 0 || has_size(on_root, num_global_tets_, width)),
            "Values to scatter have the wrong size.");
  });
  std::vector<double> local(local_.num_tets() * static_cast<std::size_t>(width));
  broadcast(root_, width, on_root.data(), local.data());
  update_ghosts(local, width);
  return local;
}

std::vector<double> DistributedMesh::gather_tets(std::span<const double> local, int width) const {
  agree(comm_, [&] {
    require(has_size(local, static_cast<std::int64_t>(local_.num_tets()), width),
            "Values to gather have the wrong size.");
  });
  std::vector<double> on_root;
  if (rank_of(comm_) == 0) on_root.resize(static_cast<std::size_t>(num_global_tets_) * static_cast<std::size_t>(width));
  const Block block(width);
  check_petsc(PetscSFReduceBegin(root_, block, local.data(), on_root.data(), MPI_REPLACE), "PetscSFReduceBegin");
  check_petsc(PetscSFReduceEnd(root_, block, local.data(), on_root.data(), MPI_REPLACE), "PetscSFReduceEnd");
  return on_root;
}

void DistributedMesh::update_ghosts(std::span<double> values, int width) const {
  require(has_size(values, static_cast<std::int64_t>(local_.num_tets()), width),
          "Values to exchange with the neighbours have the wrong size.");
  broadcast(halo_, width, values.data(), values.data());
}

}  // namespace hexfield
