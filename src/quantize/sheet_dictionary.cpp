#include "sheet_dictionary.hpp"

#include <algorithm>
#include <cmath>

#include "hexfield/base/error.hpp"

namespace hexfield::quantize {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double tiny = 1e-9;

// Entries are small rationals; the nearest integer within rounding errors is the entry itself.
double snapped(double x) {
  constexpr double magic = 0x1.8p52;
  const double rounded = (x + magic) - magic;
  return std::abs(x - rounded) < tiny ? rounded : x;
}

// In (1e-5, 2e-5), different for all unknowns, the same in every run.
double shift_of(std::size_t unknown) {
  const auto mixed = static_cast<std::uint32_t>((unknown + 1) * 2654435761U);
  return 1e-5 * (1 + static_cast<double>(mixed) * 0x1p-32);
}

}  // namespace

SheetDictionary::SheetDictionary(const std::vector<IntegerCost>& costs, const std::vector<ArcSum>& equations)
    : costs_(costs) {
  for (std::size_t u = 0; u < costs.size(); ++u) {
    shift_.push_back(shift_of(u));
    tolerance_ += 1e-13 * costs[u].weight * (2 * std::abs(costs[u].target) + 2);
  }
  eliminate(equations);
  for (std::int32_t u : nonbasic_) {
    const IntegerCost& c = costs_[static_cast<std::size_t>(u)];
    rest_.push_back(std::clamp(std::round(c.target), c.least, c.most));
  }
  refresh();
}

// Gauss-Jordan on the equations; the pivot of a row is its unit entry (any, if there is none) that the fewest other
// rows have.
void SheetDictionary::eliminate(const std::vector<ArcSum>& equations) {
  const std::size_t n = costs_.size();
  std::vector<std::vector<double>> rows;
  std::vector<std::size_t> pivots;
  std::vector<int> uses(n, 0);
  for (const ArcSum& e : equations)
    for (const auto& term : e) ++uses[static_cast<std::size_t>(term.first)];
  std::vector<double> next(n);
  for (const ArcSum& e : equations) {
    std::fill(next.begin(), next.end(), 0.0);
    for (const auto& [u, c] : e) next[static_cast<std::size_t>(u)] = c;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const double f = next[pivots[r]];
      if (f == 0) continue;
      for (std::size_t u = 0; u < n; ++u) next[u] = snapped(next[u] - f * rows[r][u]);
    }
    std::size_t best = n;
    const auto rank = [&](std::size_t u) { return std::pair(std::abs(next[u]) != 1, uses[u]); };
    for (std::size_t u = 0; u < n; ++u)
      if (next[u] != 0 && (best == n || rank(u) < rank(best))) best = u;
    if (best == n) continue;
    const double pivot = next[best];
    for (double& x : next) x = snapped(x / pivot);
    for (auto& other : rows) {
      const double f = other[best];
      if (f == 0) continue;
      for (std::size_t u = 0; u < n; ++u) other[u] = snapped(other[u] - f * next[u]);
    }
    rows.push_back(next);
    pivots.push_back(best);
  }
  std::vector<char> is_basic(n, 0);
  for (std::size_t p : pivots) is_basic[p] = 1;
  for (std::size_t u = 0; u < n; ++u)
    if (is_basic[u] == 0) nonbasic_.push_back(static_cast<std::int32_t>(u));
  for (std::size_t r = 0; r < rows.size(); ++r) {
    basic_.push_back(static_cast<std::int32_t>(pivots[r]));
    for (std::int32_t u : nonbasic_) entries_.push_back(-rows[r][static_cast<std::size_t>(u)]);
  }
  x_.resize(basic_.size());
}

void SheetDictionary::add_sum(const ArcSum& sum, const IntegerCost& cost) {
  std::vector<double> made(nonbasic_.size(), 0);
  for (const auto& [u, c] : sum) {
    const auto column = std::find(nonbasic_.begin(), nonbasic_.end(), u);
    if (column != nonbasic_.end()) {
      made[static_cast<std::size_t>(column - nonbasic_.begin())] += c;
      continue;
    }
    const auto i = static_cast<std::size_t>(std::find(basic_.begin(), basic_.end(), u) - basic_.begin());
    require(i < basic_.size(), "A sum of unknowns has one that does not exist.");
    for (std::size_t j = 0; j < made.size(); ++j) made[j] += c * row(i)[j];
  }
  basic_.push_back(static_cast<std::int32_t>(costs_.size()));
  shift_.push_back(shift_of(costs_.size()));
  costs_.push_back(cost);
  tolerance_ += 1e-13 * cost.weight * (2 * std::abs(cost.target) + 2);
  entries_.insert(entries_.end(), made.begin(), made.end());
  x_.push_back(0);
  refresh();
}

