#pragma once

#include <random>

#include "hexfield/base/geometry.hpp"

namespace hexfield::testing {

/// Entries between -1 and 1.
inline Mat3 random_matrix(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  Mat3 m;
  for (int i = 0; i < 9; ++i) m(i / 3, i % 3) = uniform(random);
  return m;
}

}  // namespace hexfield::testing
