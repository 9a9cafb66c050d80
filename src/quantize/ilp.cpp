#include <coin/Cbc_C_Interface.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>

#include "programs.hpp"

namespace hexfield::quantize {
namespace {

constexpr double infinity = std::numeric_limits<double>::max();

struct CbcDeleter {
  void operator()(Cbc_Model* model) const { Cbc_deleteModel(model); }
};

/// Rows by columns: x of the bundles, then the values of their squares.
class Matrix {
 public:
  explicit Matrix(std::size_t columns) : columns_(columns) {}
  void add_row(const std::vector<std::pair<std::int32_t, double>>& terms, double low, double high) {
    for (const auto& [c, a] : terms)
      columns_[static_cast<std::size_t>(c)].emplace_back(static_cast<int>(low_.size()), a);
    low_.push_back(low);
    high_.push_back(high);
  }
  void load(Cbc_Model* model, const std::vector<double>& lower, const std::vector<double>& cost) const {
    std::vector<CoinBigIndex> start{0};
    std::vector<int> index;
    std::vector<double> value;
    for (const auto& column : columns_) {
      for (const auto& [row, a] : column) index.push_back(row), value.push_back(a);
      start.push_back(static_cast<CoinBigIndex>(index.size()));
    }
    const std::vector<double> upper(columns_.size(), infinity);
    Cbc_loadProblem(model, static_cast<int>(columns_.size()), static_cast<int>(low_.size()), start.data(), index.data(),
                    value.data(), lower.data(), upper.data(), cost.data(), low_.data(), high_.data());
  }

 private:
  std::vector<std::vector<std::pair<int, double>>> columns_;
  std::vector<double> low_, high_;
};

void add_secant(Matrix& matrix, std::size_t j, std::size_t m, std::int64_t k, double target) {
  const double slope = 2 * (static_cast<double>(k) - target) + 1;
  const double at = (static_cast<double>(k) - target) * (static_cast<double>(k) - target);
  matrix.add_row({{static_cast<std::int32_t>(j), -slope}, {static_cast<std::int32_t>(m + j), 1}},
                 at - slope * static_cast<double>(k), infinity);
}

}  // namespace

double Program::objective(const std::vector<std::int64_t>& x) const {
  double sum = 0;
  for (std::size_t j = 0; j < x.size(); ++j) {
    const double d = static_cast<double>(x[j]) - system.target[j];
    sum += system.size[j] * d * d;
  }
  return sum;
}

std::vector<std::size_t> Program::violated(const std::vector<std::int64_t>& x) const {
  std::vector<std::size_t> found;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::int64_t sum = 0;
    for (const auto& [b, c] : rows[r]) sum += c * x[static_cast<std::size_t>(b)];
    if (sum < least) found.push_back(r);
  }
  return found;
}

std::optional<IlpResult> solve_ilp(const Program& program, double gap, double seconds) {
  const BundleSystem& system = program.system;
  const std::size_t m = system.num_bundles();
  const auto as_row = [](const ArcSum& sum) {
    return std::vector<std::pair<std::int32_t, double>>(sum.begin(), sum.end());
  };
  Matrix matrix(2 * m);
  for (const ArcSum& e : system.equations) matrix.add_row(as_row(e), 0, 0);
  for (const ArcSum& r : program.rows) matrix.add_row(as_row(r), program.least, infinity);
  std::vector<std::set<std::int64_t>> secants(m);
  for (std::size_t j = 0; j < m; ++j)
    for (auto k = static_cast<std::int64_t>(std::floor(system.target[j])) - 2, end = k + 5; k < end; ++k)
      secants[j].insert(k);
  std::vector<double> lower(2 * m, 0);
  std::vector<double> cost(2 * m, 0);
  for (std::size_t j = 0; j < m; ++j) {
    lower[j] = program.lower;
    cost[m + j] = system.size[j];
    for (std::int64_t k : secants[j]) add_secant(matrix, j, m, k, system.target[j]);
  }
  for (int round = 0; round < 50; ++round) {
    const std::unique_ptr<Cbc_Model, CbcDeleter> model(Cbc_newModel());
    Cbc_setLogLevel(model.get(), 0);
    Cbc_setParameter(model.get(), "log", "0");
    matrix.load(model.get(), lower, cost);
    for (std::size_t j = 0; j < m; ++j) Cbc_setInteger(model.get(), static_cast<int>(j));
    Cbc_setAllowableFractionGap(model.get(), gap);
    Cbc_setMaximumSeconds(model.get(), seconds);
    Cbc_solve(model.get());
    const double* solution = Cbc_getColSolution(model.get());
    if (Cbc_isProvenInfeasible(model.get()) != 0 || solution == nullptr) return std::nullopt;
    IlpResult result;
    for (std::size_t j = 0; j < m; ++j) {
      if (std::abs(solution[j] - std::nearbyint(solution[j])) > 1e-4) return std::nullopt;
      result.x.push_back(std::llround(solution[j]));
    }
    if (!program.violated(result.x).empty()) return std::nullopt;
    result.proven = Cbc_isProvenOptimal(model.get()) != 0 && gap < 1e-3;
    // Secants are missing where the solution is cheaper than its square.
    bool exact = true;
    for (std::size_t j = 0; j < m; ++j)
      for (std::int64_t k : {result.x[j] - 1, result.x[j]}) {
        const double d = static_cast<double>(result.x[j]) - system.target[j];
        if (solution[m + j] > d * d - 1e-6 || !secants[j].insert(k).second) continue;
        exact = false;
        add_secant(matrix, j, m, k, system.target[j]);
      }
    if (exact) return result;
  }
  return std::nullopt;
}

}  // namespace hexfield::quantize
