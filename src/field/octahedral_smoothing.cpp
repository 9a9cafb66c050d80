#include "hexfield/field/octahedral_smoothing.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "hexfield/base/agree.hpp"
#include "hexfield/base/error.hpp"
#include "hexfield/base/parallel.hpp"
#include "hexfield/field/spherical_harmonics.hpp"
#include "node_graph.hpp"
#include "reduced_laplacian.hpp"

namespace hexfield {
namespace {

using harmonics::Sh;
using Kind = NodeConstraint::Kind;

constexpr std::size_t grain = 1024;
constexpr int packed_constraint = 8;

struct Frames {
  std::vector<Quaternion> frame;
  std::vector<Sh> sh;
};

// The nodes of one rank (owned and ghosts) with their constraints, and the steps of the method on them.
class Smoother {
 public:
  Smoother(const NodeGraph& graph, const std::vector<double>& constraints)
      : graph_(graph), constraints_(graph.local()) {
    for (std::size_t i = 0; i < graph.local(); ++i) {
      const double* p = constraints.data() + packed_constraint * i;
      constraints_[i].kind = static_cast<Kind>(static_cast<int>(p[0]));
      constraints_[i].direction = Vec3(p[1], p[2], p[3]);
      constraints_[i].frame = Quaternion(Eigen::Map<const Eigen::Vector4d>(p + 4));
    }
  }

  Frames linear_start(const SmoothingOptions& options, SmoothingReport& report) const;
  Frames from(const std::vector<double>& frames) const;
  double energy(const Frames& frames) const;
  /// One Gauss-Newton step with line search; returns the new energy, or the old one when nothing decreased.
  double step(Frames& frames, double energy, ReducedLaplacian& hessian, bool keep, const SmoothingOptions& options,
              SmoothingReport& report) const;
  std::vector<int> turning_sizes() const;

 private:
  void share(Frames& frames) const;
  Sh difference(const std::vector<Sh>& sh, std::size_t i) const;
  Frames turned(const Frames& frames, const std::vector<Vec3>& turns, double share_of_step) const;

  const NodeGraph& graph_;
  std::vector<NodeConstraint> constraints_;
};

// sum_j w_ij (a_i - a_j)
Sh Smoother::difference(const std::vector<Sh>& sh, std::size_t i) const {
  Sh sum = Sh::Zero();
  for (auto k = static_cast<std::size_t>(graph_.offsets[i]); k < static_cast<std::size_t>(graph_.offsets[i + 1]); ++k)
    sum += graph_.weights[k] * (sh[i] - sh[static_cast<std::size_t>(graph_.columns[k])]);
  return sum;
}

void Smoother::share(Frames& frames) const {
  std::vector<double> q(4 * graph_.local());
  for (std::size_t i = 0; i < graph_.owned(); ++i)
    for (int c = 0; c < 4; ++c) q[4 * i + static_cast<std::size_t>(c)] = frames.frame[i].coeffs()[c];
  graph_.update_ghosts(q, 4);
  for (std::size_t i = graph_.owned(); i < graph_.local(); ++i) {
    frames.frame[i] = Quaternion(q.data() + 4 * i);
    frames.sh[i] = harmonics::of_frame(frames.frame[i]);
  }
}

Frames Smoother::from(const std::vector<double>& q) const {
  Frames frames{std::vector<Quaternion>(graph_.local()), std::vector<Sh>(graph_.local())};
  parallel_for(graph_.local(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      frames.frame[i] = Quaternion(q.data() + 4 * i);
      frames.sh[i] = harmonics::of_frame(frames.frame[i]);
      const NodeConstraint& c = constraints_[i];
      if (c.kind == Kind::fixed) frames.frame[i] = c.frame;
      if (c.kind == Kind::aligned)
        frames.frame[i] = harmonics::project(frames.sh[i], harmonics::aligned_basis(c.direction)).frame;
      if (c.kind != Kind::free) frames.sh[i] = harmonics::of_frame(frames.frame[i]);
    }
  });
  return frames;
}

Frames Smoother::linear_start(const SmoothingOptions& options, SmoothingReport& report) const {
  std::vector<NodeBasis> bases(graph_.local());
  std::vector<Sh> offset(graph_.local(), Sh::Zero());
  std::vector<int> sizes(graph_.local());
  for (std::size_t i = 0; i < graph_.local(); ++i) {
    const NodeConstraint& c = constraints_[i];
    if (c.kind == Kind::free) bases[i].size = 9;
    if (c.kind == Kind::fixed) offset[i] = harmonics::of_frame(c.frame);
    if (c.kind == Kind::aligned) {
      const auto basis = harmonics::aligned_basis(c.direction);
      bases[i].size = 2;
      bases[i].columns.leftCols<2>() = basis.twist;
      offset[i] = basis.offset;
    }
    sizes[i] = bases[i].size;
  }
  ReducedLaplacian laplacian(graph_, sizes);
  laplacian.set(bases, false);
  std::vector<double> rhs(laplacian.num_owned_unknowns(), 0.0), x;
  for (std::size_t i = 0; i < graph_.owned(); ++i) {
    const Sh r = -difference(offset, i);
    for (int k = 0; k < sizes[i]; ++k)
      rhs[laplacian.start(i) + static_cast<std::size_t>(k)] = sizes[i] == 9 ? r[k] : bases[i].columns.col(k).dot(r);
  }
  report.linear_iterations.push_back(laplacian.solve(rhs, x, options.linear_tolerance, 1000).iterations);
  Frames frames{std::vector<Quaternion>(graph_.local()), std::vector<Sh>(graph_.local())};
  parallel_for(graph_.owned(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const NodeConstraint& c = constraints_[i];
      Sh a = offset[i];
      for (int k = 0; k < sizes[i]; ++k) {
        const double value = x[laplacian.start(i) + static_cast<std::size_t>(k)];
        if (sizes[i] == 9)
          a[k] += value;
        else
          a += value * bases[i].columns.col(k);
      }
      if (c.kind == Kind::free) frames.frame[i] = harmonics::project(a).frame;
      if (c.kind == Kind::aligned) frames.frame[i] = harmonics::project(a, harmonics::aligned_basis(c.direction)).frame;
      if (c.kind == Kind::fixed) frames.frame[i] = c.frame;
      frames.sh[i] = harmonics::of_frame(frames.frame[i]);
    }
  });
  share(frames);
  return frames;
}

