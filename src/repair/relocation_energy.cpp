#include "hexfield/repair/relocation_energy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hexfield/base/error.hpp"
#include "hexfield/base/parallel.hpp"

namespace hexfield {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }
constexpr std::size_t grain = 256;   // elements per piece of a parallel loop
constexpr double most_loss = 1.5;    // of a shape in one step
constexpr int max_shortenings = 30;  // halvings of the step of a point

}  // namespace

// Gradient and Hessian of one element in its own unknowns.
struct RelocationEnergy::Contribution {
  static constexpr int most = 12;
  double value = 0;
  int count = 0;
  std::array<int, most> unknowns;
  Eigen::Matrix<double, most, 1> gradient;
  Eigen::Matrix<double, most, most> hessian;
};

RelocationEnergy::RelocationEnergy(std::vector<Vec3> points, std::vector<Freedom> freedoms)
    : points_(std::move(points)), freedoms_(std::move(freedoms)) {
  require(points_.size() == freedoms_.size(), "Every point of a relocation needs its freedom.");
  first_.push_back(0);
  for (const Freedom& f : freedoms_) first_.push_back(first_.back() + f.dimensions);
}

void RelocationEnergy::add_alignment(int i, int j, const Vec3& direction, double weight) {
  quadratics_.push_back(
      {{i, j, -1}, {1, -1, 0}, 2, Mat3::Identity() - direction * direction.transpose(), Vec3::Zero(), weight});
}

void RelocationEnergy::add_shrinkage(int i, int j, double weight) {
  quadratics_.push_back({{i, j, -1}, {1, -1, 0}, 2, Mat3::Identity(), Vec3::Zero(), weight});
}

void RelocationEnergy::add_curvature(int i, int j, int k, double weight) {
  quadratics_.push_back({{i, k, j}, {1, 1, -2}, 3, Mat3::Identity(), Vec3::Zero(), weight});
}

void RelocationEnergy::add_attraction(int i, const Vec3& target, double weight) {
  quadratics_.push_back({{i, -1, -1}, {1, 0, 0}, 1, Mat3::Identity(), target, weight});
}

void RelocationEnergy::add_tet(const std::array<int, 4>& corners, double weight) {
  if (std::any_of(corners.begin(), corners.end(), [&](int i) { return dimensions(i) > 0; }))
    tets_.push_back({corners, weight});
}

void RelocationEnergy::add_triangle(const std::array<int, 3>& corners, const Vec3& normal, double weight) {
  if (std::any_of(corners.begin(), corners.end(), [&](int i) { return dimensions(i) > 0; }))
    triangles_.push_back({corners, normal, weight});
}

Vec3 RelocationEnergy::position(int i, const Eigen::VectorXd& y) const {
  Vec3 x = points_[at(i)];
  for (int k = 0; k < dimensions(i); ++k) x += y[first_[at(i)] + k] * freedoms_[at(i)].basis.col(k);
  return x;
}

std::span<const int> RelocationEnergy::corners(std::size_t e) const {
  if (e < quadratics_.size()) return {quadratics_[e].points.data(), at(quadratics_[e].count)};
  e -= quadratics_.size();
  if (e < tets_.size()) return tets_[e].corners;
  return triangles_[e - tets_.size()].corners;
}

double RelocationEnergy::element_value(std::size_t e, const Eigen::VectorXd& y) const {
  if (e < quadratics_.size()) {
    const Quadratic& q = quadratics_[e];
    Vec3 r = -q.offset;
    for (int k = 0; k < q.count; ++k) r += q.coefficients[at(k)] * position(q.points[at(k)], y);
    return q.weight * (q.metric * r).squaredNorm();
  }
  const std::size_t k = e - quadratics_.size();
  return (k < tets_.size() ? tets_[k].weight : triangles_[k - tets_.size()].weight) * shape_of(e, y);
}

double RelocationEnergy::shape_of(std::size_t e, const Eigen::VectorXd& y) const {
  e -= quadratics_.size();
  if (e < tets_.size()) {
    const auto& c = tets_[e].corners;
    return tet_shape({position(c[0], y), position(c[1], y), position(c[2], y), position(c[3], y)});
  }
  const Triangle& t = triangles_[e - tets_.size()];
  return triangle_shape({position(t.corners[0], y), position(t.corners[1], y), position(t.corners[2], y)}, t.normal);
}

double RelocationEnergy::value(const Eigen::VectorXd& y) const {
  return parallel_sum(num_elements(), grain, [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t e = begin; e < end; ++e) sum += element_value(e, y);
    return sum;
  });
}

void RelocationEnergy::shorten(const Eigen::VectorXd& y, Eigen::VectorXd& step) const {
  const std::size_t first = quadratics_.size(), n = num_elements() - first;
  std::vector<double> limit(n);
  parallel_for(n, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) limit[k] = shape_of(first + k, y) + most_loss;
  });
  std::vector<char> bad(n), shorter(points_.size());
  for (int round = 0; round < max_shortenings; ++round) {
    const Eigen::VectorXd there = y + step;
    parallel_for(n, grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) bad[k] = !(shape_of(first + k, there) <= limit[k]);
    });
    std::fill(shorter.begin(), shorter.end(), 0);
    bool any = false;
    for (std::size_t k = 0; k < n; ++k) {
      if (bad[k] == 0) continue;
      any = true;
      for (int c : corners(first + k)) shorter[at(c)] = 1;
    }
    if (!any) return;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (shorter[i] != 0) step.segment(first_[i], dimensions(static_cast<int>(i))) /= 2;
  }
}

