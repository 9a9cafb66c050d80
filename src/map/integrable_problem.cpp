#include "integrable_problem.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hexfield/base/agree.hpp"
#include "hexfield/base/parallel.hpp"

namespace hexfield::integrable {
namespace {

constexpr std::size_t grain = 256;
constexpr double infinity = std::numeric_limits<double>::infinity();

Jacobians at(const double* x, std::size_t t) { return Jacobians(x + 9 * t); }
Eigen::Map<RowMajor3> at(double* x, std::size_t t) { return Eigen::Map<RowMajor3>(x + 9 * t); }

double global_sum(MPI_Comm comm, double x) {
  MPI_Allreduce(MPI_IN_PLACE, &x, 1, MPI_DOUBLE, MPI_SUM, comm);
  return x;
}

// Removes direction d from the space of the projector; keeps at least one dimension.
void restrict_row(Mat3& projector, const Vec3& d) {
  const Vec3 inside = projector * d;
  if (inside.norm() < 1e-6 || projector.trace() < 1.5) return;
  const Vec3 u = inside.normalized();
  projector -= u * u.transpose();
}

void add_constraint(std::array<Mat3, 3>& rows, const AxisConstraint& c) {
  const auto axis = static_cast<std::size_t>(octahedral::axis(c.label));
  if (c.kind == AxisConstraint::Kind::feature_face) {
    const Vec3 t1 = c.direction.unitOrthogonal();
    restrict_row(rows[axis], t1);
    restrict_row(rows[axis], c.direction.cross(t1));
    return;
  }
  for (std::size_t j = 0; j < 3; ++j)
    if (j != axis) restrict_row(rows[j], c.direction);
}

void project_rows(const std::array<Mat3, 3>& rows, Eigen::Ref<RowMajor3> j) {
  for (int k = 0; k < 3; ++k) j.row(k) = (rows[static_cast<std::size_t>(k)] * j.row(k).transpose()).transpose();
}

}  // namespace

Problem::Problem(const DistributedMesh& mesh, const FrameField& field, std::span<const AxisConstraint> constraints,
                 bool root)
    : mesh_(mesh) {
  std::vector<double> quaternions, matchings;
  if (root)
    for (std::size_t t = 0; t < field.frames.size(); ++t) {
      const Quaternion& q = field.frames[t];
      quaternions.insert(quaternions.end(), {q.w(), q.x(), q.y(), q.z()});
      for (octahedral::Rotation m : field.matchings[t]) matchings.push_back(m);
    }
  quaternions = mesh_.scatter_tets(quaternions, 4);
  matchings = mesh_.scatter_tets(matchings, 4);
  read_constraints(constraints, field.frames, root);
  compute_geometry();
  for (std::size_t i = 0; i < faces_.size(); ++i)
    faces_[i].matching = octahedral::matrix(static_cast<octahedral::Rotation>(std::lround(matchings[i])));
  compute_start(quaternions);
  scales_.assign(mesh_.local().num_tets(), 1.0);
  int size = 1;
  MPI_Comm_size(mesh_.comm(), &size);
  alone_ = size == 1;
}

void Problem::read_constraints(std::span<const AxisConstraint> constraints, std::span<const Quaternion> frames,
                               bool root) {
  // Face constraints first: an edge in the face then finds its normal row fixed already.
  std::vector<double> rows;
  if (root) {
    std::vector<std::array<Mat3, 3>> all(frames.size(), {Mat3::Identity(), Mat3::Identity(), Mat3::Identity()});
    for (bool faces : {true, false})
      for (const AxisConstraint& c : constraints)
        if ((c.kind == AxisConstraint::Kind::feature_face) == faces) add_constraint(all[c.tet.index()], c);
    for (const auto& tet : all)
      for (const Mat3& p : tet) rows.insert(rows.end(), p.data(), p.data() + 9);
  }
  rows = mesh_.scatter_tets(rows, 27);
  projectors_.resize(mesh_.local().num_tets());
  constrained_.resize(projectors_.size());
  for (std::size_t t = 0; t < projectors_.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      projectors_[t][k] = Eigen::Map<const Mat3>(rows.data() + 27 * t + 9 * k);
      if (projectors_[t][k] != Mat3::Identity()) constrained_[t] = 1;
    }
}

void Problem::compute_geometry() {
  const TetMesh& local = mesh_.local();
  volumes_.resize(local.num_tets());
  double total = 0;
  for (std::size_t t = 0; t < local.num_tets(); ++t) {
    volumes_[t] = signed_volume6(local, TetId(static_cast<std::int64_t>(t))) / 6;
    if (t < mesh_.num_owned()) total += volumes_[t];
  }
  total = global_sum(mesh_.comm(), total);
  for (double& v : volumes_) v /= total;
  faces_.resize(4 * mesh_.num_owned());
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    const HalfFaceId h(static_cast<std::int64_t>(i));
    const HalfFaceId o = local.opposite_half_face(h);
    faces_[i].normal = outward_normal(local, h);
    faces_[i].neighbour = o.valid() ? o.tet().value : -1;
  }
}