double Smoother::energy(const Frames& frames) const {
  double sum = parallel_sum(graph_.owned(), grain, [&](std::size_t begin, std::size_t end) {
    double part = 0;
    for (std::size_t i = begin; i < end; ++i)
      for (auto k = static_cast<std::size_t>(graph_.offsets[i]); k < static_cast<std::size_t>(graph_.offsets[i + 1]);
           ++k)
        part +=
            graph_.weights[k] * (frames.sh[i] - frames.sh[static_cast<std::size_t>(graph_.columns[k])]).squaredNorm();
    return part;
  });
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, graph_.comm());
  return sum / 4;  // every edge is seen from both ends
}

std::vector<int> Smoother::turning_sizes() const {
  std::vector<int> sizes(graph_.local());
  for (std::size_t i = 0; i < sizes.size(); ++i)
    sizes[i] = constraints_[i].kind == Kind::free ? 3 : (constraints_[i].kind == Kind::aligned ? 1 : 0);
  return sizes;
}

Frames Smoother::turned(const Frames& frames, const std::vector<Vec3>& turns, double share_of_step) const {
  Frames next = frames;
  parallel_for(graph_.owned(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double angle = turns[i].norm();
      if (angle == 0) continue;
      const Quaternion turn(Eigen::AngleAxisd(share_of_step * angle, turns[i] / angle));
      next.frame[i] = (turn * frames.frame[i]).normalized();
      next.sh[i] = harmonics::of_frame(next.frame[i]);
    }
  });
  share(next);
  return next;
}

