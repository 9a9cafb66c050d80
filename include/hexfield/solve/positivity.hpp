#pragma once

#include "hexfield/solve/kernels.hpp"

namespace hexfield::solve {

/// Convex penalty on matrices whose symmetric part is not safely positive: sum over its eigenvalues l of
/// max(0, delta - l)^2. Where it vanishes the determinant is positive (Lipman 2012: bounded-distortion spaces), so
/// minimising it over linear spaces of maps is a convex way to an injective one. Twice differentiable almost
/// everywhere, gradient continuous.
double positivity_penalty(const Mat3& matrix, double delta);
/// Also the gradient and the Hessian (positive semidefinite; one of its one-sided values at kinks).
double positivity_penalty(const Mat3& matrix, double delta, Vec9& gradient, Mat9& hessian);

}  // namespace hexfield::solve