void Problem::compute_start(const std::vector<double>& quaternions) {
  start_.resize(size());
  agree(mesh_.comm(), [&] {
    std::vector<std::int64_t> ids;
    std::vector<Vec3> places;
    for (std::size_t t = 0; t < mesh_.num_owned(); ++t) {
      const double* q = quaternions.data() + 4 * t;
      auto j = at(start_.data(), t);
      j = Quaternion(q[0], q[1], q[2], q[3]).toRotationMatrix().transpose();
      project_rows(projectors_[t], j);
      if (j.determinant() > 1e-3) continue;
      ids.push_back(mesh_.global_tets()[t]);
      places.push_back(centroid(mesh_.local(), TetId(static_cast<std::int64_t>(t))));
    }
    if (ids.empty()) return;
    throw Error(ExitCode::no_seamless_map,
                fmt::format("The frames of {} tets, first of tet {}, are too far from the features they must follow.",
                            ids.size(), ids.front()),
                ids, places);
  });
}

const double* Problem::with_ghosts(std::span<const double> owned) {
  if (alone_) return owned.data();
  ghosted_.resize(9 * mesh_.local().num_tets());
  std::copy(owned.begin(), owned.end(), ghosted_.begin());
  mesh_.update_ghosts(ghosted_, 9);
  return ghosted_.data();
}

void Problem::refresh_scales(std::span<const double> frames) {
  for (std::size_t t = 0; t < mesh_.num_owned(); ++t) scales_[t] = 1 / std::cbrt(at(frames.data(), t).determinant());
  mesh_.update_ghosts(scales_, 1);
}

void Problem::set_stage(const IntegrableStage& stage) {
  stage_ = stage;
  const auto tets = static_cast<double>(mesh_.num_global_tets());
  face_sums_.assign(mesh_.num_owned(), Mat3::Zero());
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    HalfFace& f = faces_[i];
    if (f.neighbour < 0) continue;
    const std::size_t t = i / 4;
    const auto n = static_cast<std::size_t>(f.neighbour);
    const double a = 0.5 * (scales_[t] + scales_[n]);
    const double alpha = stage.smoothness * (volumes_[t] + volumes_[n]) / 4 * a * a;
    const double beta = stage.integrability / (2 * tets) * a * a;
    f.whole = 2 * (alpha + beta);
    f.beta2 = 2 * beta;
    face_sums_[t] += f.whole * Mat3::Identity() - f.beta2 * f.normal * f.normal.transpose();
  }
}

Problem::FaceWeights Problem::face_weights(std::size_t t, int face) const {
  const HalfFace& f = faces_[4 * t + static_cast<std::size_t>(face)];
  return {f.whole, f.beta2, f.normal};
}

Energies Problem::energies(std::span<const double> frames) {
  const double* x = with_ghosts(frames);
  const auto tets = static_cast<double>(mesh_.num_global_tets());
  std::vector<Energies> parts((mesh_.num_owned() + grain - 1) / grain);
  parallel_for(mesh_.num_owned(), grain, [&](std::size_t begin, std::size_t end) {
    Energies& e = parts[begin / grain];
    for (std::size_t t = begin; t < end; ++t) {
      const Mat3 j = at(x, t);
      e.distortion += volumes_[t] * solve::symmetric_dirichlet(scales_[t] * j);
      for (std::size_t i = 4 * t; i < 4 * t + 4; ++i) {
        const HalfFace& f = faces_[i];
        if (f.neighbour < 0) continue;
        // Each rank adds half of what its side of a face sees.
        const auto n = static_cast<std::size_t>(f.neighbour);
        const double a = 0.5 * (scales_[t] + scales_[n]);
        const Mat3 jump = j - f.matching * at(x, n);
        const double all = jump.squaredNorm();
        e.smoothness += 0.5 * a * a * (volumes_[t] + volumes_[n]) / 4 * all;
        e.integrability += 0.5 * a * a / (2 * tets) * (jump - (jump * f.normal) * f.normal.transpose()).squaredNorm();
      }
    }
  });
  double sums[3] = {0, 0, 0};
  for (const Energies& e : parts) sums[0] += e.distortion, sums[1] += e.smoothness, sums[2] += e.integrability;
  MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_DOUBLE, MPI_SUM, mesh_.comm());
  return {sums[0], sums[1], sums[2]};
}