double Smoother::step(Frames& frames, double old_energy, ReducedLaplacian& hessian, bool keep,
                      const SmoothingOptions& options, SmoothingReport& report) const {
  std::vector<NodeBasis> bases(graph_.local());
  std::vector<double> rhs(hessian.num_owned_unknowns(), 0.0), x;
  parallel_for(graph_.local(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const NodeConstraint& c = constraints_[i];
      if (c.kind == Kind::fixed) continue;
      const auto j = harmonics::tangent(frames.sh[i]);
      bases[i].size = c.kind == Kind::free ? 3 : 1;
      if (c.kind == Kind::free)
        bases[i].columns.leftCols<3>() = j;
      else
        bases[i].columns.col(0) = j * c.direction;
      if (i >= graph_.owned()) continue;
      const Sh r = -difference(frames.sh, i);
      for (int k = 0; k < bases[i].size; ++k)
        rhs[hessian.start(i) + static_cast<std::size_t>(k)] = bases[i].columns.col(k).dot(r);
    }
  });
  hessian.set(bases, keep);
  report.linear_iterations.push_back(hessian.solve(rhs, x, options.linear_tolerance, 1000).iterations);
  double slope = 0;
  for (std::size_t k = 0; k < x.size(); ++k) slope += x[k] * rhs[k];
  MPI_Allreduce(MPI_IN_PLACE, &slope, 1, MPI_DOUBLE, MPI_SUM, graph_.comm());
  std::vector<Vec3> turns(graph_.owned(), Vec3::Zero());
  for (std::size_t i = 0; i < graph_.owned(); ++i) {
    const double* y = x.data() + hessian.start(i);
    if (constraints_[i].kind == Kind::free) turns[i] = Vec3(y[0], y[1], y[2]);
    if (constraints_[i].kind == Kind::aligned) turns[i] = y[0] * constraints_[i].direction;
    const double angle = turns[i].norm();
    if (angle > options.max_turn) turns[i] *= options.max_turn / angle;
  }
  for (double t = 1; t > 1e-3; t /= 2) {
    Frames next = turned(frames, turns, t);
    const double new_energy = energy(next);
    if (new_energy > old_energy - 1e-4 * t * slope) continue;
    // Near singular arcs the Gauss-Newton model is too stiff: longer steps go on paying there.
    double best = new_energy;
    for (double longer = 2 * t; t == 1 && longer <= 8; longer *= 2) {
      Frames further = turned(frames, turns, longer);
      const double reached = energy(further);
      if (reached >= best * (1 - 1e-9)) break;
      best = reached;
      next = std::move(further);
    }
    frames = std::move(next);
    return best;
  }
  return old_energy;
}

std::vector<double> packed(const std::vector<NodeConstraint>& constraints) {
  std::vector<double> p(packed_constraint * constraints.size());
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    double* at = p.data() + packed_constraint * i;
    at[0] = static_cast<double>(static_cast<int>(constraints[i].kind));
    for (int d = 0; d < 3; ++d) at[1 + d] = constraints[i].direction[d];
    for (int d = 0; d < 4; ++d) at[4 + d] = constraints[i].frame.coeffs()[d];
  }
  return p;
}

}  // namespace

std::vector<Quaternion> smooth_octahedral_field(MPI_Comm comm, const RootGraph& root_graph,
                                                const std::vector<NodeConstraint>& constraints,
                                                const std::vector<Quaternion>* start, const SmoothingOptions& options,
                                                SmoothingReport& report, const Control& control) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  agree(comm, [&] {
    require(rank != 0 || constraints.size() == root_graph.size(), "A field needs one constraint record per node.");
    require(rank != 0 || start == nullptr || start->size() == root_graph.size(),
            "A field to smooth needs a frame per node.");
  });
  const NodeGraph graph(comm, root_graph);
  const Smoother smoother(graph, graph.scatter(packed(constraints), packed_constraint));
  Frames frames;
  if (start != nullptr) {
    std::span<const double> q;
    if (rank == 0 && !start->empty()) q = {(*start)[0].coeffs().data(), 4 * start->size()};
    frames = smoother.from(graph.scatter(q, 4));
  } else {
    frames = smoother.linear_start(options, report);
  }
  double energy = smoother.energy(frames);
  report.energies.assign(1, energy);
  std::optional<ReducedLaplacian> hessian;
  hessian.emplace(graph, smoother.turning_sizes());
  for (int iteration = 0; iteration < options.max_iterations && !report.converged; ++iteration) {
    const double next = smoother.step(frames, energy, *hessian, iteration % 5 != 0, options, report);
    report.converged = energy - next <= options.tolerance * energy;
    energy = next;
    report.energies.push_back(energy);
    if (control.progress) control.progress("smooth octahedral field", -1);
    if (control.stop_requested && control.stop_requested())
      throw Error(ExitCode::stopped, "Stopped while the octahedral field was being smoothed.");
  }
  std::vector<double> q(4 * graph.local());
  for (std::size_t i = 0; i < graph.owned(); ++i)
    for (int c = 0; c < 4; ++c) q[4 * i + static_cast<std::size_t>(c)] = frames.frame[i].coeffs()[c];
  const std::vector<double> on_root = graph.gather(q, 4);
  std::vector<Quaternion> result(on_root.size() / 4);
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = Quaternion(on_root.data() + 4 * i);
  return result;
}

}  // namespace hexfield
