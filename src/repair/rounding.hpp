#pragma once

#include <cmath>

namespace hexfield {

/// A priority without its last digits, so that ties of a symmetric mesh stay ties in any charts of the tets.
inline double without_noise(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  return std::ldexp(std::round(std::ldexp(mantissa, 32)), exponent - 32);
}

}  // namespace hexfield
