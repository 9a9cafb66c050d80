#include <algorithm>
#include <cmath>

#include "hex_topology.hpp"
#include "hexfield/base/parallel.hpp"
#include "hexfield/hex/check.hpp"
#include "hexfield/hex/improve.hpp"
#include "vertex_places.hpp"

namespace hexfield {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

constexpr double negligible = 1e-7;  // share of a corner in the smooth minimum
constexpr int most_cg_steps = 80;
constexpr double too_blunt = 0.25;  // below the minimum: the smooth one speaks of the many good corners
// Scaled Jacobians do not feel the lengths of edges: without more, some collapse. Edges shorter than this share of
// those around count like corners.
constexpr double short_edge = 0.2;

/// A corner, or an edge by its two ends, that counts: its share, its vertices as numbers of the active ones and the
/// derivative of its scaled Jacobian by each, along the directions in which that vertex can go.
struct ActiveCorner {
  double share;
  std::array<int, 4> vertices;
  std::array<Vec3, 4> gradient;
};

class Maximiser {
 public:
  Maximiser(HexMesh& mesh, hex::VertexPlaces places, const MaximiseOptions& options, const Control& control)
      : mesh_(mesh),
        places_(std::move(places)),
        options_(options),
        control_(control),
        held_(mesh.points.size(), 0),
        number_(mesh.points.size(), -1),
        mean_edge_(mesh.points.size()) {
    if (!options.free_boundary) hold();
    measure_lengths();
  }

