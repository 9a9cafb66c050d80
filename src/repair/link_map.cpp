#include "link_map.hpp"

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "hexfield/solve/untangling.hpp"

namespace hexfield {

using solve::Mat9;
using solve::Vec9;

namespace {

constexpr std::size_t next(std::size_t k) { return (k + 1) % 3; }

// Dihedral angle at the first vector of the tet of the origin and three vectors with det > 0.
double dihedral_at(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 m = a.cross(b), n = a.cross(c);
  return std::atan2(a.dot(m.cross(n)) / a.norm(), m.dot(n));
}

// Corners of unit length whose triangles have 1 / n of the area of the link: what every tet is compared with.
Mat3 reference_inverse(const Link& link) {
  const double n = static_cast<double>(link.triangles.size());
  const double angle = std::min(M_PI / 3 + link.octants() * M_PI / (6 * n), 0.62 * M_PI);
  const double cosine = std::cos(angle) / (1 - std::cos(angle));
  Mat3 gram = Mat3::Constant(cosine);
  gram.diagonal().setOnes();
  const Mat3 upper = gram.llt().matrixU();
  return upper.inverse();
}

// Newton's method for drawings of one link.
class Untangler {
 public:
  Untangler(const Link& link, const VertexMapOptions& options)
      : link_(link), options_(options), inverse_(reference_inverse(link)) {
    first_.reserve(link.vertices.size());
    for (const LinkVertex& v : link.vertices) {
      std::array<int, 3> dofs{-1, -1, -1};
      for (std::size_t i = 0; i < 3; ++i)
        if (v.free[i]) dofs[i] = size_++;
      first_.push_back(dofs);
    }
    for (const LinkTriangle& t : link.triangles) entries_.push_back(entries_of(t));
    gradient_.resize(size_);
    lay_out_hessian();
  }

  // Untangles; true when a drawing was reached.
  bool run(std::vector<Vec3>& images) {
    Eigen::VectorXd y = pack(images);
    double before = 0;
    int slow = 0;
    for (int k = 0; k < options_.max_iterations; ++k) {
      const double smallest = smallest_det(y);
      const double epsilon = smallest > 0 ? 1e-6 : std::sqrt(1e-8 + 0.04 * smallest * smallest);
      const double energy = derivatives(y, epsilon);
      if (!step(y, epsilon, energy)) return false;
      images = unpack(y);
      if (is_drawing(link_, images, options_.smallest_det)) return true;
      if (smallest > options_.smallest_det) return false;  // positive, wound wrongly: no step back unwinds it
      slow = std::abs(before - energy) < 1e-3 * energy ? slow + 1 : 0;
      if (slow == 5) return false;
      before = energy;
    }
    return false;
  }

 private:
  // Unknown and sign of each coordinate of each corner (3 corner + coordinate); -1: it is 0.
  struct Entry {
    int dof = -1;
    double sign = 1;
  };
  using Entries = std::array<Entry, 9>;
  using Slots = std::array<int, 81>;  // per pair of entries: place in the values of the Hessian, -1 above its diagonal

  Entries entries_of(const LinkTriangle& t) const {
    Entries entries;
    for (std::size_t k = 0; k < 3; ++k) {
      const Mat3& r = octahedral::matrix(t.to_tet[k]);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          if (r(i, j) != 0)
            entries[3 * k + static_cast<std::size_t>(i)] = {
                first_[static_cast<std::size_t>(t.vertex[k])][static_cast<std::size_t>(j)], r(i, j)};
    }
    return entries;
  }

  // Lower triangle of the Hessian with one place per pair of unknowns that share a triangle.
  void lay_out_hessian() {
    std::vector<Eigen::Triplet<double>> triplets;
    for (int i = 0; i < size_; ++i) triplets.emplace_back(i, i, 0.0);
    for_pairs([&](std::size_t, std::size_t, int row, int column) { triplets.emplace_back(row, column, 0.0); });
    hessian_.resize(size_, size_);
    hessian_.setFromTriplets(triplets.begin(), triplets.end());
    slots_.resize(entries_.size());
    for (Slots& s : slots_) s.fill(-1);
    for_pairs([&](std::size_t t, std::size_t pair, int row, int column) {
      const int* first = hessian_.innerIndexPtr() + hessian_.outerIndexPtr()[column];
      const int* last = hessian_.innerIndexPtr() + hessian_.outerIndexPtr()[column + 1];
      slots_[t][pair] = static_cast<int>(std::lower_bound(first, last, row) - hessian_.innerIndexPtr());
    });
    solver_.analyzePattern(hessian_);
  }

