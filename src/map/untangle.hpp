#pragma once

#include <functional>

#include "map_problem.hpp"
#include "solve_monitor.hpp"

namespace hexfield {

/// Makes inverted tets positive by minimising the regularised distortion with a falling epsilon (Garanzha et
/// al. 2021), from `start` (all unknowns, on rank 0), towards `frames` (per tet on rank 0, combed, columns are the
/// wanted steps of one parameter unit). Tets weigh by their edge length, so that the small ones near singularities are
/// heard. With `fixed` not empty the integer unknowns stay at these values. Returns the unknowns on rank 0; they may
/// still have inverted tets when it does not succeed within `max_rounds` or their number stops falling. Collective.
std::vector<double> untangle(const MapProblem& problem, const std::vector<double>& start,
                             const std::vector<double>& fixed, const std::vector<Mat3>& frames, int max_rounds,
                             SolveMonitor& monitor);
/// The same towards parameter steps of `edge` in the domain. Collective.
std::vector<double> untangle(const MapProblem& problem, const std::vector<double>& start,
                             const std::vector<double>& fixed, double edge, int max_rounds, SolveMonitor& monitor);

/// The fit to `frames` (per tet on rank 0, combed, columns are the steps of one parameter unit) under a growing
/// convex penalty where the symmetric part of J F is not safely positive: a fit turns tets over where the frames are
/// far from integrable, and this moves whole singular arcs across such places while every tet stays turned as its
/// frame is, so no edge is wound the wrong number of times. After every growth of the penalty `done` is asked, on
/// all ranks, with the unknowns on rank 0. With `fixed` not empty the integer unknowns stay at these values. Returns
/// the last unknowns on rank 0. Collective.
std::vector<double> make_positive(const MapProblem& problem, std::vector<double> start,
                                  const std::vector<double>& fixed, const std::vector<Mat3>& frames,
                                  SolveMonitor& monitor, const std::function<bool(const std::vector<double>&)>& done);

}  // namespace hexfield
