#pragma once

#include <limits>
#include <optional>

#include "arc_system.hpp"

namespace hexfield::quantize {

/// What an integer unknown x costs: weight * (x - target)^2 between its bounds.
struct IntegerCost {
  double weight = 0;
  double target = 0;
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
};

/// Integer unknowns under linear equations, as a dictionary: the basic ones are sums of the others, which rest at
/// integers. A column is an integer sheet (spec-quantization 5): raising its unknown by one changes the basic ones by
/// the entries of the column. The cost of an unknown is its parabola's secants between consecutive integers; they are
/// exact at integers. What lies outside its bounds counts before all costs.
class SheetDictionary {
 public:
  /// Unknowns 0 .. costs.size() - 1 with `equations` = 0; starts at the rounded targets of the non-basic ones.
  SheetDictionary(const std::vector<IntegerCost>& costs, const std::vector<ArcSum>& equations);

  /// One more unknown, a sum of those of the constructor.
  void add_sum(const ArcSum& sum, const IntegerCost& cost);
  void raise_least(std::size_t unknown, double least);
  void lower_most(std::size_t unknown, double most);

  /// Pumps sheets while that lowers the cost, each as far as it does; an unknown that comes to rest on the way becomes
  /// non-basic, which makes other sheets. Ends at the least cost of the relaxation. Returns how many sheets it pumped;
  /// nullopt when it does not end within a number of them that only rounding errors can exceed.
  std::optional<std::size_t> descend();

  /// Integer, or rational where the equations make them so.
  std::vector<double> values() const;
  double cost(const std::vector<double>& values) const;
  /// Sum over all unknowns of the distance to their bounds.
  double outside(const std::vector<double>& values) const;

 private:
  // Rate of change: of what is outside, then of the cost.
  struct Rate {
    double outside = 0;
    double cost = 0;
    Rate& operator+=(const Rate& r) {
      outside += r.outside, cost += r.cost;
      return *this;
    }
  };
  struct Choice {
    std::size_t column = 0;
    double direction = 0;  // 0: none
    Rate rate;
  };
  struct Stop {
    double distance = 0;
    std::size_t row = 0;  // number of rows: the column's own unknown
    double at = 0;        // the integer it comes to rest at
  };

  void eliminate(const std::vector<ArcSum>& equations);
  bool negative(const Rate& r) const;
  Rate slope(std::size_t unknown, double from) const;
  double next_rest(std::size_t unknown, double x, bool up) const;
  Rate bend(std::size_t unknown, double at) const;
  Choice price();
  Stop walk(const Choice& choice);
  void pivot(std::size_t row, std::size_t column);
  double* row(std::size_t i) { return entries_.data() + i * nonbasic_.size(); }
  const double* row(std::size_t i) const { return entries_.data() + i * nonbasic_.size(); }
  void refresh();

  std::vector<IntegerCost> costs_;
  std::vector<double> shift_;  // per unknown: its integers are moved by this little, so that no two rest at once
  std::vector<std::int32_t> basic_, nonbasic_;
  std::vector<double> entries_;  // rows of the basic unknowns
  std::vector<double> x_;        // per basic one: its value, shifted
  std::vector<double> rest_;     // per non-basic one: its integer
  double tolerance_ = 0;
  std::vector<double> rates_outside_, rates_cost_;  // per column, in price()
  std::vector<double> ahead_, place_ahead_;         // in walk(), per row and for the column: the next rest
};

}  // namespace hexfield::quantize
