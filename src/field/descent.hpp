#pragma once

#include <deque>

#include "multigrid.hpp"
#include "node_frames.hpp"

namespace hexfield {

/// Limited-memory BFGS on the rotations of the nodes [Nocedal and Wright 2006, section 7.2]. The matrix to start
/// from is one V-cycle for the graph Laplacian on rotation vectors: at frames that hardly differ from their
/// neighbours the Gauss-Newton matrix is 20/3 times that Laplacian.
class Descent {
 public:
  /// Collective.
  Descent(const Hierarchy& hierarchy, const std::vector<NodeConstraint>& constraints,
          const std::vector<NodeConstraint>& root_constraints, double max_turn, NodeFrames frames);

  const NodeFrames& frames() const { return frames_; }
  double energy() const { return energy_; }
  /// One step with line search; false when no step decreases the energy any more. Collective.
  bool step();

 private:
  using Spaces = NodeSpaces<3, 1>;
  struct Pair {
    std::vector<double> turn, change;  // of the frames and of the gradient
    double curvature;
  };

  void direct();
  void limit_turns();
  bool search(double longest);

  const Hierarchy& hierarchy_;
  const std::vector<NodeConstraint>& constraints_;
  Spaces spaces_;
  Multigrid<3, 1> multigrid_;
  double max_turn_;
  NodeFrames frames_;
  std::vector<double> gradient_, direction_;
  double energy_ = 0;
  std::deque<Pair> history_;
};

}  // namespace hexfield