void SheetDictionary::raise_least(std::size_t unknown, double least) {
  costs_[unknown].least = std::max(costs_[unknown].least, least);
}

void SheetDictionary::lower_most(std::size_t unknown, double most) {
  costs_[unknown].most = std::min(costs_[unknown].most, most);
}

// Values of the basic unknowns from those of the others.
void SheetDictionary::refresh() {
  for (std::size_t i = 0; i < basic_.size(); ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < nonbasic_.size(); ++j)
      if (row(i)[j] != 0) sum += row(i)[j] * (rest_[j] + shift_[static_cast<std::size_t>(nonbasic_[j])]);
    x_[i] = sum - shift_[static_cast<std::size_t>(basic_[i])];
  }
}

bool SheetDictionary::negative(const Rate& r) const {
  return r.outside < -1e-7 || (r.outside <= 1e-7 && r.cost < -tolerance_);
}

// Upwards from x, which is no integer, or from the integer x on.
SheetDictionary::Rate SheetDictionary::slope(std::size_t unknown, double x) const {
  const IntegerCost& c = costs_[unknown];
  const double k = std::floor(x);
  return {x < c.least ? -1.0 : (k >= c.most ? 1.0 : 0.0), c.weight * (2 * (k - c.target) + 1)};
}

// The next place beyond x at which the slope changes.
double SheetDictionary::next_rest(std::size_t unknown, double x, bool up) const {
  const IntegerCost& c = costs_[unknown];
  if (c.weight > 0) return up ? std::floor(x) + 1 : std::ceil(x) - 1;
  if (up) return x < c.least ? c.least : (x < c.most ? c.most : infinity);
  return x > c.most ? c.most : (x > c.least ? c.least : -infinity);
}

// By how much the slope changes there.
SheetDictionary::Rate SheetDictionary::bend(std::size_t unknown, double at) const {
  const IntegerCost& c = costs_[unknown];
  return {(at == c.least ? 1.0 : 0.0) + (at == c.most ? 1.0 : 0.0), 2 * c.weight};
}

// The sheet and direction of the steepest descent.
SheetDictionary::Choice SheetDictionary::price() {
  const std::size_t d = nonbasic_.size();
  rates_outside_.assign(d, 0);
  rates_cost_.assign(d, 0);
  for (std::size_t i = 0; i < basic_.size(); ++i) {
    const Rate s = slope(static_cast<std::size_t>(basic_[i]), x_[i]);
    const double* a = row(i);
    if (s.cost != 0)
      for (std::size_t j = 0; j < d; ++j) rates_cost_[j] += s.cost * a[j];
    if (s.outside != 0)
      for (std::size_t j = 0; j < d; ++j) rates_outside_[j] += s.outside * a[j];
  }
  Choice best;
  for (std::size_t j = 0; j < d; ++j) {
    const auto u = static_cast<std::size_t>(nonbasic_[j]);
    const Rate up = slope(u, rest_[j]);
    const Rate change = bend(u, rest_[j]);
    for (const double direction : {1.0, -1.0}) {
      Rate r = up;
      if (direction < 0) r = {change.outside - up.outside, change.cost - up.cost};
      r += {direction * rates_outside_[j], direction * rates_cost_[j]};
      if (!negative(r)) continue;
      const bool steeper =
          r.outside < best.rate.outside - 1e-7 || (r.outside <= best.rate.outside + 1e-7 && r.cost < best.rate.cost);
      if (best.direction == 0 || steeper) best = {j, direction, r};
    }
  }
  return best;
}

