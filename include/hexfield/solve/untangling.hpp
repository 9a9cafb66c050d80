#pragma once

#include "hexfield/solve/kernels.hpp"

namespace hexfield::solve {

/// Regularised distortion of Garanzha et al. 2021, finite also for inverted tets: with D = det J and
/// chi = (D + sqrt(D^2 + epsilon^2)) / 2, the energy |J|^2 / chi^(2/3) + (D^2 + 1) / chi.
double untangle_energy(const Mat3& jacobian, double epsilon);
/// Also the gradient and a positive-semidefinite Hessian (det J linearised; what is left is clamped).
double untangle_energy(const Mat3& jacobian, double epsilon, Vec9& gradient, Mat9& hessian);

}  // namespace hexfield::solve
