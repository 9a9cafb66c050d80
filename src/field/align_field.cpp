#include "hexfield/field/align_field.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
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

namespace {

// Places of listed tets: a table over the range of their ids where the list is no small part of it.
class Places {
 public:
  explicit Places(std::span<const TetId> tets) {
    if (tets.empty()) return;
    const auto [low, high] = std::minmax_element(tets.begin(), tets.end());
    first_ = low->value;
    if (const auto range = static_cast<std::size_t>(high->value - first_) + 1; range <= 16 * tets.size())
      table_.assign(range, -1);
    else
      map_.reserve(tets.size());
    for (std::size_t k = 0; k < tets.size(); ++k) {
      const auto place = static_cast<std::int32_t>(k);
      if (table_.empty())
        map_.emplace(tets[k], place);
      else
        table_[static_cast<std::size_t>(tets[k].value - first_)] = place;
    }
  }

  // -1 for a tet that is not listed.
  std::int32_t operator()(TetId t) const {
    if (!table_.empty()) {
      const std::int64_t i = std::int64_t{t.value} - first_;
      return i < 0 || i >= static_cast<std::int64_t>(table_.size()) ? -1 : table_[static_cast<std::size_t>(i)];
    }
    const auto found = map_.find(t);
    return found == map_.end() ? -1 : found->second;
  }

 private:
  std::int32_t first_ = 0;
  std::vector<std::int32_t> table_;
  std::unordered_map<TetId, std::int32_t> map_;  // looked up only
};

// What Algorithm 1 needs of the listed tets, in their order.
struct SubmeshSweep {
  struct Neighbour {
    std::int32_t tet;     // of the mesh; -1 on the boundary
    std::int32_t listed;  // its place in the list; -1 for a boundary value
    octahedral::Rotation from;
  };
  std::vector<std::array<Neighbour, 4>> neighbours;
  std::vector<FrameConstraint> constraints;  // count 0: none
  std::vector<FrameProjection> projections;  // of the constraints
  std::vector<char> active;                  // a frame that it depends on has turned

  SubmeshSweep(const TetMesh& mesh, const FrameField& field, std::span<const AxisConstraint> axes,
               std::span<const TetId> tets)
      : neighbours(tets.size()), constraints(tets.size()), projections(tets.size()), active(tets.size(), 1) {
    const Places place(tets);
    for (const auto& [tet, c] : frame_constraints(axes))
      if (const std::int32_t k = place(tet); k >= 0) {
        constraints[static_cast<std::size_t>(k)] = c;
        projections[static_cast<std::size_t>(k)] = projection_of(c);
      }
    for (std::size_t k = 0; k < tets.size(); ++k)
      for (int f = 0; f < 4; ++f) {
        const HalfFaceId o = mesh.opposite_half_face(HalfFaceId(tets[k], f));
        Neighbour& n = neighbours[k][static_cast<std::size_t>(f)];
        n = {-1, -1, octahedral::identity};
        if (o.valid()) n = {o.tet().value, place(o.tet()), field.matching(o)};
      }
  }

  // The frames around tet k in its chart; returns how many there are.
  std::size_t around(const FrameField& field, std::size_t k, std::array<Eigen::Vector4d, 4>& frames) const {
    std::size_t count = 0;
    for (const Neighbour& n : neighbours[k]) {
      if (n.tet < 0) continue;
      const Quaternion& q = field.frames[static_cast<std::size_t>(n.tet)];
      frames[count++] = n.from == octahedral::identity ? q.coeffs() : (q * octahedral::quaternion(n.from)).coeffs();
    }
    return count;
  }
};

// The new frame of tet k; nothing when the guard forbids it.
std::optional<Quaternion> relaxed(const SubmeshSweep& sub, const FrameField& field, std::size_t k,
                                  const Quaternion& own, const SweepLimits& limits) {
  std::array<Eigen::Vector4d, 4> around;
  const std::size_t count = sub.around(field, k, around);
  Eigen::Vector4d sum = own.coeffs();
  for (std::size_t n = 0; n < count; ++n) sum += around[n].dot(sum) < 0 ? Eigen::Vector4d(-around[n]) : around[n];
  const double norm = sum.norm();
  Quaternion q = norm > 1e-12 ? Quaternion(Eigen::Vector4d(sum / norm)) : own;
  if (sub.constraints[k].count > 0) q = project_frame(q, sub.projections[k]);
  q = limited(own, q, limits.turn);
  for (std::size_t n = 0; n < count; ++n) {
    const double dot = std::abs(around[n].dot(q.coeffs()));
    if (dot < limits.guard && dot < std::abs(around[n].dot(own.coeffs()))) return std::nullopt;
  }
  return q;
}

}  // namespace

AlignReport align_submesh(const TetMesh& mesh, FrameField& field, std::span<const AxisConstraint> constraints,
                          std::span<const TetId> tets, const AlignOptions& options) {
  SubmeshSweep sub(mesh, field, constraints, tets);
  const SweepLimits limits = limits_of(options);
  AlignReport report;
  auto sweep = [&](std::size_t k) {
    const Quaternion own = field.frames[tets[k].index()];
    const auto q = relaxed(sub, field, k, own, limits);
    if (!q) {
      ++report.reverted;
      return;
    }
    const double turn = turn_between(own, *q);
    report.largest_turn = std::max(report.largest_turn, turn);
    field.frames[tets[k].index()] = *q;
    if (turn <= options.tolerance) return;
    sub.active[k] = 1;
    for (const auto& n : sub.neighbours[k])
      if (n.listed >= 0) sub.active[static_cast<std::size_t>(n.listed)] = 1;
  };
  for (report.sweeps = 0; report.sweeps < options.sweeps;) {
    report.largest_turn = 0;
    for (std::size_t k = 0; k < tets.size(); ++k) {
      if (options.tolerance > 0 && sub.active[k] == 0) continue;
      sub.active[k] = 0;
      sweep(k);
    }
    ++report.sweeps;
    if (options.tolerance > 0 && report.largest_turn <= options.tolerance) break;
  }
  for (std::size_t k = 0; k < tets.size(); ++k)
    report.misaligned += misses(field.frames[tets[k].index()], sub.constraints[k]);
  return report;
}

}  // namespace hexfield
