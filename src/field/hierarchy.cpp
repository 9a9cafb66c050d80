#include "hierarchy.hpp"

#include <cmath>

#include "hexfield/base/agree.hpp"
#include "hexfield/base/parallel.hpp"

namespace hexfield {
namespace {

constexpr std::size_t smallest_level = 40;

template <class T>
void broadcast(std::vector<T>& values, MPI_Comm comm) {
  auto n = static_cast<std::int64_t>(values.size());
  MPI_Bcast(&n, 1, MPI_INT64_T, 0, comm);
  values.resize(static_cast<std::size_t>(n));
  constexpr std::int64_t chunk = std::int64_t{1} << 26;
  for (std::int64_t at = 0; at < n; at += chunk)
    MPI_Bcast(values.data() + at, static_cast<int>(std::min(chunk, n - at) * static_cast<std::int64_t>(sizeof(T))),
              MPI_BYTE, 0, comm);
}

void broadcast(SparseRows& rows, MPI_Comm comm) {
  auto width = static_cast<std::int64_t>(rows.width);
  MPI_Bcast(&width, 1, MPI_INT64_T, 0, comm);
  rows.width = static_cast<std::size_t>(width);
  broadcast(rows.offsets, comm);
  broadcast(rows.columns, comm);
  broadcast(rows.values, comm);
}

// Groups that stay on one rank: the aggregates, with every fixed node in one that it touches.
std::vector<std::int32_t> groups(const RootGraph& graph, const std::vector<std::int32_t>& aggregate) {
  std::vector<std::int32_t> group = aggregate;
  for (std::size_t i = 0; i < group.size(); ++i) {
    for (auto k = graph.offsets[i]; k < graph.offsets[i + 1] && group[i] < 0; ++k)
      group[i] = aggregate[static_cast<std::size_t>(graph.neighbours[static_cast<std::size_t>(k)])];
    if (group[i] < 0) group[i] = 0;
  }
  return group;
}

// Largest eigenvalue of D^-1 A, from the powers of one vector.
double largest_eigenvalue(const SparseRows& a) {
  std::vector<double> x(a.rows()), y(a.rows(), 0.0);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::sin(static_cast<double>(i) * 1.618 + 1);
  double value = 0;
  for (int step = 0; step < 15; ++step) {
    double before = 0, after = 0;
    parallel_for(a.rows(), 4096, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (a.begin(i) == a.end(i)) continue;
        double sum = 0;
        for (std::size_t k = a.begin(i); k < a.end(i); ++k) sum += a.values[k] * x[a.column(k)];
        const double d = a.values[a.find(i, static_cast<std::int32_t>(i))];
        y[i] = d > 0 ? sum / d : 0;
      }
    });
    for (std::size_t i = 0; i < x.size(); ++i) {
      before += x[i] * x[i];
      after += y[i] * y[i];
    }
    if (!(after > 0)) return 1;
    value = std::sqrt(after / before);
    const double scale = 1 / std::sqrt(after);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = scale * y[i];
  }
  return value;
}

}  // namespace