  template <class Visit>
  void for_pairs(const Visit& visit) const {
    for (std::size_t t = 0; t < entries_.size(); ++t)
      for (std::size_t a = 0; a < 9; ++a)
        for (std::size_t b = 0; b < 9; ++b) {
          const int row = entries_[t][a].dof, column = entries_[t][b].dof;
          if (row >= column && column >= 0) visit(t, 9 * a + b, row, column);
        }
  }

  Eigen::VectorXd pack(const std::vector<Vec3>& images) const {
    Eigen::VectorXd y(size_);
    for (std::size_t v = 0; v < images.size(); ++v)
      for (std::size_t i = 0; i < 3; ++i)
        if (first_[v][i] >= 0) y[first_[v][i]] = images[v][static_cast<Eigen::Index>(i)];
    return y;
  }

  std::vector<Vec3> unpack(const Eigen::VectorXd& y) const {
    std::vector<Vec3> images(link_.vertices.size(), Vec3::Zero());
    for (std::size_t v = 0; v < images.size(); ++v)
      for (std::size_t i = 0; i < 3; ++i)
        if (first_[v][i] >= 0) images[v][static_cast<Eigen::Index>(i)] = y[first_[v][i]];
    return images;
  }

  Mat3 jacobian(std::size_t t, const Eigen::VectorXd& y) const {
    Mat3 corners;
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i) {
        const Entry& e = entries_[t][static_cast<std::size_t>(3 * k + i)];
        corners(i, k) = e.dof < 0 ? 0.0 : e.sign * y[e.dof];
      }
    return corners * inverse_;
  }

  double smallest_det(const Eigen::VectorXd& y) const {
    double smallest = 1e300;
    for (std::size_t t = 0; t < entries_.size(); ++t) smallest = std::min(smallest, jacobian(t, y).determinant());
    return smallest;
  }

  double energy(const Eigen::VectorXd& y, double epsilon) const {
    double sum = 0;
    for (std::size_t t = 0; t < entries_.size(); ++t) sum += solve::untangle_energy(jacobian(t, y), epsilon);
    return sum;
  }

  double derivatives(const Eigen::VectorXd& y, double epsilon) {
    gradient_.setZero();
    std::fill_n(hessian_.valuePtr(), hessian_.nonZeros(), 0.0);
    double sum = 0;
    Vec9 g;
    Mat9 h;
    for (std::size_t t = 0; t < entries_.size(); ++t) {
      sum += solve::untangle_energy(jacobian(t, y), epsilon, g, h);
      add(t, g, h);
    }
    return sum;
  }

  // J = Y P with P the inverse of the reference: rows of J are rows of Y times P.
  void add(std::size_t t, const Vec9& g, const Mat9& h) {
    const Entries& entries = entries_[t];
    for (int i = 0; i < 3; ++i) {
      const Vec3 along = inverse_ * g.segment<3>(3 * i);
      for (int k = 0; k < 3; ++k)
        if (const Entry& e = entries[static_cast<std::size_t>(3 * k + i)]; e.dof >= 0)
          gradient_[e.dof] += e.sign * along[k];
      for (int j = 0; j < 3; ++j) {
        const Mat3 block = inverse_ * h.block<3, 3>(3 * i, 3 * j) * inverse_.transpose();
        for (int k = 0; k < 3; ++k)
          for (int l = 0; l < 3; ++l) {
            const auto a = static_cast<std::size_t>(3 * k + i), b = static_cast<std::size_t>(3 * l + j);
            if (const int slot = slots_[t][9 * a + b]; slot >= 0)
              hessian_.valuePtr()[slot] += entries[a].sign * entries[b].sign * block(k, l);
          }
      }
    }
  }

