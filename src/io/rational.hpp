#pragma once

#include <string_view>

#include "scanner.hpp"

namespace hexfield::io {

/// Reads a decimal number or a fraction "num/den" of integers of any length as the nearest double; fails when the
/// next token is neither.
double read_rational(Scanner& in, const char* what);

}  // namespace hexfield::io