Hierarchy::Hierarchy(MPI_Comm comm, const RootGraph& graph, const std::vector<NodeConstraint>& constraints) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  std::vector<std::int32_t> group;
  std::int32_t num_groups = 0;
  agree(comm, [&] {
    if (rank != 0) return;
    std::vector<char> fixed(graph.size(), 0);
    for (std::size_t i = 0; i < fixed.size(); ++i) fixed[i] = constraints[i].kind == NodeConstraint::Kind::fixed;
    root_matrix = laplacian(graph, fixed);
    largest = 1.05 * largest_eigenvalue(root_matrix);
    std::vector<Coarsening> levels = coarsen(root_matrix, smallest_level);
    for (std::size_t l = 0; l < levels.size(); ++l) {
      matrices.push_back(std::move(levels[l].matrix));
      if (l > 0) prolongations.push_back(std::move(levels[l].prolongation));
    }
    group.assign(graph.size(), 0);
    num_groups = 1;
    if (levels.empty()) return;
    root_interpolation = std::move(levels[0].prolongation);
    group = groups(graph, levels[0].aggregate);
    num_groups = std::max(1, static_cast<std::int32_t>(matrices[0].rows()));
  });
  graph_ = std::make_unique<NodeGraph>(comm, graph, group, num_groups);
  distribute(comm);
  diagonal.resize(graph_->owned());
  for (std::size_t i = 0; i < diagonal.size(); ++i)
    for (auto k = graph_->offsets[i]; k < graph_->offsets[i + 1]; ++k)
      diagonal[i] += graph_->weights[static_cast<std::size_t>(k)];
  std::vector<double> mine(group.begin(), group.end());
  mine = graph_->scatter(mine, 1);
  // Rows of the aggregates that this rank owns, from the rows of all local nodes.
  std::vector<char> owned(matrices.empty() ? 0 : matrices[0].rows(), 0);
  for (std::size_t i = 0; i < graph_->owned() && !owned.empty(); ++i) owned[static_cast<std::size_t>(mine[i])] = 1;
  for (std::size_t row = 0; row < restriction.rows(); ++row)
    if (owned[row] == 0)
      for (std::size_t k = restriction.begin(row); k < restriction.end(row); ++k) restriction.values[k] = 0;
}

void Hierarchy::distribute(MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  MPI_Bcast(&largest, 1, MPI_DOUBLE, 0, comm);
  auto count = static_cast<int>(matrices.size());
  MPI_Bcast(&count, 1, MPI_INT, 0, comm);
  matrices.resize(static_cast<std::size_t>(count));
  prolongations.resize(count > 0 ? static_cast<std::size_t>(count) - 1 : 0);
  for (SparseRows& m : matrices) broadcast(m, comm);
  for (SparseRows& p : prolongations) broadcast(p, comm);
  if (count == 0) return;
  // Rows of the interpolation as records of one width: their number, then columns and values; and the old ids.
  int width = 0;
  for (std::size_t i = 0; i < root_interpolation.rows(); ++i)
    width = std::max(width, static_cast<int>(root_interpolation.end(i) - root_interpolation.begin(i)));
  width = 2 * width + 2;
  MPI_Bcast(&width, 1, MPI_INT, 0, comm);
  const auto w = static_cast<std::size_t>(width);
  std::vector<double> records(root_interpolation.rows() * w, 0.0);
  for (std::size_t i = 0; i < root_interpolation.rows(); ++i) {
    double* r = records.data() + i * w;
    *r++ = static_cast<double>(i);
    *r++ = static_cast<double>(root_interpolation.end(i) - root_interpolation.begin(i));
    for (std::size_t k = root_interpolation.begin(i); k < root_interpolation.end(i); ++k) {
      *r++ = root_interpolation.columns[k];
      *r++ = root_interpolation.values[k];
    }
  }
  records = graph_->scatter(records, width);
  auto read_rows = [&](const std::vector<std::size_t>& order) {
    SparseRows rows;
    rows.width = matrices[0].rows();
    for (std::size_t i : order) {
      const double* r = records.data() + i * w;
      const auto n = static_cast<std::size_t>(r[1]);
      for (std::size_t k = 0; k < n; ++k) {
        rows.columns.push_back(static_cast<std::int32_t>(r[2 + 2 * k]));
        rows.values.push_back(r[3 + 2 * k]);
      }
      rows.offsets.push_back(static_cast<std::int64_t>(rows.columns.size()));
    }
    return rows;
  };
  // Every row of the restriction in the order of the whole graph.
  std::vector<std::size_t> order(graph_->local());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  interpolation =
      read_rows(std::vector<std::size_t>(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(graph_->owned())));
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return records[a * w] < records[b * w]; });
  restriction = transposed(read_rows(order));
  for (std::int32_t& c : restriction.columns) c = static_cast<std::int32_t>(order[static_cast<std::size_t>(c)]);
}

}  // namespace hexfield
