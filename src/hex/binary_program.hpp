#pragma once

#include <string>
#include <utility>
#include <vector>

#include "hexfield/base/control.hpp"

namespace hexfield::hex {

/// A linear function of variables that are 0 or 1, to be made small under linear rows.
struct BinaryProgram {
  struct Row {
    std::vector<std::pair<int, double>> terms;
    double low, high;
  };
  std::vector<double> cost;
  std::vector<double> upper;  ///< 0 where a variable has to be 0, else 1
  std::vector<Row> rows;

  int add(double column_cost, double column_upper) {
    cost.push_back(column_cost);
    upper.push_back(column_upper);
    return static_cast<int>(cost.size()) - 1;
  }
};

/// What a solution may take. Both are counts of work, so that the result does not depend on the machine.
struct BinaryLimits {
  int branches = 500;  ///< nodes of the tree
  double work = 5e8;   ///< simplex steps times the rows of the program
};

struct BinarySolution {
  std::vector<char> values;  ///< empty when nothing below the cutoff was found
  /// Nothing is better than the values by more than the gap, or, without values, nothing is below the cutoff.
  bool proven = false;
  std::string limit;  ///< which one ended the search, empty when it went to its end
};

/// Branch and cut with linear programs; solutions must cost less than `cutoff`, and one is good enough when nothing
/// can be better by `gap`. The same for the same program. Throws Error(stopped) when the control asks for it, also
/// inside a linear program.
BinarySolution minimise(const BinaryProgram& program, double cutoff, double gap, const BinaryLimits& limits,
                        const Control& control);

}  // namespace hexfield::hex
