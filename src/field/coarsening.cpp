#include "coarsening.hpp"

#include <cmath>

#include "hexfield/base/parallel.hpp"

namespace hexfield {
namespace {

// An entry couples strongly when it is not below this share of the geometric mean of the diagonals.
constexpr double strong_share = 0.02;
constexpr int most_levels = 12;

std::vector<double> diagonal(const SparseRows& a) {
  std::vector<double> d(a.rows(), 0.0);
  for (std::size_t i = 0; i < a.rows(); ++i)
    if (a.begin(i) < a.end(i)) d[i] = a.values[a.find(i, static_cast<std::int32_t>(i))];
  return d;
}

// Greedy aggregates of a node and its strong neighbours; leftovers join the strongest neighbour that has one.
std::vector<std::int32_t> aggregates(const SparseRows& a, std::int32_t& count) {
  const std::vector<double> d = diagonal(a);
  auto strong = [&](std::size_t i, std::size_t k) {
    const std::size_t j = a.column(k);
    return j != i && -a.values[k] > strong_share * std::sqrt(d[i] * d[j]);
  };
  std::vector<std::int32_t> of(a.rows(), -1);
  count = 0;
  for (std::size_t i = 0; i < a.rows(); ++i) {
    if (a.begin(i) == a.end(i) || of[i] >= 0) continue;
    bool untouched = true;
    for (std::size_t k = a.begin(i); k < a.end(i) && untouched; ++k) untouched = !strong(i, k) || of[a.column(k)] < 0;
    if (!untouched) continue;
    of[i] = count;
    for (std::size_t k = a.begin(i); k < a.end(i); ++k)
      if (strong(i, k)) of[a.column(k)] = count;
    ++count;
  }
  const std::vector<std::int32_t> roots = of;
  for (std::size_t i = 0; i < a.rows(); ++i) {
    if (a.begin(i) == a.end(i) || of[i] >= 0) continue;
    double most = 0;
    for (std::size_t k = a.begin(i); k < a.end(i); ++k)
      if (a.column(k) != i && roots[a.column(k)] >= 0 && -a.values[k] > most) {
        most = -a.values[k];
        of[i] = roots[a.column(k)];
      }
  }
  for (std::size_t i = 0; i < a.rows(); ++i)
    if (a.begin(i) < a.end(i) && of[i] < 0) of[i] = count++;
  return of;
}

// (I - 2/3 D^-1 A) applied to the indicators of the aggregates.
SparseRows smoothed_prolongation(const SparseRows& a, const std::vector<std::int32_t>& aggregate, std::int32_t count) {
  SparseRows indicator;
  indicator.width = static_cast<std::size_t>(count);
  for (std::int32_t g : aggregate) {
    if (g >= 0) indicator.columns.push_back(g), indicator.values.push_back(1);
    indicator.offsets.push_back(static_cast<std::int64_t>(indicator.columns.size()));
  }
  SparseRows smoothing = a;
  for (std::size_t i = 0; i < a.rows(); ++i) {
    if (a.begin(i) == a.end(i)) continue;
    const std::size_t own = a.find(i, static_cast<std::int32_t>(i));
    const double factor = a.values[own] > 0 ? -2.0 / (3 * a.values[own]) : 0.0;
    for (std::size_t k = a.begin(i); k < a.end(i); ++k) smoothing.values[k] *= factor;
    smoothing.values[own] += 1;
  }
  return product(smoothing, indicator);
}

}  // namespace

SparseRows laplacian(const RootGraph& graph, const std::vector<char>& fixed) {
  SparseRows a;
  a.width = graph.size();
  a.offsets.reserve(graph.size() + 1);
  a.columns.reserve(graph.neighbours.size() + graph.size());
  a.values.reserve(graph.neighbours.size() + graph.size());
  for (std::size_t i = 0; i < graph.size(); ++i) {
    if (fixed[i] == 0) {
      double total = 0;
      for (auto k = graph.offsets[i]; k < graph.offsets[i + 1]; ++k)
        total += graph.weights[static_cast<std::size_t>(k)];
      bool own = false;
      auto put_own = [&] { a.columns.push_back(static_cast<std::int32_t>(i)), a.values.push_back(total), own = true; };
      for (auto k = static_cast<std::size_t>(graph.offsets[i]); k < static_cast<std::size_t>(graph.offsets[i + 1]);
           ++k) {
        const std::int32_t j = graph.neighbours[k];
        if (!own && j > static_cast<std::int32_t>(i)) put_own();
        if (fixed[static_cast<std::size_t>(j)] == 0) a.columns.push_back(j), a.values.push_back(-graph.weights[k]);
      }
      if (!own) put_own();
    }
    a.offsets.push_back(static_cast<std::int64_t>(a.columns.size()));
  }
  return a;
}

std::vector<Coarsening> coarsen(const SparseRows& fine, std::size_t smallest) {
  std::vector<Coarsening> levels;
  const SparseRows* finest = &fine;
  while (finest->rows() > smallest && static_cast<int>(levels.size()) < most_levels) {
    Coarsening c;
    std::int32_t count = 0;
    c.aggregate = aggregates(*finest, count);
    if (static_cast<double>(count) > 0.8 * static_cast<double>(finest->rows()) && !levels.empty()) break;
    c.prolongation = smoothed_prolongation(*finest, c.aggregate, count);
    c.matrix = product(transposed(c.prolongation), product(*finest, c.prolongation));
    levels.push_back(std::move(c));
    finest = &levels.back().matrix;
  }
  return levels;
}

}  // namespace hexfield
