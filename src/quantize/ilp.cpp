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

// Columns: the bundles, the sums of the squares, then the square of each of those.
class SecantProgram {
 public:
  explicit SecantProgram(const Program& program);

  std::size_t quantities() const { return weights_.size(); }
  /// All columns at the optimum for the secants in force; empty: none was found.
  std::vector<double> solve(double gap, double seconds, bool& proven) const;
  /// Adds the secants that are missing at a solution; false when there are none.
  bool refine(const std::vector<double>& solution);

 private:
  void add_secant(std::size_t j, std::int64_t k);

  Matrix matrix_;
  std::vector<double> weights_, targets_, lower_;
  std::vector<std::set<std::int64_t>> secants_;
};

SecantProgram::SecantProgram(const Program& program)
    : matrix_(2 * (program.weights.size() + program.squares.size())),
      weights_(program.weights),
      targets_(program.system.target),
      lower_(program.least.begin(), program.least.end()) {
  using Terms = std::vector<std::pair<std::int32_t, double>>;
  for (const ArcSum& e : program.system.equations) matrix_.add_row(Terms(e.begin(), e.end()), 0, 0);
  for (const Program::Row& r : program.rows)
    matrix_.add_row(Terms(r.sum.begin(), r.sum.end()), static_cast<double>(r.least), infinity);
  for (const Program::Square& s : program.squares) {
    Terms terms(s.sum.begin(), s.sum.end());
    terms.emplace_back(static_cast<std::int32_t>(weights_.size()), -1);
    matrix_.add_row(terms, 0, 0);
    weights_.push_back(s.weight);
    targets_.push_back(s.target);
    lower_.push_back(-infinity);
  }
  secants_.resize(quantities());
  for (std::size_t j = 0; j < quantities(); ++j)
    for (auto k = static_cast<std::int64_t>(std::floor(targets_[j])) - 2, end = k + 5; k < end; ++k) add_secant(j, k);
}

void SecantProgram::add_secant(std::size_t j, std::int64_t k) {
  if (!secants_[j].insert(k).second) return;
  const double slope = 2 * (static_cast<double>(k) - targets_[j]) + 1;
  const double at = (static_cast<double>(k) - targets_[j]) * (static_cast<double>(k) - targets_[j]);
  matrix_.add_row({{static_cast<std::int32_t>(j), -slope}, {static_cast<std::int32_t>(quantities() + j), 1}},
                  at - slope * static_cast<double>(k), infinity);
}

std::vector<double> SecantProgram::solve(double gap, double seconds, bool& proven) const {
  const std::unique_ptr<Cbc_Model, CbcDeleter> model(Cbc_newModel());
  Cbc_setLogLevel(model.get(), 0);
  Cbc_setParameter(model.get(), "log", "0");
  std::vector<double> lower = lower_;
  lower.resize(2 * quantities(), 0);
  std::vector<double> cost(quantities(), 0);
  cost.insert(cost.end(), weights_.begin(), weights_.end());
  matrix_.load(model.get(), lower, cost);
  for (std::size_t j = 0; j < quantities(); ++j) Cbc_setInteger(model.get(), static_cast<int>(j));
  Cbc_setAllowableFractionGap(model.get(), gap);
  Cbc_setMaximumSeconds(model.get(), seconds);
  Cbc_solve(model.get());
  const double* solution = Cbc_getColSolution(model.get());
  if (Cbc_isProvenInfeasible(model.get()) != 0 || solution == nullptr) return {};
  proven = Cbc_isProvenOptimal(model.get()) != 0 && gap < 1e-3;
  return std::vector<double>(solution, solution + 2 * quantities());
}

// Secants are missing where the solution is cheaper than its square.
bool SecantProgram::refine(const std::vector<double>& solution) {
  bool added = false;
  for (std::size_t j = 0; j < quantities(); ++j) {
    const std::int64_t x = std::llround(solution[j]);
    const double d = static_cast<double>(x) - targets_[j];
    if (solution[quantities() + j] > d * d - 1e-6) continue;
    for (std::int64_t k : {x - 1, x}) {
      if (secants_[j].contains(k)) continue;
      added = true;
      add_secant(j, k);
    }
  }
  return added;
}

}  // namespace

std::optional<IntegerSolution> solve_ilp(const Program& program, double gap, double seconds) {
  constexpr int max_refinements = 50;
  SecantProgram secants(program);
  for (int round = 0; round < max_refinements; ++round) {
    IntegerSolution result;
    const std::vector<double> solution = secants.solve(gap, seconds, result.proven);
    if (solution.empty()) return std::nullopt;
    for (std::size_t j = 0; j < program.weights.size(); ++j) {
      if (std::abs(solution[j] - std::nearbyint(solution[j])) > 1e-4) return std::nullopt;
      result.x.push_back(std::llround(solution[j]));
    }
    if (!program.satisfied(result.x)) return std::nullopt;
    if (!secants.refine(solution)) return result;
  }
  return std::nullopt;
}

}  // namespace hexfield::quantize
