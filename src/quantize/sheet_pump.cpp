#include <algorithm>
#include <cmath>

#include "programs.hpp"

namespace hexfield::quantize {
namespace {

constexpr int max_nodes = 400;
constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<IntegerCost> bundle_costs(const Program& program) {
  std::vector<IntegerCost> costs;
  for (std::size_t b = 0; b < program.system.num_bundles(); ++b)
    costs.push_back({program.weights[b], program.system.target[b], static_cast<double>(program.least[b]), infinity});
  return costs;
}

}  // namespace

double Program::objective(const std::vector<std::int64_t>& x) const {
  double sum = 0;
  for (std::size_t j = 0; j < x.size(); ++j) {
    const double d = static_cast<double>(x[j]) - system.target[j];
    sum += weights[j] * d * d;
  }
  for (const Square& s : squares) {
    const double d = static_cast<double>(value_of(s.sum, x)) - s.target;
    sum += s.weight * d * d;
  }
  return sum;
}

bool Program::satisfied(const std::vector<std::int64_t>& x) const {
  for (std::size_t j = 0; j < x.size(); ++j)
    if (x[j] < least[j]) return false;
  for (const ArcSum& e : system.equations)
    if (value_of(e, x) != 0) return false;
  return std::all_of(rows.begin(), rows.end(), [&](const Row& r) { return value_of(r.sum, x) >= r.least; });
}

SheetPump::SheetPump(const Program& program)
    : program_(program), dictionary_(bundle_costs(program), program.system.equations) {
  for (const Program::Square& s : program.squares) dictionary_.add_sum(s.sum, {s.weight, s.target});
}

std::optional<IntegerSolution> SheetPump::solve() {
  for (; known_rows_ < program_.rows.size(); ++known_rows_) {
    const Program::Row& row = program_.rows[known_rows_];
    dictionary_.add_sum(row.sum, {0, 0, static_cast<double>(row.least), infinity});
  }
  best_.clear();
  best_cost_ = 0;
  nodes_ = 0;
  if (!pump(dictionary_)) return std::nullopt;
  branch(dictionary_);
  if (best_.empty()) return std::nullopt;
  return IntegerSolution{best_, nodes_ < max_nodes};
}

bool SheetPump::pump(SheetDictionary& dictionary) {
  const auto steps = dictionary.descend();
  if (steps) pumped_ += *steps;
  return steps.has_value();
}

// `dictionary` has been pumped to its end.
void SheetPump::branch(const SheetDictionary& dictionary) {
  ++nodes_;
  const std::vector<double> values = dictionary.values();
  if (dictionary.outside(values) > 1e-6) return;
  if (!best_.empty() && dictionary.cost(values) >= best_cost_ - 1e-9 * (1 + best_cost_)) return;
  const std::size_t n = program_.system.num_bundles();
  std::size_t middle = n;
  double most = 1e-6;
  for (std::size_t b = 0; b < n; ++b) {
    const double fraction = std::abs(values[b] - std::round(values[b]));
    if (fraction > most + 1e-9) most = fraction, middle = b;
  }
  if (middle == n) {
    std::vector<std::int64_t> x;
    for (std::size_t b = 0; b < n; ++b) x.push_back(std::llround(values[b]));
    if (!program_.satisfied(x)) return;
    best_cost_ = program_.objective(x);
    best_ = std::move(x);
    return;
  }
  const double at = values[middle];
  const bool up_first = std::ceil(at) - at <= at - std::floor(at);
  for (const bool up : {up_first, !up_first}) {
    if (nodes_ >= max_nodes) return;
    SheetDictionary next = dictionary;
    if (up)
      next.raise_least(middle, std::ceil(at));
    else
      next.lower_most(middle, std::floor(at));
    if (pump(next)) branch(next);
  }
}

}  // namespace hexfield::quantize