  // One Newton step with a backtracking line search.
  bool step(Eigen::VectorXd& y, double epsilon, double energy_now) {
    solver_.setShift(1e-9 * hessian_.diagonal().maxCoeff());
    solver_.factorize(hessian_);
    if (solver_.info() != Eigen::Success) return false;
    const Eigen::VectorXd direction = -solver_.solve(gradient_);
    const double slope = gradient_.dot(direction);
    if (!(slope < 0)) return false;
    for (double length = 1; length > 1e-6; length /= 2) {
      const Eigen::VectorXd trial = y + length * direction;
      if (energy(trial, epsilon) <= energy_now + 1e-4 * length * slope) {
        y = trial;
        return true;
      }
    }
    return false;
  }

  const Link& link_;
  const VertexMapOptions& options_;
  Mat3 inverse_;
  int size_ = 0;
  std::vector<std::array<int, 3>> first_;  // per link vertex and coordinate: unknown or -1
  std::vector<Entries> entries_;           // per triangle
  std::vector<Slots> slots_;               // per triangle
  Eigen::VectorXd gradient_;
  Eigen::SparseMatrix<double> hessian_;  // lower triangle
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower> solver_;
};

}  // namespace

int Link::octants() const {
  int quads = 0;
  for (const LinkSector& s : sectors) quads += s.quads;
  return quads - 2 * static_cast<int>(triangles.size());
}

Vec3 image_of(const Link& link, std::size_t t, std::size_t k, const std::vector<Vec3>& images) {
  const LinkTriangle& triangle = link.triangles[t];
  return octahedral::apply(triangle.to_tet[k], images[static_cast<std::size_t>(triangle.vertex[k])]);
}

std::vector<Vec3> starts(const Link& link) {
  std::vector<Vec3> images;
  for (const LinkVertex& v : link.vertices) images.push_back(v.start);
  return images;
}

bool is_drawing(const Link& link, const std::vector<Vec3>& images, double smallest_det) {
  std::vector<double> angles(3 * link.triangles.size());
  for (std::size_t t = 0; t < link.triangles.size(); ++t) {
    std::array<Vec3, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = image_of(link, t, k, images).normalized();
    if (!(p[0].dot(p[1].cross(p[2])) > smallest_det)) return false;
    for (std::size_t k = 0; k < 3; ++k) angles[3 * t + k] = dihedral_at(p[k], p[next(k)], p[next(next(k))]);
  }
  return std::all_of(link.sectors.begin(), link.sectors.end(), [&](const LinkSector& s) {
    double sum = 0;
    for (int c : s.corners) sum += angles[static_cast<std::size_t>(c)];
    return std::abs(sum - s.quads * M_PI / 2) < 1e-4;
  });
}

bool admits_area(const Link& link) {
  if (link.octants() <= 0) return false;
  std::vector<int> cones;
  for (const LinkSector& s : link.sectors)
    if (s.quads != 4) cones.push_back(s.quads);
  const bool closed = std::all_of(link.triangles.begin(), link.triangles.end(), [](const LinkTriangle& t) {
    return std::all_of(t.normal.begin(), t.normal.end(), [](octahedral::Label l) { return l == octahedral::no_label; });
  });
  if (!closed || cones.size() > 2 || cones.empty()) return true;
  const bool whole_turns = std::all_of(cones.begin(), cones.end(), [](int quads) { return quads % 4 == 0; });
  return whole_turns || (cones.size() == 2 && cones[0] == cones[1]);
}

bool is_cramped(const Link& link) {
  const bool narrow = std::any_of(link.sectors.begin(), link.sectors.end(), [](const LinkSector& s) {
    return s.quads >= 2 * static_cast<int>(s.corners.size());
  });
  auto constrained = [&](const LinkTriangle& t, std::size_t k) {
    return link.vertices[static_cast<std::size_t>(t.vertex[k])].free_count() < 3;
  };
  return narrow || std::any_of(link.triangles.begin(), link.triangles.end(), [&](const LinkTriangle& t) {
           for (std::size_t k = 0; k < 3; ++k)
             if (t.normal[k] == octahedral::no_label && constrained(t, k) && constrained(t, next(k))) return true;
           return false;
         });
}

std::vector<Vec3> find_drawing(const std::vector<Link>& guesses, const VertexMapOptions& options) {
  for (const Link& link : guesses)
    if (std::vector<Vec3> images = starts(link); is_drawing(link, images, options.smallest_det)) return images;
  Untangler untangler(guesses[0], options);
  for (const Link& link : guesses)
    if (std::vector<Vec3> images = starts(link); untangler.run(images)) return images;
  return {};
}

}  // namespace hexfield
