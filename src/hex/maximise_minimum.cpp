#include <algorithm>
#include <cmath>

#include "hex_topology.hpp"
#include "hexfield/hex/check.hpp"
#include "hexfield/hex/improve.hpp"

namespace hexfield {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

constexpr double negligible = 1e-7;  // share of a corner in the smooth minimum
constexpr int most_cg_steps = 80;

/// A corner that counts: its share, vertices and the derivative of its scaled Jacobian by each.
struct ActiveCorner {
  double share;
  std::array<int, 4> vertices;
  std::array<Vec3, 4> gradient;
};

class Maximiser {
 public:
  Maximiser(HexMesh& mesh, const MaximiseOptions& options, const Control& control)
      : mesh_(mesh),
        options_(options),
        control_(control),
        movable_(mesh.points.size(), 1),
        length_(mesh.points.size()) {
    if (!options.free_boundary) hold();
    measure_lengths();
  }

  void run() {
    std::vector<Vec3> best = mesh_.points;
    double best_minimum = minimum(mesh_.points);
    if (!(best_minimum > 0)) return;
    for (double p = options_.first_sharpness; p <= options_.last_sharpness; p *= 2) {
      double damping = 1;
      for (int step = 0; step < options_.steps; ++step) {
        if (control_.stop_requested && control_.stop_requested())
          throw Error(ExitCode::stopped, "Stopped while the scaled Jacobian was being raised.");
        const double gain = newton_step(p, damping);
        const double now = minimum(mesh_.points);
        if (now > best_minimum) {
          best_minimum = now;
          best = mesh_.points;
        }
        if (gain < options_.gain) break;
      }
    }
    mesh_.points = std::move(best);
  }

 private:
  void hold();
  void measure_lengths();
  double minimum(const std::vector<Vec3>& points) const { return smooth(points, -1); }
  double smooth(const std::vector<Vec3>& points, double p) const;
  void collect(double p);
  std::vector<Vec3> apply(const std::vector<Vec3>& d, double p, double damping) const;
  std::vector<Vec3> solve(double p, double damping) const;
  double newton_step(double p, double& damping);
  static double dot(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double sum = 0;
    for (std::size_t v = 0; v < a.size(); ++v) sum += a[v].dot(b[v]);
    return sum;
  }

