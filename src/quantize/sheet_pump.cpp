#include <algorithm>
#include <cmath>
#include <coin/ClpSimplex.hpp>
#include <memory>
#include <numeric>

#include "programs.hpp"

namespace hexfield::quantize {
namespace {

constexpr double integral = 1e-6;

double round_half_up(double x) { return std::floor(x + 0.5); }

}  // namespace

/// Columns: the changes up of all bundles, then those down. Rows: equations, then inequalities.
struct SheetPump::Model {
  ClpSimplex lp;
  std::size_t m = 0;

  double change(std::size_t j) const { return lp.primalColumnSolution()[j] - lp.primalColumnSolution()[m + j]; }
  bool solve() { return lp.primal() == 0 && lp.status() == 0; }
  void set_bounds(std::size_t column, double low, double high) {
    lp.setColumnBounds(static_cast<int>(column), low, high);
  }
};

SheetPump::SheetPump(const Program& program) : program_(program), model_(std::make_unique<Model>()) {
  const BundleSystem& system = program.system;
  model_->m = system.num_bundles();
  const auto m = static_cast<int>(model_->m);
  ClpSimplex& lp = model_->lp;
  lp.setLogLevel(0);
  lp.resize(0, 2 * m);
  const auto add = [&](const ArcSum& sum, double low, double high) {
    std::vector<int> columns;
    std::vector<double> values;
    for (const auto& [b, c] : sum) {
      columns.insert(columns.end(), {b, m + b});
      values.insert(values.end(), {static_cast<double>(c), -static_cast<double>(c)});
    }
    lp.addRow(static_cast<int>(columns.size()), columns.data(), values.data(), low, high);
  };
  for (const ArcSum& e : system.equations) add(e, 0, 0);
  for (const ArcSum& r : program.rows) add(r, -COIN_DBL_MAX, COIN_DBL_MAX);
}

SheetPump::~SheetPump() = default;

// Bounds and weights around x: bundles that want to go a way are cheap that way (spec 5, weights).
void SheetPump::prepare(const std::vector<std::int64_t>& x) {
  const BundleSystem& system = program_.system;
  const double n = std::accumulate(system.size.begin(), system.size.end(), 0.0);
  const auto weight = [&](double desire) {
    if (desire >= 1) return 1 / (1 + desire);
    return desire >= 0 ? n / (1 + desire) : n * n * (1 - desire);
  };
  for (std::size_t j = 0; j < model_->m; ++j) {
    const double desire = system.target[j] - static_cast<double>(x[j]);
    model_->lp.setObjectiveCoefficient(static_cast<int>(j), system.size[j] * weight(desire));
    model_->lp.setObjectiveCoefficient(static_cast<int>(model_->m + j), system.size[j] * weight(-desire));
    model_->set_bounds(j, 0, COIN_DBL_MAX);
    model_->set_bounds(model_->m + j, 0, std::max(0.0, static_cast<double>(x[j] - program_.lower)));
    if (x[j] < program_.lower) model_->set_bounds(j, static_cast<double>(program_.lower - x[j]), COIN_DBL_MAX);
  }
  for (std::size_t r = 0; r < program_.rows.size(); ++r) {
    std::int64_t sum = 0;
    for (const auto& [b, c] : program_.rows[r]) sum += c * x[static_cast<std::size_t>(b)];
    model_->lp.setRowLower(static_cast<int>(system.equations.size() + r), static_cast<double>(program_.least - sum));
  }
}

// The solution of the program, or of it with fractional changes fixed one by one to the next larger integer.
std::optional<std::vector<std::int64_t>> SheetPump::round_solution() {
  for (std::size_t round = 0; round <= model_->m; ++round) {
    if (!model_->solve()) return std::nullopt;
    std::size_t next = model_->m;
    double least = 2;
    for (std::size_t j = 0; j < model_->m; ++j) {
      const double y = std::abs(model_->change(j));
      if (std::abs(y - std::nearbyint(y)) <= integral) continue;
      if (std::ceil(y) - y < least - integral) least = std::ceil(y) - y, next = j;
    }
    if (next == model_->m) {
      std::vector<std::int64_t> change;
      for (std::size_t j = 0; j < model_->m; ++j) change.push_back(std::llround(model_->change(j)));
      return change;
    }
    const double y = model_->change(next);
    model_->set_bounds(next, y > 0 ? std::ceil(y) : 0, y > 0 ? std::ceil(y) : 0);
    model_->set_bounds(model_->m + next, y > 0 ? 0 : std::ceil(-y), y > 0 ? 0 : std::ceil(-y));
  }
  return std::nullopt;
}

bool SheetPump::repair(std::vector<std::int64_t>& x) {
  prepare(x);
  const auto change = round_solution();
  if (!change) return false;
  for (std::size_t j = 0; j < x.size(); ++j) x[j] += (*change)[j];
  return program_.violated(x).empty() &&
         std::all_of(x.begin(), x.end(), [&](std::int64_t v) { return v >= program_.lower; });
}

std::optional<std::vector<std::int64_t>> SheetPump::sheet(const std::vector<std::int64_t>& x, std::int32_t bundle,
                                                          int sign) {
  const auto b = static_cast<std::size_t>(bundle);
  if (sign < 0 && x[b] <= program_.lower) return std::nullopt;
  prepare(x);
  const double most = sign > 0 ? COIN_DBL_MAX : static_cast<double>(x[b] - program_.lower);
  model_->set_bounds(sign > 0 ? b : model_->m + b, 1, most);
  model_->set_bounds(sign > 0 ? model_->m + b : b, 0, 0);
  return round_solution();
}

bool SheetPump::try_pump(std::vector<std::int64_t>& x, std::int32_t bundle, int sign) {
  const BundleSystem& system = program_.system;
  const auto change = sheet(x, bundle, sign);
  if (!change) return false;
  double slope = 0, curvature = 0;
  for (std::size_t j = 0; j < x.size(); ++j) {
    const auto d = static_cast<double>((*change)[j]);
    slope += 2 * system.size[j] * (static_cast<double>(x[j]) - system.target[j]) * d;
    curvature += 2 * system.size[j] * d * d;
  }
  const double ideal = -slope / curvature;
  if (!(ideal > 0)) return false;
  auto steps = static_cast<std::int64_t>(round_half_up(std::max(std::min(0.5, ideal), ideal / 3)));
  // Largest number of steps within the bounds and the rows.
  for (std::size_t j = 0; j < x.size(); ++j)
    if ((*change)[j] < 0) steps = std::min(steps, (x[j] - program_.lower) / -(*change)[j]);
  for (const ArcSum& row : program_.rows) {
    std::int64_t now = 0, per_step = 0;
    for (const auto& [b, c] : row) {
      now += c * x[static_cast<std::size_t>(b)];
      per_step += c * (*change)[static_cast<std::size_t>(b)];
    }
    if (per_step < 0) steps = std::min(steps, (now - program_.least) / -per_step);
  }
  if (steps <= 0) return false;
  std::vector<std::int64_t> trial = x;
  for (std::size_t j = 0; j < x.size(); ++j) trial[j] += steps * (*change)[j];
  if (program_.objective(trial) > program_.objective(x) - 1e-6) return false;
  x = std::move(trial);
  ++pumped_;
  return true;
}

void SheetPump::descend(std::vector<std::int64_t>& x, bool thorough) {
  const auto& target = program_.system.target;
  const auto desire = [&](std::size_t j) { return target[j] - static_cast<double>(x[j]); };
  const std::size_t patience = std::max<std::size_t>(30, model_->m / 2);
  for (bool moved = true; moved;) {
    moved = false;
    std::vector<std::int32_t> order(model_->m);
    std::iota(order.begin(), order.end(), 0);
    std::vector<double> want(model_->m);
    for (std::size_t j = 0; j < want.size(); ++j) want[j] = std::abs(desire(j));
    std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
      return want[static_cast<std::size_t>(a)] > want[static_cast<std::size_t>(b)];
    });
    std::size_t failures = 0;
    for (std::int32_t b : order) {
      const double d = desire(static_cast<std::size_t>(b));
      if (!thorough && failures >= patience) break;
      bool success = false;
      // The same bundle again and again: steps are damped.
      while (desire(static_cast<std::size_t>(b)) * d > 0 && try_pump(x, b, d > 0 ? 1 : -1)) success = true;
      if (thorough && !success) success = try_pump(x, b, d > 0 ? -1 : 1);
      moved = moved || success;
      failures = success ? 0 : failures + 1;
    }
  }
}

}  // namespace hexfield::quantize
