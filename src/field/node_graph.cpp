#include "node_graph.hpp"

#include <metis.h>

#include <algorithm>
#include <numeric>

#include "hexfield/base/agree.hpp"
#include "hexfield/base/error.hpp"
#include "hexfield/base/petsc.hpp"

namespace hexfield {
namespace {

// The groups as nodes of a graph: which ones share an edge, and how many nodes each has.
struct GroupGraph {
  std::vector<idx_t> offsets{0}, columns, sizes;
};

GroupGraph grouped(const RootGraph& graph, const std::vector<std::int32_t>& group, std::int32_t num_groups) {
  const auto n = static_cast<std::size_t>(num_groups);
  std::vector<std::pair<std::int32_t, std::int32_t>> members(graph.size());
  for (std::size_t i = 0; i < graph.size(); ++i) members[i] = {group[i], static_cast<std::int32_t>(i)};
  std::sort(members.begin(), members.end());
  GroupGraph g;
  g.sizes.assign(n, 0);
  std::vector<std::int32_t> seen_by(n, -1);
  auto member = members.begin();
  for (std::int32_t own = 0; own < num_groups; ++own) {
    seen_by[static_cast<std::size_t>(own)] = own;
    for (; member != members.end() && member->first == own; ++member) {
      const auto i = static_cast<std::size_t>(member->second);
      ++g.sizes[static_cast<std::size_t>(own)];
      for (auto k = graph.offsets[i]; k < graph.offsets[i + 1]; ++k) {
        const auto other =
            static_cast<std::size_t>(group[static_cast<std::size_t>(graph.neighbours[static_cast<std::size_t>(k)])]);
        if (seen_by[other] == own) continue;
        seen_by[other] = own;
        g.columns.push_back(static_cast<idx_t>(other));
      }
    }
    g.offsets.push_back(static_cast<idx_t>(g.columns.size()));
  }
  return g;
}

// Part of every group.
std::vector<idx_t> partition(const RootGraph& graph, const std::vector<std::int32_t>& group, std::int32_t num_groups,
                             int ranks) {
  idx_t n = num_groups;
  std::vector<idx_t> part(static_cast<std::size_t>(n), 0);
  if (ranks == 1 || n == 0) return part;
  if (n <= 8 * ranks) {  // METIS may refuse graphs with fewer nodes than parts
    for (idx_t i = 0; i < n; ++i) part[static_cast<std::size_t>(i)] = static_cast<idx_t>(i * ranks / n);
    return part;
  }
  GroupGraph g = grouped(graph, group, num_groups);
  idx_t constraints = 1, parts = ranks, cut = 0;
  const int code = METIS_PartGraphKway(&n, &constraints, g.offsets.data(), g.columns.data(), g.sizes.data(), nullptr,
                                       nullptr, &parts, nullptr, nullptr, nullptr, &cut, part.data());
  require(code == METIS_OK, "METIS could not cut the graph of the field.");
  return part;
}

template <class T>
void send(const std::vector<T>& values, int rank, MPI_Comm comm) {
  std::int64_t n = static_cast<std::int64_t>(values.size());
  MPI_Send(&n, 1, MPI_INT64_T, rank, 7, comm);
  MPI_Send(values.data(), static_cast<int>(n * static_cast<std::int64_t>(sizeof(T))), MPI_BYTE, rank, 8, comm);
}

template <class T>
std::vector<T> receive(MPI_Comm comm) {
  std::int64_t n = 0;
  MPI_Recv(&n, 1, MPI_INT64_T, 0, 7, comm, MPI_STATUS_IGNORE);
  std::vector<T> values(static_cast<std::size_t>(n));
  MPI_Recv(values.data(), static_cast<int>(n * static_cast<std::int64_t>(sizeof(T))), MPI_BYTE, 0, 8, comm,
           MPI_STATUS_IGNORE);
  return values;
}

struct Rows {
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int64_t> columns;  // new numbers
  std::vector<double> weights;
};

Rows cut_rows(const RootGraph& graph, const std::vector<std::int32_t>& order, const std::vector<std::int64_t>& number,
              std::int64_t begin, std::int64_t end) {
  Rows rows;
  for (std::int64_t i = begin; i < end; ++i) {
    const auto old = static_cast<std::size_t>(order[static_cast<std::size_t>(i)]);
    for (auto k = static_cast<std::size_t>(graph.offsets[old]); k < static_cast<std::size_t>(graph.offsets[old + 1]);
         ++k) {
      rows.columns.push_back(number[static_cast<std::size_t>(graph.neighbours[k])]);
      rows.weights.push_back(graph.weights[k]);
    }
    rows.offsets.push_back(static_cast<std::int64_t>(rows.columns.size()));
  }
  return rows;
}

}  // namespace

NodeGraph::NodeGraph(MPI_Comm comm, const RootGraph& graph, const std::vector<std::int32_t>& group,
                     std::int32_t num_groups)
    : comm_(comm) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &ranks);
  counts_.assign(static_cast<std::size_t>(ranks), 0);
  std::vector<std::int64_t> number;
  agree(comm, [&] {
    if (rank != 0) return;
    const std::vector<idx_t> part_of_group = partition(graph, group, num_groups, ranks);
    std::vector<idx_t> part(graph.size());
    for (std::size_t i = 0; i < part.size(); ++i) part[i] = part_of_group[static_cast<std::size_t>(group[i])];
    order_.resize(graph.size());
    std::iota(order_.begin(), order_.end(), 0);
    std::stable_sort(order_.begin(), order_.end(), [&](std::int32_t a, std::int32_t b) {
      return part[static_cast<std::size_t>(a)] < part[static_cast<std::size_t>(b)];
    });
    number.resize(graph.size());
    for (std::size_t i = 0; i < order_.size(); ++i)
      number[static_cast<std::size_t>(order_[i])] = static_cast<std::int64_t>(i);
    for (idx_t p : part) ++counts_[static_cast<std::size_t>(p)];
  });
  MPI_Bcast(counts_.data(), ranks, MPI_INT, 0, comm);
  std::vector<std::int64_t> starts(counts_.size() + 1, 0);
  std::partial_sum(counts_.begin(), counts_.end(), starts.begin() + 1,
                   [](std::int64_t sum, int count) { return sum + count; });
  num_global_ = starts.back();
  const std::int64_t first = starts[static_cast<std::size_t>(rank)];
  Rows rows;
  if (rank == 0) {
    for (int r = 1; r < ranks; ++r) {
      const Rows theirs =
          cut_rows(graph, order_, number, starts[static_cast<std::size_t>(r)], starts[static_cast<std::size_t>(r) + 1]);
      send(theirs.offsets, r, comm), send(theirs.columns, r, comm), send(theirs.weights, r, comm);
    }
    rows = cut_rows(graph, order_, number, 0, starts[1]);
  } else {
    rows.offsets = receive<std::int64_t>(comm);
    rows.columns = receive<std::int64_t>(comm);
    rows.weights = receive<double>(comm);
  }
  const std::int64_t last = first + counts_[static_cast<std::size_t>(rank)];
  std::vector<std::int64_t> ghosts;
  for (std::int64_t c : rows.columns)
    if (c < first || c >= last) ghosts.push_back(c);
  std::sort(ghosts.begin(), ghosts.end());
  ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
  num_ghosts_ = ghosts.size();
  const auto num_owned = static_cast<std::int64_t>(rows.offsets.size()) - 1;
  columns.resize(rows.columns.size());
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const std::int64_t c = rows.columns[k];
    const bool mine = c >= first && c < last;
    columns[k] = static_cast<std::int32_t>(
        mine ? c - first : num_owned + (std::lower_bound(ghosts.begin(), ghosts.end(), c) - ghosts.begin()));
  }
  offsets = std::move(rows.offsets);
  weights = std::move(rows.weights);
  std::vector<PetscInt> leaves(ghosts.size());
  std::vector<PetscSFNode> remote(ghosts.size());
  for (std::size_t g = 0; g < ghosts.size(); ++g) {
    const auto owner = std::upper_bound(starts.begin(), starts.end(), ghosts[g]) - starts.begin() - 1;
    leaves[g] = static_cast<PetscInt>(num_owned + static_cast<std::int64_t>(g));
    remote[g] = {static_cast<PetscInt>(owner),
                 static_cast<PetscInt>(ghosts[g] - starts[static_cast<std::size_t>(owner)])};
  }
  check_petsc(PetscSFCreate(comm, &halo_), "PetscSFCreate");
  check_petsc(PetscSFSetGraph(halo_, static_cast<PetscInt>(num_owned), static_cast<PetscInt>(leaves.size()),
                              leaves.data(), PETSC_COPY_VALUES, remote.data(), PETSC_COPY_VALUES),
              "PetscSFSetGraph");
  check_petsc(PetscSFSetUp(halo_), "PetscSFSetUp");
}

