#pragma once

#include <cmath>

namespace hexfield::solve {

/// For sums of doubles that must not depend on the order of their terms: terms rounded by order_free() to multiples
/// of one power of two, so coarse that no partial sum of them rounds. What order_free() takes as `grid` for up to
/// `count` terms of at most `largest` in size; 0 when there is nothing to add.
inline double order_free_grid(double largest, double count) {
  const double sum = largest * count;
  // Adding 1.5 * 2^k rounds to multiples of 2^(k - 52), of which a double holds 2^53 exactly; sums stay below 2^k.
  return sum > 0 ? std::ldexp(1.5, std::ilogb(sum) + 2) : 0;
}

/// x rounded to the grid.
inline double order_free(double x, double grid) { return (x + grid) - grid; }

}  // namespace hexfield::solve
