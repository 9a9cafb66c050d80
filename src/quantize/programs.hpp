#pragma once

#include <optional>

#include "arc_system.hpp"
#include "sheet_dictionary.hpp"

namespace hexfield::quantize {

/// Integer lengths per bundle: the least sum of weight * (sum - target)^2 over the bundles and `squares`, with all
/// equations 0, all rows at least their bound and all lengths at least `least`.
struct Program {
  struct Row {
    ArcSum sum;  ///< over bundles
    std::int64_t least = 1;
  };
  struct Square {
    ArcSum sum;  ///< over bundles
    double weight = 0;
    double target = 0;
  };
  const BundleSystem& system;
  std::vector<double> weights;  ///< per bundle
  std::vector<std::int64_t> least;
  std::vector<Row> rows;
  std::vector<Square> squares;

  double objective(const std::vector<std::int64_t>& x) const;
  /// Whether x satisfies equations, bounds and rows.
  bool satisfied(const std::vector<std::int64_t>& x) const;
};

struct IntegerSolution {
  std::vector<std::int64_t> x;
  bool proven = false;  ///< no better one exists
};
/// By CBC, squares as secants that are exact at integers (spec-quantization 4.6). nullopt: none found.
std::optional<IntegerSolution> solve_ilp(const Program& program, double gap, double seconds);

/// Integer-sheet-pump (spec-quantization 5): sheets are the columns of a dictionary of the equations, which stays as
/// it is from one solve() to the next while rows are added to the program. Where the pumping ends with fractions, the
/// bundle in the middle between two integers is moved to one of them and the pumping goes on, the nearer one first;
/// the other one is tried as long as its relaxation promises less than what is known.
class SheetPump {
 public:
  explicit SheetPump(const Program& program);

  /// The solution for all rows that the program has by now; nullopt when none is found.
  std::optional<IntegerSolution> solve();
  /// Sheets that were pumped so far.
  std::size_t pumped() const { return pumped_; }

 private:
  bool pump(SheetDictionary& dictionary);
  void branch(const SheetDictionary& dictionary);

  const Program& program_;
  SheetDictionary dictionary_;
  std::size_t known_rows_ = 0;
  std::vector<std::int64_t> best_;
  double best_cost_ = 0;
  int nodes_ = 0;
  std::size_t pumped_ = 0;
};

}  // namespace hexfield::quantize
