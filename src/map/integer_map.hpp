#pragma once

#include "map_problem.hpp"
#include "solve_monitor.hpp"

namespace hexfield {

/// What reach_integers() must know, the same on all ranks except `start`.
struct IntegerGoal {
  std::vector<double> integers;  ///< wanted values of the integer unknowns
  std::vector<double> start;     ///< rank 0: all unknowns of an injective map
  double edge = 1;               ///< domain length of one parameter step
  int first_phase = 0;           ///< where to go on after a restart
  std::vector<double> memory;    ///< rank 0: that of Newton's method there
  /// Rank 0, per tet, combed: the steps of one parameter unit that the integers suggest; or empty.
  std::vector<Mat3> frames;
};

struct IntegerOutcome {
  std::vector<double> unknowns;  ///< rank 0: all unknowns of the last map
  bool reached = false;          ///< the integers are exact, all tets were positive all the time
  double distance = 0;           ///< largest distance of an integer unknown from its goal
};

/// Where an interrupted run of reach_integers() stood, from the iterate it offered; nullopt when the row does
/// not fit the space.
std::optional<IntegerGoal> unpack_goal(std::vector<double> row, const ConformingSpace& space);

/// Number of penalty phases before the integers are fixed.
int num_integer_phases();

/// With frames: fits a map that has the integers to them and makes it positive; with none, or where that leaves a tet
/// turned over, drives the integer unknowns from the start to their goals under the symmetric Dirichlet energy with a
/// growing quadratic penalty, never through an inverted tet (spec-lmff section 9, homotopy), and fixes them. Then
/// minimises the energy alone. Collective.
IntegerOutcome reach_integers(const MapProblem& problem, const IntegerGoal& goal, SolveMonitor& monitor);

}  // namespace hexfield
