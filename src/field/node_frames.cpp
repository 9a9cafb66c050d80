#include "node_frames.hpp"

#include "hexfield/base/exact_sum.hpp"
#include "hexfield/base/parallel.hpp"

namespace hexfield {

using harmonics::Sh;

namespace {

constexpr std::size_t grain = 1024;

}  // namespace

void share_frames(const NodeGraph& graph, NodeFrames& frames) {
  std::vector<double> q(4 * graph.local());
  for (std::size_t i = 0; i < graph.owned(); ++i)
    for (int c = 0; c < 4; ++c) q[4 * i + static_cast<std::size_t>(c)] = frames.frame[i].coeffs()[c];
  graph.update_ghosts(q, 4);
  for (std::size_t i = graph.owned(); i < graph.local(); ++i) {
    frames.frame[i] = Quaternion(q.data() + 4 * i);
    frames.sh[i] = harmonics::of_frame(frames.frame[i]);
  }
}

double energy_and_gradient(const NodeGraph& graph, const std::vector<NodeConstraint>& constraints,
                           const NodeFrames& frames, std::vector<double>& gradient) {
  using Kind = NodeConstraint::Kind;
  std::vector<double> energies(graph.owned());
  parallel_for(graph.owned(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Sh sum = Sh::Zero();
      double energy = 0;
      for (auto k = static_cast<std::size_t>(graph.offsets[i]); k < static_cast<std::size_t>(graph.offsets[i + 1]);
           ++k) {
        const Sh difference = frames.sh[i] - frames.sh[static_cast<std::size_t>(graph.columns[k])];
        energy += graph.weights[k] * difference.squaredNorm();
        sum += graph.weights[k] * difference;
      }
      energies[i] = energy / 4;  // every edge is seen from both ends
      Vec3 g = Vec3::Zero();
      if (constraints[i].kind != Kind::fixed) g = harmonics::tangent(frames.sh[i]).transpose() * sum;
      if (constraints[i].kind == Kind::aligned) g = g.dot(constraints[i].direction) * constraints[i].direction;
      Eigen::Map<Vec3>(gradient.data() + 3 * i) = g;
    }
  });
  return exact_sum(graph.comm(), energies);
}

NodeFrames turned(const NodeGraph& graph, const NodeFrames& frames, const std::vector<double>& turns, double share) {
  NodeFrames next = frames;
  parallel_for(graph.owned(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 turn = share * Vec3(turns.data() + 3 * i);
      const double angle = turn.norm();
      if (angle == 0) continue;
      next.frame[i] = (Quaternion(Eigen::AngleAxisd(angle, turn / angle)) * frames.frame[i]).normalized();
      next.sh[i] = harmonics::of_frame(next.frame[i]);
    }
  });
  share_frames(graph, next);
  return next;
}

double dot(const NodeGraph& graph, int width, const std::vector<double>& a, const std::vector<double>& b) {
  const auto w = static_cast<std::size_t>(width);
  std::vector<double> terms(graph.owned());
  parallel_for(graph.owned(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      double sum = 0;
      for (std::size_t c = w * i; c < w * (i + 1); ++c) sum += a[c] * b[c];
      terms[i] = sum;
    }
  });
  return exact_sum(graph.comm(), terms);
}

}  // namespace hexfield
