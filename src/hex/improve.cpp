#include "hexfield/hex/improve.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "corner_energy.hpp"
#include "hex_topology.hpp"
#include "hexfield/base/parallel.hpp"
#include "hexfield/hex/check.hpp"
#include "vertex_places.hpp"

namespace hexfield {
namespace {

using hex::Corner;
using hex::EnergyShape;

constexpr std::size_t grain = 64;
constexpr int patience = 10;  // sweeps without gain that end the raising of the minimum

// Which corners of a hex have local vertex k, and as which of their four points.
struct CornerUse {
  int corner;
  int role;
};
std::array<std::array<CornerUse, 4>, 8> corner_uses() {
  std::array<std::array<CornerUse, 4>, 8> uses{};
  std::array<std::size_t, 8> count{};
  for (int corner = 0; corner < 8; ++corner)
    for (int role = 0; role < 4; ++role) {
      const auto k = static_cast<std::size_t>(hex::hex_corners[corner][role]);
      uses[k][count[k]++] = {corner, role};
    }
  return uses;
}

class Improver {
 public:
  Improver(HexMesh& hexes, hex::VertexPlaces places, const ImproveOptions& options, const Control& control)
      : hexes_(hexes), options_(options), control_(control), places_(std::move(places)), uses_(corner_uses()) {
    link_vertices();
    colour_vertices();
    quality_.resize(hexes.hexes.size());
    scale_.resize(hexes.hexes.size());
  }

  void run() {
    untangle();
    smooth();
    raise_minimum();
  }

 private:
  void link_vertices();
  void colour_vertices();
  void measure();
  void untangle();
  void smooth();
  void raise_minimum();
  void activate(double below, int rings);
  void sweep(const EnergyShape& shape);
  void move_vertex(std::size_t v, const EnergyShape& shape);
  std::vector<Corner> patch_of(std::size_t v) const;
  Vec3 newton_direction(std::size_t v, std::vector<Corner>& patch, const Vec3& gradient,
                        const EnergyShape& shape) const;
  double regularisation() const;
  double shortfall() const;
  void tell(const char* what, int round, int rounds) const {
    if (control_.progress) control_.progress(what, static_cast<double>(round) / rounds);
    if (control_.stop_requested && control_.stop_requested())
      throw Error(ExitCode::stopped, "Stopped while the hex mesh was being improved.");
  }
  const Vec3& at(int v) const { return hexes_.points[static_cast<std::size_t>(v)]; }

  HexMesh& hexes_;
  const ImproveOptions& options_;
  const Control& control_;
  hex::VertexPlaces places_;
  std::array<std::array<CornerUse, 4>, 8> uses_;
  std::vector<std::size_t> first_;                  ///< into slots_, per vertex
  std::vector<std::int64_t> slots_;                 ///< 8 * hex + local vertex
  std::vector<std::vector<std::int32_t>> classes_;  ///< vertices that can move at the same time
  std::vector<double> quality_;
  std::vector<double> scale_;
  std::vector<char> active_;
  double minimum_ = 1;
};

void Improver::link_vertices() {
  const std::size_t n = hexes_.points.size();
  first_.assign(n + 1, 0);
  for (const auto& hex : hexes_.hexes)
    for (int v : hex) ++first_[static_cast<std::size_t>(v) + 1];
  for (std::size_t v = 0; v < n; ++v) first_[v + 1] += first_[v];
  slots_.resize(8 * hexes_.hexes.size());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t h = 0; h < hexes_.hexes.size(); ++h)
    for (std::size_t k = 0; k < 8; ++k)
      slots_[next[static_cast<std::size_t>(hexes_.hexes[h][k])]++] = static_cast<std::int64_t>(8 * h + k);
}

void Improver::colour_vertices() {
  const std::size_t n = hexes_.points.size();
  std::vector<int> colour(n, -1);
  std::vector<std::size_t> taken_by;  // per colour: the last vertex that has a neighbour of it
  for (std::size_t v = 0; v < n; ++v) {
    if (places_.kind(v) == hex::VertexPlaces::Kind::fixed || first_[v] == first_[v + 1]) continue;
    for (std::size_t s = first_[v]; s < first_[v + 1]; ++s)
      for (int w : hexes_.hexes[static_cast<std::size_t>(slots_[s] / 8)])
        if (colour[static_cast<std::size_t>(w)] >= 0)
          taken_by[static_cast<std::size_t>(colour[static_cast<std::size_t>(w)])] = v;
    std::size_t c = 0;
    while (c < taken_by.size() && taken_by[c] == v) ++c;
    if (c == taken_by.size()) {
      taken_by.push_back(static_cast<std::size_t>(-1));
      classes_.emplace_back();
    }
    colour[v] = static_cast<int>(c);
    classes_[c].push_back(static_cast<std::int32_t>(v));
  }
}

void Improver::measure() {
  parallel_for(hexes_.hexes.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t h = begin; h < end; ++h) {
      quality_[h] = scaled_jacobian(hexes_, h);
      double sum = 0;
      for (const auto& e : hex::hex_edges)
        sum +=
            (at(hexes_.hexes[h][static_cast<std::size_t>(e[0])]) - at(hexes_.hexes[h][static_cast<std::size_t>(e[1])]))
                .norm();
      scale_[h] = std::max(sum / 12, 1e-300);
    }
  });
  minimum_ = quality_.empty() ? 1 : *std::min_element(quality_.begin(), quality_.end());
}

