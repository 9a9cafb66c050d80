#include "hexfield/base/parallel.hpp"
#include "multigrid.hpp"
#include "node_frames.hpp"

namespace hexfield {

using harmonics::Sh;

namespace {

using Kind = NodeConstraint::Kind;
using Spaces = NodeSpaces<9, 2>;

constexpr std::size_t grain = 256;
constexpr int most_iterations = 200;

Spaces spaces_of(const std::vector<NodeConstraint>& constraints) {
  return Spaces(constraints, [](const NodeConstraint& c) { return harmonics::aligned_basis(c.direction).twist; });
}

// The part of every vector that constraints give.
std::vector<double> given_part(const std::vector<NodeConstraint>& constraints) {
  std::vector<double> given(9 * constraints.size(), 0.0);
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    Eigen::Map<Sh> a(given.data() + 9 * i);
    if (constraints[i].kind == Kind::fixed) a = harmonics::of_frame(constraints[i].frame);
    if (constraints[i].kind == Kind::aligned) a = harmonics::aligned_basis(constraints[i].direction).offset;
  }
  return given;
}

// Residual of the given part alone: -P L (given).
std::vector<double> right_hand_side(const NodeGraph& graph, const Spaces& spaces, const std::vector<double>& given) {
  std::vector<double> b(given.size(), 0.0);
  parallel_for(graph.owned(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Sh sum = Sh::Zero();
      const Eigen::Map<const Sh> own(given.data() + 9 * i);
      for (auto k = static_cast<std::size_t>(graph.offsets[i]); k < static_cast<std::size_t>(graph.offsets[i + 1]); ++k)
        sum += graph.weights[k] *
               (Eigen::Map<const Sh>(given.data() + 9 * static_cast<std::size_t>(graph.columns[k])) - own);
      Eigen::Map<Sh>(b.data() + 9 * i) = spaces.projected(i, sum);
    }
  });
  return b;
}

// Conjugate gradients preconditioned by one V-cycle.
int solve(const NodeGraph& graph, Multigrid<9, 2>& multigrid, std::vector<double> r, std::vector<double>& x,
          double tolerance) {
  const std::size_t n = 9 * graph.owned();
  std::vector<double> z(r.size(), 0.0), p(r.size(), 0.0), q(r.size(), 0.0);
  x.assign(r.size(), 0.0);
  const double start = dot(graph, 9, r, r);
  double last = 1;
  int iteration = 0;
  for (; iteration < most_iterations; ++iteration) {
    if (!(dot(graph, 9, r, r) > tolerance * tolerance * start)) break;
    multigrid.cycle(r, z);
    const double now = dot(graph, 9, r, z);
    const double beta = iteration == 0 ? 0 : now / last;
    for (std::size_t k = 0; k < n; ++k) p[k] = z[k] + beta * p[k];
    multigrid.apply(p, q);
    const double curvature = dot(graph, 9, p, q);
    if (!(curvature > 0)) break;
    const double step = now / curvature;
    for (std::size_t k = 0; k < n; ++k) {
      x[k] += step * p[k];
      r[k] -= step * q[k];
    }
    last = now;
  }
  return iteration;
}

}  // namespace

NodeFrames linear_start(const Hierarchy& hierarchy, const std::vector<NodeConstraint>& constraints,
                        const std::vector<NodeConstraint>& root_constraints, double tolerance, int& iterations) {
  const NodeGraph& graph = hierarchy.graph();
  const Spaces spaces = spaces_of(constraints);
  const std::vector<double> given = given_part(constraints);
  std::vector<double> x;
  {
    Multigrid<9, 2> multigrid(hierarchy, spaces, spaces_of(root_constraints));
    iterations = solve(graph, multigrid, right_hand_side(graph, spaces, given), x, tolerance);
  }
  NodeFrames frames(graph.local());
  parallel_for(graph.owned(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const NodeConstraint& c = constraints[i];
      const Sh a = Eigen::Map<const Sh>(given.data() + 9 * i) + Eigen::Map<const Sh>(x.data() + 9 * i);
      if (c.kind == Kind::free) frames.frame[i] = harmonics::project(a).frame;
      if (c.kind == Kind::aligned) frames.frame[i] = harmonics::project(a, harmonics::aligned_basis(c.direction)).frame;
      if (c.kind == Kind::fixed) frames.frame[i] = c.frame;
      frames.sh[i] = harmonics::of_frame(frames.frame[i]);
    }
  });
  share_frames(graph, frames);
  return frames;
}

}  // namespace hexfield
