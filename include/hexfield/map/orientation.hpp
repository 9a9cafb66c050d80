#pragma once

#include "hexfield/base/geometry.hpp"

namespace hexfield {

/// Sign (-1, 0, 1) of det(b - a, c - a, d - a), exact for all finite doubles: a floating-point filter with
/// Shewchuk's static error bound, then rational arithmetic. Not finite coordinates give 0.
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

}  // namespace hexfield
