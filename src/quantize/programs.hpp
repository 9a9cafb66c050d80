#pragma once

#include <memory>
#include <optional>

#include "arc_system.hpp"

namespace hexfield::quantize {

/// Integer lengths per bundle: close to the targets in the sum of size * (x - target)^2, with all equations 0, all
/// rows at least `least` and all lengths at least `lower`.
struct Program {
  const BundleSystem& system;
  std::vector<ArcSum> rows;  ///< over bundles
  int lower = 0;
  int least = 1;

  double objective(const std::vector<std::int64_t>& x) const;
  /// Rows that x violates.
  std::vector<std::size_t> violated(const std::vector<std::int64_t>& x) const;
};

struct IlpResult {
  std::vector<std::int64_t> x;
  bool proven = false;
};
/// By CBC, squares as secants that are exact at integers (spec-quantization 4.6). nullopt: none found.
std::optional<IlpResult> solve_ilp(const Program& program, double gap, double seconds);

/// Integer-sheet-pump (spec-quantization 5): local search by linear programs from any x that satisfies the equations
/// and the lower bounds, with every accepted step also in the rows.
class SheetPump {
 public:
  explicit SheetPump(const Program& program);
  ~SheetPump();
  SheetPump(const SheetPump&) = delete;
  SheetPump& operator=(const SheetPump&) = delete;

  /// Moves x into all rows by the least weighted change; false when the relaxation does not lead there.
  bool repair(std::vector<std::int64_t>& x);
  /// Pumps bundles while that lowers the objective; `thorough`: in both directions, without an early end.
  void descend(std::vector<std::int64_t>& x, bool thorough);
  /// Sheets that were pumped.
  std::size_t pumped() const { return pumped_; }

 private:
  struct Model;
  std::optional<std::vector<std::int64_t>> sheet(const std::vector<std::int64_t>& x, std::int32_t bundle, int sign);
  bool try_pump(std::vector<std::int64_t>& x, std::int32_t bundle, int sign);
  std::optional<std::vector<std::int64_t>> round_solution();
  void prepare(const std::vector<std::int64_t>& x);

  const Program& program_;
  std::unique_ptr<Model> model_;
  std::size_t pumped_ = 0;
};

}  // namespace hexfield::quantize
