#pragma once

#include "map_problem.hpp"
#include "solve_monitor.hpp"

namespace hexfield {

/// Makes inverted tets positive by minimising the regularised distortion with a falling epsilon (Garanzha et
/// al. 2021), from `start` (all unknowns, on rank 0), towards parameter steps of `edge` in the domain. With
/// `fixed` not empty the integer unknowns stay at these values. Returns the unknowns on rank 0; they may still
/// have inverted tets when it does not succeed within `max_rounds` or the least determinant stops growing: where it
/// succeeds, a round about halves it or better. Collective.
std::vector<double> untangle(const MapProblem& problem, const std::vector<double>& start,
                             const std::vector<double>& fixed, double edge, int max_rounds, SolveMonitor& monitor);

/// Smallest det J edge^3 over the tets of a map with these unknowns. Serial.
double smallest_determinant(const TetMesh& mesh, const ConformingSpace& space, std::span<const double> y, double edge);

}  // namespace hexfield