// Along the sheet until the cost rises.
SheetDictionary::Stop SheetDictionary::walk(const Choice& choice) {
  const std::size_t n = basic_.size();
  const auto own = static_cast<std::size_t>(nonbasic_[choice.column]);
  Rate rate = choice.rate;
  const auto unknown = [&](std::size_t i) { return i == n ? own : static_cast<std::size_t>(basic_[i]); };
  const auto step = [&](std::size_t i) { return i == n ? choice.direction : choice.direction * row(i)[choice.column]; };
  ahead_.assign(n + 1, infinity);
  place_ahead_.resize(n + 1);
  const auto advance = [&](std::size_t i, double from, double start) {
    const double a = step(i);
    const double at = next_rest(unknown(i), from, a > 0);
    place_ahead_[i] = at;
    ahead_[i] = std::isfinite(at) ? std::max(0.0, (at - start) / a) : infinity;
  };
  const auto start = [&](std::size_t i) { return i == n ? rest_[choice.column] : x_[i]; };
  for (std::size_t i = 0; i <= n; ++i)
    if (step(i) != 0) advance(i, start(i), start(i));
  for (;;) {
    const auto next = static_cast<std::size_t>(std::min_element(ahead_.begin(), ahead_.end()) - ahead_.begin());
    if (!std::isfinite(ahead_[next])) return {infinity, next, 0};
    const double at = place_ahead_[next];
    const Rate change = bend(unknown(next), at);
    const double size = std::abs(step(next));
    rate += {size * change.outside, size * change.cost};
    if (!negative(rate)) return {ahead_[next], next, at};
    advance(next, at, start(next));
  }
}

// Exchanges a basic and a non-basic unknown.
void SheetDictionary::pivot(std::size_t i, std::size_t j) {
  const std::size_t d = nonbasic_.size();
  double* leaving = row(i);
  const double p = leaving[j];
  for (std::size_t k = 0; k < d; ++k) leaving[k] = snapped(-leaving[k] / p);
  leaving[j] = snapped(1 / p);
  for (std::size_t r = 0; r < basic_.size(); ++r) {
    double* a = row(r);
    const double f = a[j];
    if (r == i || f == 0) continue;
    a[j] = 0;
    for (std::size_t k = 0; k < d; ++k) a[k] = snapped(a[k] + f * leaving[k]);
  }
  std::swap(basic_[i], nonbasic_[j]);
}

std::optional<std::size_t> SheetDictionary::descend() {
  constexpr int refresh_interval = 64;
  const std::size_t limit = 1000 + 50 * (basic_.size() + nonbasic_.size());
  for (std::size_t count = 1; count <= limit; ++count) {
    const Choice choice = price();
    if (choice.direction == 0) return count - 1;
    const Stop stop = walk(choice);
    if (!std::isfinite(stop.distance)) return std::nullopt;
    const std::size_t j = choice.column;
    const double along = choice.direction * stop.distance;
    for (std::size_t i = 0; i < basic_.size(); ++i) x_[i] += along * row(i)[j];
    if (stop.row == basic_.size()) {
      rest_[j] = stop.at;
    } else {
      x_[stop.row] = rest_[j] + along;
      rest_[j] = stop.at;
      pivot(stop.row, j);
    }
    if (count % refresh_interval == 0) refresh();
  }
  return std::nullopt;
}

std::vector<double> SheetDictionary::values() const {
  std::vector<double> result(costs_.size());
  for (std::size_t j = 0; j < nonbasic_.size(); ++j) result[static_cast<std::size_t>(nonbasic_[j])] = rest_[j];
  for (std::size_t i = 0; i < basic_.size(); ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < nonbasic_.size(); ++j) sum += row(i)[j] * rest_[j];
    result[static_cast<std::size_t>(basic_[i])] = snapped(sum);
  }
  return result;
}

double SheetDictionary::cost(const std::vector<double>& values) const {
  double sum = 0;
  for (std::size_t u = 0; u < costs_.size(); ++u) {
    const IntegerCost& c = costs_[u];
    const double k = std::floor(values[u]);
    sum += c.weight * ((k - c.target) * (k - c.target) + (2 * (k - c.target) + 1) * (values[u] - k));
  }
  return sum;
}

double SheetDictionary::outside(const std::vector<double>& values) const {
  double sum = 0;
  for (std::size_t u = 0; u < costs_.size(); ++u)
    sum += std::max({0.0, costs_[u].least - values[u], values[u] - costs_[u].most});
  return sum;
}

}  // namespace hexfield::quantize