NodeGraph::~NodeGraph() { PetscSFDestroy(&halo_); }

std::vector<double> NodeGraph::scatter(std::span<const double> on_root, int width) const {
  int rank = 0;
  MPI_Comm_rank(comm_, &rank);
  const auto w = static_cast<std::size_t>(width);
  std::vector<double> ordered;
  std::vector<int> sizes(counts_.size()), starts(counts_.size(), 0);
  for (std::size_t r = 0; r < counts_.size(); ++r) {
    sizes[r] = counts_[r] * width;
    if (r > 0) starts[r] = starts[r - 1] + sizes[r - 1];
  }
  if (rank == 0) {
    ordered.resize(order_.size() * w);
    for (std::size_t i = 0; i < order_.size(); ++i)
      std::copy_n(on_root.data() + static_cast<std::size_t>(order_[i]) * w, w, ordered.data() + i * w);
  }
  std::vector<double> values(local() * w);
  MPI_Scatterv(ordered.data(), sizes.data(), starts.data(), MPI_DOUBLE, values.data(), static_cast<int>(owned() * w),
               MPI_DOUBLE, 0, comm_);
  update_ghosts(values, width);
  return values;
}

std::vector<double> NodeGraph::gather(std::span<const double> values, int width) const {
  int rank = 0;
  MPI_Comm_rank(comm_, &rank);
  const auto w = static_cast<std::size_t>(width);
  std::vector<int> sizes(counts_.size()), starts(counts_.size(), 0);
  for (std::size_t r = 0; r < counts_.size(); ++r) {
    sizes[r] = counts_[r] * width;
    if (r > 0) starts[r] = starts[r - 1] + sizes[r - 1];
  }
  std::vector<double> ordered(rank == 0 ? static_cast<std::size_t>(num_global_) * w : 0);
  MPI_Gatherv(values.data(), static_cast<int>(owned() * w), MPI_DOUBLE, ordered.data(), sizes.data(), starts.data(),
              MPI_DOUBLE, 0, comm_);
  std::vector<double> on_root(ordered.size());
  for (std::size_t i = 0; i < order_.size(); ++i)
    std::copy_n(ordered.data() + i * w, w, on_root.data() + static_cast<std::size_t>(order_[i]) * w);
  return on_root;
}

void NodeGraph::update_ghosts(std::span<double> values, int width) const {
  MPI_Datatype block = MPI_DATATYPE_NULL;
  MPI_Type_contiguous(width, MPI_DOUBLE, &block);
  MPI_Type_commit(&block);
  check_petsc(PetscSFBcastBegin(halo_, block, values.data(), values.data(), MPI_REPLACE), "PetscSFBcastBegin");
  check_petsc(PetscSFBcastEnd(halo_, block, values.data(), values.data(), MPI_REPLACE), "PetscSFBcastEnd");
  MPI_Type_free(&block);
}

}  // namespace hexfield