  void run() {
    std::vector<Vec3> best = mesh_.points;
    double best_minimum = minimum(mesh_.points);
    if (!(best_minimum > 0)) return;
    double first = options_.first_sharpness;
    while (first < options_.last_sharpness && best_minimum - smooth(mesh_.points, first) > too_blunt) first *= 2;
    for (double p = first; p <= options_.last_sharpness; p *= 2) {
      double damping = 1;
      for (int step = 0; step < options_.steps; ++step) {
        if (control_.progress) control_.progress("raising the smallest scaled Jacobian", -1);
        if (control_.stop_requested && control_.stop_requested()) {
          mesh_.points = std::move(best);
          throw Error(ExitCode::stopped, "Stopped while the scaled Jacobian was being raised.");
        }
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
  double edge_value(std::size_t e, const std::vector<Vec3>& points) const {
    return (points[at(edges_[e][0])] - points[at(edges_[e][1])]).norm() / shortest_[e];
  }
  double minimum(const std::vector<Vec3>& points) const { return smooth(points, -1); }
  double smooth(const std::vector<Vec3>& points, double p) const;
  void collect(double p);
  void activate(const std::vector<std::array<int, 4>>& corners);
  std::vector<Vec3> apply(const std::vector<Vec3>& d, double p, double damping) const;
  std::vector<Vec3> solve(double p, double damping) const;
  bool moved_points(const std::vector<Vec3>& d, std::vector<Vec3>& moved) const;
  double newton_step(double p, double& damping);
  static double dot(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double sum = 0;
    for (std::size_t v = 0; v < a.size(); ++v) sum += a[v].dot(b[v]);
    return sum;
  }

  HexMesh& mesh_;
  hex::VertexPlaces places_;
  const MaximiseOptions& options_;
  const Control& control_;
  std::vector<std::array<int, 2>> edges_;
  std::vector<double> shortest_;   ///< per edge: the length that counts as a scaled Jacobian of 1
  std::vector<char> held_;         ///< per vertex
  std::vector<int> number_;        ///< per vertex: among the active ones, -1
  std::vector<double> mean_edge_;  ///< per vertex
  std::vector<int> active_;        ///< vertices of the corners that count, ascending
  std::vector<Mat3> tangents_;     ///< projectors on where the active vertices can go
  std::vector<double> length_;     ///< per active vertex
  std::vector<ActiveCorner> corners_;
  std::vector<Vec3> gradient_;  ///< of the smooth minimum by the active vertices, upwards
};

void Maximiser::hold() {
  const auto sides = hex::sorted_sides(mesh_);
  for (std::int64_t side : hex::boundary_sides(sides))
    for (int v : hex::side_vertices(mesh_, side)) held_[at(v)] = 1;
  for (const auto& quad : mesh_.feature_quads)
    for (int v : quad.vertices) held_[at(v)] = 1;
  for (const auto& line : mesh_.feature_lines)
    for (int v : line.vertices) held_[at(v)] = 1;
  for (const auto& point : mesh_.feature_points) held_[at(point.vertex)] = 1;
}

void Maximiser::measure_lengths() {
  std::vector<double> count(mesh_.points.size(), 0);
  std::fill(mean_edge_.begin(), mean_edge_.end(), 0);
  for (const auto& hex : mesh_.hexes)
    for (const auto& e : hex::hex_edges) {
      const double l = (mesh_.points[at(hex[at(e[0])])] - mesh_.points[at(hex[at(e[1])])]).norm();
      for (int k : e) {
        mean_edge_[at(hex[at(k)])] += l;
        count[at(hex[at(k)])] += 1;
      }
    }
  for (std::size_t v = 0; v < mean_edge_.size(); ++v) mean_edge_[v] = count[v] > 0 ? mean_edge_[v] / count[v] : 1;
  edges_ = hex::sorted_edges(mesh_);
  shortest_.resize(edges_.size());
  for (std::size_t e = 0; e < edges_.size(); ++e)
    shortest_[e] = short_edge * (mean_edge_[at(edges_[e][0])] + mean_edge_[at(edges_[e][1])]) / 2;
}

// -(1/p) log sum exp(-p SJ) over corners and edges; for negative p the smallest SJ itself.
double Maximiser::smooth(const std::vector<Vec3>& points, double p) const {
  std::vector<double> values(8 * mesh_.hexes.size());
  parallel_for(mesh_.hexes.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t h = begin; h < end; ++h)
      for (std::size_t c = 0; c < 8; ++c) {
        const auto& hex = mesh_.hexes[h];
        const auto& corner = hex::hex_corners[c];
        const Vec3& x = points[at(hex[at(corner[0])])];
        const Vec3 u = points[at(hex[at(corner[1])])] - x;
        const Vec3 v = points[at(hex[at(corner[2])])] - x;
        const Vec3 w = points[at(hex[at(corner[3])])] - x;
        values[8 * h + c] = u.cross(v).dot(w) / std::max(u.norm() * v.norm() * w.norm(), 1e-300);
      }
  });
  if (p < 0) return std::min(1.0, *std::min_element(values.begin(), values.end()));
  for (std::size_t e = 0; e < edges_.size(); ++e) values.push_back(edge_value(e, points));
  const double least = std::min(1.0, *std::min_element(values.begin(), values.end()));
  double sum = 0;
  for (double s : values)
    if (p * (s - least) < 40) sum += std::exp(-p * (s - least));
  return least - std::log(sum) / p;
}

// Numbers the movable vertices of the corners.
void Maximiser::activate(const std::vector<std::array<int, 4>>& corners) {
  for (int v : active_) number_[at(v)] = -1;
  active_.clear();
  for (const auto& corner : corners)
    for (int v : corner)
      if (number_[at(v)] < 0 && held_[at(v)] == 0 && places_.kind(at(v)) != hex::VertexPlaces::Kind::fixed) {
        number_[at(v)] = 0;
        active_.push_back(v);
      }
  std::sort(active_.begin(), active_.end());
  tangents_.resize(active_.size());
  length_.resize(active_.size());
  for (std::size_t k = 0; k < active_.size(); ++k) {
    number_[at(active_[k])] = static_cast<int>(k);
    length_[k] = mean_edge_[at(active_[k])];
  }
  parallel_for(active_.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      tangents_[k] = places_.tangent(at(active_[k]), mesh_.points[at(active_[k])]);
  });
}

void Maximiser::collect(double p) {
  const double value = smooth(mesh_.points, p);
  std::vector<std::array<int, 4>> members;
  corners_.clear();
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
      members.push_back(c.vertices);
      corners_.push_back(c);
    }
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const double g = edge_value(e, mesh_.points);
    ActiveCorner c{};
    c.share = std::exp(-p * (g - value));
    if (c.share < negligible || g <= 0) continue;
    const auto [a, b] = edges_[e];
    c.vertices = {a, b, -1, -1};
    c.gradient[1] = (mesh_.points[at(b)] - mesh_.points[at(a)]) / (g * shortest_[e] * shortest_[e]);
    c.gradient[0] = -c.gradient[1];
    members.push_back({a, b, a, b});
    corners_.push_back(c);
  }
  activate(members);
  gradient_.assign(active_.size(), Vec3::Zero());
  for (ActiveCorner& c : corners_)
    for (std::size_t k = 0; k < 4; ++k) {
      if (c.vertices[k] >= 0) c.vertices[k] = number_[at(c.vertices[k])];
      if (c.vertices[k] < 0) continue;
      c.gradient[k] = tangents_[at(c.vertices[k])] * c.gradient[k];
      gradient_[at(c.vertices[k])] += c.share * c.gradient[k];
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
    for (std::size_t k = 0; k < 4; ++k)
      if (c.vertices[k] >= 0) slope += c.gradient[k].dot(d[at(c.vertices[k])]);
    slope *= p * c.share;
    for (std::size_t k = 0; k < 4; ++k)
      if (c.vertices[k] >= 0) out[at(c.vertices[k])] += slope * c.gradient[k];
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

// The points after a step: at most 0.3 of an edge, projected on the surfaces. Sides may not cut deeper through a curved
// shape than they do: vertices that would stay; false when that does not help.
bool Maximiser::moved_points(const std::vector<Vec3>& d, std::vector<Vec3>& moved) const {
  moved = mesh_.points;
  std::vector<char> bounded(active_.size(), 0);
  parallel_for(active_.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t v = at(active_[k]);
      const double size = d[k].norm() / length_[k];
      moved[v] = places_.project(v, moved[v] + (size > 0.3 ? Vec3(0.3 / size * d[k]) : d[k]));
      bounded[k] = places_.kind(v) != hex::VertexPlaces::Kind::free ? 1 : 0;
    }
  });
  for (int pass = 0; pass < 4; ++pass) {
    std::vector<char> cuts(active_.size(), 0);
    parallel_for(active_.size(), 64, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const std::size_t v = at(active_[k]);
        if (bounded[k] == 0) continue;
        const double error = places_.chord_error(v, moved[v], moved);
        cuts[k] = error > places_.small_chord_error() &&
                  error > (1 + 1e-6) * places_.chord_error(v, mesh_.points[v], mesh_.points);
      }
    });
    if (std::find(cuts.begin(), cuts.end(), 1) == cuts.end()) return true;
    for (std::size_t k = 0; k < cuts.size(); ++k)
      if (cuts[k] != 0) moved[at(active_[k])] = mesh_.points[at(active_[k])];
  }
  return false;
}

// One damped step; the gain of the smooth minimum.
double Maximiser::newton_step(double p, double& damping) {
  collect(p);
  const double value = smooth(mesh_.points, p);
  for (int attempt = 0; attempt < 8; ++attempt) {
    std::vector<Vec3> moved;
    if (moved_points(solve(p, damping), moved)) {
      const double raised = smooth(moved, p);
      if (raised > value) {
        mesh_.points = std::move(moved);
        damping = std::max(damping / 4, 1e-6);
        return raised - value;
      }
    }
    damping *= 6;
  }
  return 0;
}

}  // namespace

void maximise_minimum(HexMesh& hexes, const MaximiseOptions& options, const Control& control) {
  Maximiser(hexes, hex::VertexPlaces(hexes.points.size()), options, control).run();
}

void maximise_minimum(HexMesh& hexes, const TetMesh& mesh, const Features& features, const MaximiseOptions& options,
                      const Control& control) {
  Maximiser(hexes, hex::VertexPlaces(hexes, mesh, features), options, control).run();
}

}  // namespace hexfield