// Marks the vertices of hexes below the quality, and `rings` layers around them.
void Improver::activate(double below, int rings) {
  active_.assign(hexes_.points.size(), 0);
  std::vector<char> chosen(hexes_.hexes.size(), 0);
  for (std::size_t h = 0; h < quality_.size(); ++h) chosen[h] = quality_[h] < below;
  for (int ring = 0; ring <= rings; ++ring) {
    for (std::size_t h = 0; h < chosen.size(); ++h)
      if (chosen[h] != 0)
        for (int v : hexes_.hexes[h]) active_[static_cast<std::size_t>(v)] = 1;
    for (std::size_t v = 0; v < active_.size(); ++v)
      if (active_[v] != 0)
        for (std::size_t s = first_[v]; s < first_[v + 1]; ++s) chosen[static_cast<std::size_t>(slots_[s] / 8)] = 1;
  }
}

std::vector<Corner> Improver::patch_of(std::size_t v) const {
  std::vector<Corner> patch;
  patch.reserve(4 * (first_[v + 1] - first_[v]));
  for (std::size_t s = first_[v]; s < first_[v + 1]; ++s) {
    const auto h = static_cast<std::size_t>(slots_[s] / 8);
    for (const CornerUse& use : uses_[static_cast<std::size_t>(slots_[s] % 8)]) {
      Corner corner;
      for (std::size_t k = 0; k < 4; ++k)
        corner.points[k] = at(hexes_.hexes[h][static_cast<std::size_t>(hex::hex_corners[use.corner][k])]);
      corner.scale = scale_[h];
      corner.role = use.role;
      corner.keep = quality_[h] > 0;
      patch.push_back(corner);
    }
  }
  return patch;
}

// Newton direction in the tangent space, with the Hessian made positive; the Hessian by differences of gradients.
Vec3 Improver::newton_direction(std::size_t v, std::vector<Corner>& patch, const Vec3& gradient,
                                const EnergyShape& shape) const {
  const Vec3 x = hexes_.points[v];
  const double step = 1e-6 * patch.front().scale;
  Mat3 hessian;
  for (Eigen::Index a = 0; a < 3; ++a) {
    Vec3 moved;
    Vec3 y = x;
    y[a] += step;
    patch_energy(patch, y, shape, &moved);
    hessian.col(a) = (moved - gradient) / step;
  }
  const Mat3 tangent = places_.tangent(v, x);
  const Mat3 inside = tangent * ((hessian + hessian.transpose()) / 2) * tangent;
  if (!inside.allFinite()) return -tangent * gradient;
  Eigen::SelfAdjointEigenSolver<Mat3> eigen;
  eigen.computeDirect(inside);
  const double largest = eigen.eigenvalues().cwiseAbs().maxCoeff();
  const Vec3 g = eigen.eigenvectors().transpose() * (tangent * gradient);
  Vec3 d = Vec3::Zero();
  for (Eigen::Index k = 0; k < 3; ++k)
    d[k] = -g[k] / std::max(std::abs(eigen.eigenvalues()[k]), 1e-4 * largest + 1e-300);
  return tangent * (eigen.eigenvectors() * d);
}

void Improver::move_vertex(std::size_t v, const EnergyShape& shape) {
  std::vector<Corner> patch = patch_of(v);
  const Vec3 x = hexes_.points[v];
  Vec3 gradient;
  const double energy = patch_energy(patch, x, shape, &gradient);
  if (!gradient.allFinite() || gradient.norm() * patch.front().scale <= 1e-5 * energy) return;
  Vec3 direction = newton_direction(v, patch, gradient, shape);
  const double longest = 0.5 * patch.front().scale;
  const double length = direction.norm();
  if (!(length > 1e-9 * patch.front().scale)) return;
  if (length > longest) direction *= longest / length;
  // Sides may not cut deeper through a curved shape than they do, unless that is what untangling takes.
  const bool guarded = minimum_ > 0 && places_.kind(v) != hex::VertexPlaces::Kind::free;
  const double bound = guarded ? std::max(places_.chord_error(v, x, hexes_.points), places_.small_chord_error()) : -1;
  for (double t = 1; t > 0.01; t *= 0.4) {
    const Vec3 y = places_.project(v, x + t * direction);
    const double lower = patch_energy(patch, y, shape, nullptr);
    if (!(lower < energy)) continue;
    const bool kept = std::all_of(patch.begin(), patch.end(),
                                  [](const Corner& c) { return !c.keep || hex::scaled_jacobian(c) > 1e-9; });
    if (!kept || (bound >= 0 && places_.chord_error(v, y, hexes_.points) > bound)) continue;
    hexes_.points[v] = y;
    return;
  }
}