  HexMesh& mesh_;
  const MaximiseOptions& options_;
  const Control& control_;
  std::vector<char> movable_;
  std::vector<double> length_;
  std::vector<ActiveCorner> corners_;
  std::vector<Vec3> gradient_;  ///< of the smooth minimum, upwards
};

void Maximiser::hold() {
  const auto sides = hex::sorted_sides(mesh_);
  for (std::int64_t side : hex::boundary_sides(sides))
    for (int v : hex::side_vertices(mesh_, side)) movable_[at(v)] = 0;
  for (const auto& quad : mesh_.feature_quads)
    for (int v : quad.vertices) movable_[at(v)] = 0;
  for (const auto& line : mesh_.feature_lines)
    for (int v : line.vertices) movable_[at(v)] = 0;
  for (const auto& point : mesh_.feature_points) movable_[at(point.vertex)] = 0;
}

void Maximiser::measure_lengths() {
  std::vector<double> count(mesh_.points.size(), 0);
  std::fill(length_.begin(), length_.end(), 0);
  for (const auto& hex : mesh_.hexes)
    for (const auto& e : hex::hex_edges) {
      const double l = (mesh_.points[at(hex[at(e[0])])] - mesh_.points[at(hex[at(e[1])])]).norm();
      for (int k : e) {
        length_[at(hex[at(k)])] += l;
        count[at(hex[at(k)])] += 1;
      }
    }
  for (std::size_t v = 0; v < length_.size(); ++v) length_[v] = count[v] > 0 ? length_[v] / count[v] : 1;
}

// -(1/p) log sum exp(-p SJ); for negative p the smallest SJ itself.
double Maximiser::smooth(const std::vector<Vec3>& points, double p) const {
  std::vector<double> values;
  values.reserve(8 * mesh_.hexes.size());
  double least = 1;
  for (const auto& hex : mesh_.hexes)
    for (const auto& corner : hex::hex_corners) {
      const Vec3& x = points[at(hex[at(corner[0])])];
      const Vec3 a = points[at(hex[at(corner[1])])] - x;
      const Vec3 b = points[at(hex[at(corner[2])])] - x;
      const Vec3 c = points[at(hex[at(corner[3])])] - x;
      const double s = a.cross(b).dot(c) / std::max(a.norm() * b.norm() * c.norm(), 1e-300);
      least = std::min(least, s);
      values.push_back(s);
    }
  if (p < 0) return least;
  double sum = 0;
  for (double s : values) sum += std::exp(-p * (s - least));
  return least - std::log(sum) / p;
}

void Maximiser::collect(double p) {
  const double value = smooth(mesh_.points, p);
  corners_.clear();
  gradient_.assign(mesh_.points.size(), Vec3::Zero());
  for (const auto& hex : mesh_.hexes)
    for (const auto& corner : hex::hex_corners) {
      ActiveCorner c{};
      std::array<Vec3, 3> u;
      std::array<double, 3> inverse{};
      for (std::size_t k = 0; k < 4; ++k) c.vertices[k] = hex[at(corner[k])];
      for (std::size_t k = 0; k < 3; ++k) {
        u[k] = mesh_.points[at(c.vertices[k + 1])] - mesh_.points[at(c.vertices[0])];
        inverse[k] = 1 / std::max(u[k].norm(), 1e-300);
        u[k] *= inverse[k];
      }
      const double s = u[0].cross(u[1]).dot(u[2]);
      c.share = std::exp(-p * (s - value));
      if (c.share < negligible) continue;
      c.gradient[0].setZero();
      for (std::size_t k = 0; k < 3; ++k) {
        c.gradient[k + 1] = (u[(k + 1) % 3].cross(u[(k + 2) % 3]) - s * u[k]) * inverse[k];
        c.gradient[0] -= c.gradient[k + 1];
      }
      for (std::size_t k = 0; k < 4; ++k) {
        if (movable_[at(c.vertices[k])] == 0) c.gradient[k].setZero();
        gradient_[at(c.vertices[k])] += c.share * c.gradient[k];
      }
      corners_.push_back(c);
    }
}

// (p (sum share g g^T - G G^T) + damping / length^2) d
std::vector<Vec3> Maximiser::apply(const std::vector<Vec3>& d, double p, double damping) const {
  std::vector<Vec3> out(d.size());
  const double along = dot(gradient_, d);
  for (std::size_t v = 0; v < d.size(); ++v)
    out[v] = damping / (length_[v] * length_[v]) * d[v] - p * along * gradient_[v];
  for (const ActiveCorner& c : corners_) {
    double slope = 0;
    for (std::size_t k = 0; k < 4; ++k) slope += c.gradient[k].dot(d[at(c.vertices[k])]);
    slope *= p * c.share;
    for (std::size_t k = 0; k < 4; ++k) out[at(c.vertices[k])] += slope * c.gradient[k];
  }
  return out;
}

std::vector<Vec3> Maximiser::solve(double p, double damping) const {
  std::vector<Vec3> d(gradient_.size(), Vec3::Zero());
  std::vector<Vec3> residual = gradient_;
  std::vector<Vec3> direction(d.size());
  double before = 0;
  double first = 0;
  for (int step = 0; step < most_cg_steps; ++step) {
    double now = 0;
    for (std::size_t v = 0; v < d.size(); ++v) now += residual[v].squaredNorm() * length_[v] * length_[v];
    if (step == 0) first = now;
    if (now <= 1e-8 * first || now == 0) break;
    for (std::size_t v = 0; v < d.size(); ++v)
      direction[v] =
          length_[v] * length_[v] * residual[v] + (step == 0 ? Vec3::Zero() : Vec3(now / before * direction[v]));
    const std::vector<Vec3> image = apply(direction, p, damping);
    const double curvature = dot(direction, image);
    if (!(curvature > 0)) break;
    const double t = now / curvature;
    for (std::size_t v = 0; v < d.size(); ++v) {
      d[v] += t * direction[v];
      residual[v] -= t * image[v];
    }
    before = now;
  }
  return d;
}

// One damped step; the gain of the smooth minimum.
double Maximiser::newton_step(double p, double& damping) {
  collect(p);
  const double value = smooth(mesh_.points, p);
  for (int attempt = 0; attempt < 8; ++attempt) {
    const std::vector<Vec3> d = solve(p, damping);
    std::vector<Vec3> moved = mesh_.points;
    for (std::size_t v = 0; v < d.size(); ++v) {
      const double size = d[v].norm() / length_[v];
      moved[v] += size > 0.3 ? Vec3(0.3 / size * d[v]) : d[v];
    }
    const double raised = smooth(moved, p);
    if (raised > value) {
      mesh_.points = std::move(moved);
      damping = std::max(damping / 4, 1e-6);
      return raised - value;
    }
    damping *= 6;
  }
  return 0;
}

}  // namespace

void maximise_minimum(HexMesh& hexes, const MaximiseOptions& options, const Control& control) {
  Maximiser(hexes, options, control).run();
}

}  // namespace hexfield
