#include "hexfield/field/align_field.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "align_kernel.hpp"
#include "hexfield/base/agree.hpp"
#include "hexfield/base/parallel.hpp"

namespace hexfield {
namespace {

constexpr int constraint_width = 9;  // count, two labels, two directions

SweepLimits limits_of(const AlignOptions& options) {
  return {std::cos(options.guard_degrees * M_PI / 360), std::cos(options.max_turn_degrees * M_PI / 360)};
}

double turn_between(const Quaternion& a, const Quaternion& b) {
  // asin of the distance is exact for the small turns that matter; acos would lose half of the digits.
  const double sign = a.dot(b) < 0 ? -1 : 1;
  return 4 * std::asin(std::min(1.0, (a.coeffs() - sign * b.coeffs()).norm() / 2));
}

bool misses(const Quaternion& q, const FrameConstraint& c) {
  return c.count > 0 && turn_between(q, project_frame(q, c)) > 1e-9;
}

std::vector<double> packed_constraints(std::size_t tets, std::span<const AxisConstraint> constraints) {
  std::vector<double> packed(tets * constraint_width, 0.0);
  for (const auto& [tet, c] : frame_constraints(constraints)) {
    double* p = packed.data() + tet.index() * constraint_width;
    p[0] = c.count;
    for (std::size_t k = 0; k < 2; ++k) {
      p[1 + k] = c.labels[k];
      for (int d = 0; d < 3 && static_cast<int>(k) < c.count; ++d)
        p[3 + 3 * k + static_cast<std::size_t>(d)] = c.directions[k][d];
    }
  }
  return packed;
}

FrameConstraint unpacked(const double* p) {
  FrameConstraint c;
  c.count = static_cast<int>(p[0]);
  for (std::size_t k = 0; k < 2; ++k) {
    c.labels[k] = static_cast<octahedral::Label>(p[1 + k]);
    c.directions[k] = Vec3(p[3 + 3 * k], p[4 + 3 * k], p[5 + 3 * k]);
  }
  return c;
}

// The share of this rank, from values that rank 0 holds.
AlignData distribute(const DistributedMesh& mesh, const FrameField& field, std::span<const AxisConstraint> constraints,
                     bool root) {
  AlignData data;
  data.owned = mesh.num_owned();
  data.tets = mesh.local().num_tets();
  std::vector<double> matchings;
  std::vector<double> axes;
  if (root) {
    const auto n = static_cast<std::size_t>(mesh.num_global_tets());
    matchings.resize(4 * n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t f = 0; f < 4; ++f) matchings[4 * i + f] = field.matchings[i][f];
    axes = packed_constraints(n, constraints);
  }
  matchings = mesh.scatter_tets(matchings, 4);
  axes = mesh.scatter_tets(axes, constraint_width);
  data.neighbours.resize(data.owned);
  data.from_neighbour.resize(data.owned);
  for (std::size_t i = 0; i < data.owned; ++i) {
    for (std::size_t f = 0; f < 4; ++f) {
      const HalfFaceId o = mesh.local().opposite[i][f];
      data.neighbours[i][f] = o.valid() ? o.tet().value : static_cast<std::int32_t>(data.tets);
      data.from_neighbour[i][f] = octahedral::inverse(static_cast<octahedral::Rotation>(matchings[4 * i + f]));
    }
    const double* p = axes.data() + i * constraint_width;
    if (p[0] > 0) data.constraints.emplace_back(static_cast<std::int32_t>(i), unpacked(p));
  }
  return data;
}

std::span<double> as_doubles(std::vector<Quaternion>& frames, std::size_t tets) {
  return {frames[0].coeffs().data(), 4 * tets};
}

double largest_turn(const std::vector<Quaternion>& a, const std::vector<Quaternion>& b, std::size_t owned) {
  double largest = 0;
  for (std::size_t i = 0; i < owned; ++i) largest = std::max(largest, turn_between(a[i], b[i]));
  return largest;
}

}  // namespace

AlignReport align_field(const DistributedMesh& mesh, FrameField& field, std::span<const AxisConstraint> constraints,
                        const AlignOptions& options) {
  int rank = 0;
  MPI_Comm_rank(mesh.comm(), &rank);
  const auto global = static_cast<std::size_t>(mesh.num_global_tets());
  agree(mesh.comm(), [&] {
    require(rank != 0 || (field.frames.size() == global && field.matchings.size() == global),
            "The field to align does not belong to the distributed mesh.");
  });
  const AlignData data = distribute(mesh, field, constraints, rank == 0);
  const std::span<const double> on_root = rank == 0 && global > 0
                                              ? std::span<const double>(field.frames[0].coeffs().data(), 4 * global)
                                              : std::span<const double>();
  const auto start = mesh.scatter_tets(on_root, 4);
  std::vector<Quaternion> current(data.tets + 1, Quaternion(0, 0, 0, 0));
  for (std::size_t i = 0; i < data.tets; ++i) current[i] = Quaternion(start.data() + 4 * i);
  std::vector<Quaternion> previous = current;
  std::vector<Quaternion> next = current;

  AlignReport report;
  const SweepLimits limits = limits_of(options);
  for (report.sweeps = 0; report.sweeps < options.sweeps; ++report.sweeps) {
    report.reverted += jacobi_sweep(data, limits, previous, current, next);
    mesh.update_ghosts(as_doubles(next, data.tets), 4);
    previous.swap(current);
    current.swap(next);
    if (options.tolerance <= 0) continue;
    report.largest_turn = largest_turn(previous, current, data.owned);
    MPI_Allreduce(MPI_IN_PLACE, &report.largest_turn, 1, MPI_DOUBLE, MPI_MAX, mesh.comm());
    if (report.largest_turn <= options.tolerance) {
      ++report.sweeps;
      break;
    }
  }
  for (int round = 0; round < 10; ++round) {
    long reverted = revert_broken(data, limits.guard, previous, current, next);
    MPI_Allreduce(MPI_IN_PLACE, &reverted, 1, MPI_LONG, MPI_SUM, mesh.comm());
    if (reverted == 0) break;
    mesh.update_ghosts(as_doubles(next, data.tets), 4);
    current.swap(next);
  }
  report.largest_turn = largest_turn(previous, current, data.owned);
  for (const ConstrainedTet& c : data.constraints)
    report.misaligned += misses(current[static_cast<std::size_t>(c.tet)], c.constraint);
  long counts[2] = {report.reverted, report.misaligned};
  MPI_Allreduce(MPI_IN_PLACE, counts, 2, MPI_LONG, MPI_SUM, mesh.comm());
  MPI_Allreduce(MPI_IN_PLACE, &report.largest_turn, 1, MPI_DOUBLE, MPI_MAX, mesh.comm());
  report.reverted = counts[0];
  report.misaligned = counts[1];
  const auto gathered = mesh.gather_tets({current[0].coeffs().data(), 4 * data.tets}, 4);
  if (rank == 0)
    for (std::size_t i = 0; i < global; ++i) field.frames[i] = Quaternion(gathered.data() + 4 * i);
  return report;
}

AlignReport align_submesh(const TetMesh& mesh, FrameField& field, std::span<const AxisConstraint> constraints,
                          std::span<const TetId> tets, const AlignOptions& options) {
  std::unordered_map<TetId, FrameConstraint> axes;
  for (const auto& [tet, c] : frame_constraints(constraints)) axes.emplace(tet, c);
  const SweepLimits limits = limits_of(options);
  AlignReport report;
  auto sweep = [&](TetId t) {
    const Quaternion own = field.frames[t.index()];
    Eigen::Vector4d sum = own.coeffs();
    std::array<Eigen::Vector4d, 4> around;
    std::size_t count = 0;
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId o = mesh.opposite_half_face(HalfFaceId(t, f));
      if (!o.valid()) continue;
      const Eigen::Vector4d g = (field.frames[o.tet().index()] * octahedral::quaternion(field.matching(o))).coeffs();
      sum += g.dot(sum) < 0 ? Eigen::Vector4d(-g) : g;
      around[count++] = g;
    }
    const double norm = sum.norm();
    Quaternion q = norm > 1e-12 ? Quaternion(Eigen::Vector4d(sum / norm)) : own;
    if (const auto c = axes.find(t); c != axes.end()) q = project_frame(q, c->second);
    q = limited(own, q, limits.turn);
    for (std::size_t k = 0; k < count; ++k)
      if (std::abs(around[k].dot(q.coeffs())) < limits.guard &&
          std::abs(around[k].dot(q.coeffs())) < std::abs(around[k].dot(own.coeffs()))) {
        ++report.reverted;
        return;
      }
    report.largest_turn = std::max(report.largest_turn, turn_between(own, q));
    field.frames[t.index()] = q;
  };
  for (report.sweeps = 0; report.sweeps < options.sweeps;) {
    report.largest_turn = 0;
    for (TetId t : tets) sweep(t);
    ++report.sweeps;
    if (options.tolerance > 0 && report.largest_turn <= options.tolerance) break;
  }
  for (TetId t : tets)
    if (const auto c = axes.find(t); c != axes.end()) report.misaligned += misses(field.frames[t.index()], c->second);
  return report;
}

}  // namespace hexfield