void Improver::sweep(const EnergyShape& shape) {
  for (const auto& members : classes_)
    parallel_for(members.size(), grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const auto v = static_cast<std::size_t>(members[k]);
        if (active_[v] != 0) move_vertex(v, shape);
      }
    });
  measure();
}

// The epsilon that makes the worst determinant count, but not dominate.
double Improver::regularisation() const {
  double worst = 0;
  for (std::size_t h = 0; h < hexes_.hexes.size(); ++h) {
    if (quality_[h] > 0) continue;
    for (const auto& corner : hex::hex_corners) {
      const auto p = [&](int k) -> const Vec3& { return at(hexes_.hexes[h][static_cast<std::size_t>(corner[k])]); };
      const double det = (p(1) - p(0)).cross(p(2) - p(0)).dot(p(3) - p(0)) / (scale_[h] * scale_[h] * scale_[h]);
      worst = std::min(worst, det);
    }
  }
  return std::sqrt(1e-6 + 0.04 * worst * worst);
}

void Improver::untangle() {
  measure();
  for (int round = 0; round < options_.max_untangle_rounds && !(minimum_ > 0); ++round) {
    activate(1e-3, 2 + round / 20);
    sweep({1, 1, regularisation()});
    tell("untangling hexes", round, options_.max_untangle_rounds);
  }
}

void Improver::smooth() {
  if (!(minimum_ > 0)) return;
  active_.assign(hexes_.points.size(), 1);
  for (int round = 0; round < options_.smoothing_rounds; ++round) {
    sweep({2, options_.shape_weight, 0});
    tell("smoothing the hex mesh", round, options_.smoothing_rounds);
  }
}

// How much the hexes below the aim miss it, the worse the more.
double Improver::shortfall() const {
  double sum = 0;
  for (double q : quality_) sum += q < options_.good_enough ? std::pow(options_.good_enough - q, 2) : 0;
  return sum;
}

void Improver::raise_minimum() {
  if (!(minimum_ > 0)) return;
  std::vector<Vec3> best = hexes_.points;
  double best_minimum = minimum_;
  double best_shortfall = shortfall();
  int since_best = 0;
  for (int round = 0; round < options_.max_rounds && minimum_ < options_.good_enough; ++round) {
    activate(options_.good_enough, 1);
    sweep({4 + 12.0 * round / options_.max_rounds, options_.shape_weight, 0});
    // A corner of the input can hold the minimum down; then the others below the aim decide.
    const double lower = shortfall();
    const bool better =
        minimum_ > best_minimum + 1e-4 || (minimum_ > best_minimum - 1e-6 && lower < 0.999 * best_shortfall);
    since_best = better ? 0 : since_best + 1;
    if (better) {
      best_minimum = minimum_;
      best_shortfall = lower;
      best = hexes_.points;
    }
    tell("raising the scaled Jacobian", round, options_.max_rounds);
    if (since_best >= patience) break;
  }
  hexes_.points = std::move(best);
}

MaximiseOptions last_steps(const ImproveOptions& options) {
  MaximiseOptions out;
  out.first_sharpness = options.maximise_sharpness;
  out.last_sharpness = std::max(1024.0, options.maximise_sharpness);
  out.steps = options.maximise_steps;
  out.gain = options.maximise_gain;
  return out;
}

}  // namespace

void improve_hex_mesh(HexMesh& hexes, const TetMesh& mesh, const Features& features, const ImproveOptions& options,
                      const Control& control) {
  Improver(hexes, hex::VertexPlaces(hexes, mesh, features), options, control).run();
  if (options.maximise_steps == 0 || !(quality(hexes).min < options.maximise_below)) return;
  maximise_minimum(hexes, mesh, features, last_steps(options), control);
}

void improve_free_hex_mesh(HexMesh& hexes, const ImproveOptions& options, const Control& control) {
  Improver(hexes, hex::VertexPlaces(hexes.points.size()), options, control).run();
  if (options.maximise_steps == 0 || !(quality(hexes).min < options.maximise_below)) return;
  maximise_minimum(hexes, last_steps(options), control);
}

}  // namespace hexfield