void RelocationEnergy::element_derivatives(std::size_t e, const Eigen::VectorXd& y, Contribution& out) const {
  const auto points = corners(e);
  const std::size_t n = points.size();
  std::array<Vec3, 4> x;
  for (std::size_t c = 0; c < n; ++c) x[c] = position(points[c], y);
  std::array<Vec3, 4> gradient;
  std::array<std::array<Mat3, 4>, 4> hessian;
  const bool quadratic = e < quadratics_.size();
  if (quadratic) {
    const Quadratic& q = quadratics_[e];
    Vec3 r = -q.offset;
    for (std::size_t c = 0; c < n; ++c) r += q.coefficients[c] * x[c];
    r = q.metric * r;
    out.value = q.weight * r.squaredNorm();
    for (std::size_t c = 0; c < n; ++c) {
      gradient[c] = 2 * q.weight * q.coefficients[c] * r;
      for (std::size_t d = 0; d < n; ++d)
        hessian[c][d] = 2 * q.weight * q.coefficients[c] * q.coefficients[d] * q.metric;
    }
  } else if (e < quadratics_.size() + tets_.size()) {
    const double weight = tets_[e - quadratics_.size()].weight;
    const TetShape s = tet_shape_derivatives(x);
    out.value = weight * s.value;
    for (std::size_t c = 0; c < 4; ++c) {
      gradient[c] = weight * s.gradient[c];
      for (std::size_t d = 0; d < 4; ++d) hessian[c][d] = weight * s.hessian[c][d];
    }
  } else {
    const Triangle& t = triangles_[e - quadratics_.size() - tets_.size()];
    const TriangleShape s = triangle_shape_derivatives({x[0], x[1], x[2]}, t.normal);
    out.value = t.weight * s.value;
    for (std::size_t c = 0; c < 3; ++c) {
      gradient[c] = t.weight * s.gradient[c];
      for (std::size_t d = 0; d < 3; ++d) hessian[c][d] = t.weight * s.hessian[c][d];
    }
  }
  restrict_to_unknowns(points, gradient, hessian, out);
  if (quadratic) return;
  project_to_semidefinite(out.hessian.topLeftCorner(out.count, out.count));
}

void RelocationEnergy::restrict_to_unknowns(std::span<const int> points, const std::array<Vec3, 4>& gradient,
                                            const std::array<std::array<Mat3, 4>, 4>& hessian,
                                            Contribution& out) const {
  const std::size_t n = points.size();
  out.count = 0;
  std::array<int, 5> begin{};
  for (std::size_t c = 0; c < n; ++c) {
    begin[c] = out.count;
    for (int k = 0; k < dimensions(points[c]); ++k) {
      out.unknowns[at(out.count)] = first_[at(points[c])] + k;
      out.gradient[out.count++] = gradient[c].dot(freedoms_[at(points[c])].basis.col(k));
    }
  }
  begin[n] = out.count;
  for (std::size_t c = 0; c < n; ++c)
    for (std::size_t d = 0; d < n; ++d) {
      const int rows = begin[c + 1] - begin[c], columns = begin[d + 1] - begin[d];
      if (rows == 0 || columns == 0) continue;
      out.hessian.block(begin[c], begin[d], rows, columns) = freedoms_[at(points[c])].basis.leftCols(rows).transpose() *
                                                             hessian[c][d] *
                                                             freedoms_[at(points[d])].basis.leftCols(columns);
    }
}

double RelocationEnergy::derivatives(const Eigen::VectorXd& y, Eigen::VectorXd& gradient,
                                     Eigen::SparseMatrix<double>& hessian) const {
  const std::size_t n = num_elements();
  std::vector<std::size_t> first(n + 1, 0);  // of the entries of each element
  for (std::size_t e = 0; e < n; ++e) {
    std::size_t unknowns = 0;
    for (int c : corners(e)) unknowns += at(dimensions(c));
    first[e + 1] = first[e] + unknowns * (unknowns + 1) / 2;
  }
  std::vector<Eigen::Triplet<double>> entries(first[n]);
  struct Slope {
    std::array<int, Contribution::most> unknowns;
    std::array<double, Contribution::most> values;
    int count = 0;
    double energy = 0;
  };
  std::vector<Slope> slopes(n);
  parallel_for(n, grain / 4, [&](std::size_t begin, std::size_t end) {
    Contribution c;
    for (std::size_t e = begin; e < end; ++e) {
      element_derivatives(e, y, c);
      Slope& s = slopes[e];
      s.unknowns = c.unknowns;
      s.count = c.count;
      s.energy = c.value;
      std::size_t k = first[e];
      for (int i = 0; i < c.count; ++i) {
        s.values[at(i)] = c.gradient[i];
        for (int j = 0; j <= i; ++j) {
          const auto [low, high] = std::minmax(c.unknowns[at(i)], c.unknowns[at(j)]);
          entries[k++] = {high, low, c.hessian(i, j)};
        }
      }
    }
  });
  gradient = Eigen::VectorXd::Zero(num_unknowns());
  double energy = 0;
  for (const Slope& s : slopes) {
    energy += s.energy;
    for (int i = 0; i < s.count; ++i) gradient[s.unknowns[at(i)]] += s.values[at(i)];
  }
  hessian.resize(num_unknowns(), num_unknowns());
  hessian.setFromTriplets(entries.begin(), entries.end());
  return energy;
}

}  // namespace hexfield