double Problem::max_curl(std::span<const double> frames) {
  const double* x = with_ghosts(frames);
  double worst = 0;
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    const HalfFace& f = faces_[i];
    if (f.neighbour < 0) continue;
    const auto n = static_cast<std::size_t>(f.neighbour);
    const Mat3 jump = at(x, i / 4) - f.matching * at(x, n);
    worst = std::max(worst, scales_[i / 4] * (jump - (jump * f.normal) * f.normal.transpose()).norm());
  }
  MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, mesh_.comm());
  return worst;
}

void Problem::linearise(std::span<const double> frames, std::span<double> gradient) {
  const double* x = with_ghosts(frames);
  distortion_.resize(mesh_.num_owned());
  parallel_for(mesh_.num_owned(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const Mat3 j = at(x, t);
      Mat3 g;
      const double a = scales_[t];
      solve::symmetric_dirichlet(a * j, g, distortion_[t]);
      g *= a * volumes_[t];
      distortion_[t].same *= a * a * volumes_[t];
      distortion_[t].crossed *= a * a * volumes_[t];
      for (std::size_t i = 4 * t; i < 4 * t + 4; ++i) {
        const HalfFace& f = faces_[i];
        if (f.neighbour < 0) continue;
        const Mat3 jump = j - f.matching * at(x, static_cast<std::size_t>(f.neighbour));
        g += f.whole * jump - (f.beta2 * (jump * f.normal)) * f.normal.transpose();
      }
      auto result = at(gradient.data(), t);
      result = g;
      if (constrained_[t] != 0) project_rows(projectors_[t], result);
    }
  });
}

void Problem::multiply(std::span<const double> x_owned, std::span<double> result) {
  const double* x = with_ghosts(x_owned);
  parallel_for(mesh_.num_owned(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const Mat3 j = at(x, t);
      Mat3 y = distortion_[t].apply(j) + j * face_sums_[t];
      for (std::size_t i = 4 * t; i < 4 * t + 4; ++i) {
        const HalfFace& f = faces_[i];
        if (f.neighbour < 0) continue;
        const Mat3 other = f.matching * at(x, static_cast<std::size_t>(f.neighbour));
        y -= f.whole * other - (f.beta2 * (other * f.normal)) * f.normal.transpose();
      }
      auto out = at(result.data(), t);
      out = y;
      if (constrained_[t] != 0) project_rows(projectors_[t], out);
    }
  });
}

solve::Mat9 Problem::distortion_block(std::size_t t) const { return distortion_[t].matrix(); }

solve::Mat9 Problem::block(std::size_t t) const {
  solve::Mat9 b = distortion_block(t);
  for (int k = 0; k < 3; ++k) b.block<3, 3>(3 * k, 3 * k) += face_sums_[t];
  if (constrained_[t] == 0) return b;
  const double trace = b.trace();
  const auto& p = projectors_[t];
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) {
      const Mat3 part = p[static_cast<std::size_t>(k)] * b.block<3, 3>(3 * k, 3 * l) * p[static_cast<std::size_t>(l)];
      b.block<3, 3>(3 * k, 3 * l) = part;
      if (k == l) b.block<3, 3>(3 * k, 3 * k) += trace * (Mat3::Identity() - p[static_cast<std::size_t>(k)]);
    }
  return b;
}

void Problem::project(std::span<double> x) const {
  for (std::size_t t = 0; t < mesh_.num_owned(); ++t)
    if (constrained_[t] != 0) project_rows(projectors_[t], at(x.data(), t));
}

std::vector<double> Problem::step_limits(std::span<const double> frames, std::span<const double> direction) const {
  std::vector<double> limits(mesh_.num_owned());
  parallel_for(limits.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t)
      limits[t] = solve::first_inversion(at(frames.data(), t), at(direction.data(), t));
  });
  return limits;
}

}  // namespace hexfield::integrable
