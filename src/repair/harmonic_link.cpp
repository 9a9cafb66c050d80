#include <Eigen/SparseCholesky>

#include "link_map.hpp"

namespace hexfield {
namespace {

constexpr std::size_t next(std::size_t k) { return (k + 1) % 3; }

bool is_placed(const LinkVertex& v) { return v.free_count() == 1 && !v.start.isZero(); }

// One coordinate of a corner in the chart of its triangle: sign times an unknown, or a known value.
struct Coordinate {
  int unknown = -1;
  double sign = 0;
  double known = 0;
};

class HarmonicLink {
 public:
  explicit HarmonicLink(Link& link) : link_(link) {
    for (const LinkVertex& v : link.vertices) {
      std::array<int, 3> unknowns{-1, -1, -1};
      for (std::size_t i = 0; i < 3 && !is_placed(v); ++i)
        if (v.free[i]) unknowns[i] = size_++;
      unknowns_.push_back(unknowns);
    }
  }

  bool solve() {
    right_ = Eigen::VectorXd::Zero(size_);
    for (const LinkTriangle& t : link_.triangles)
      for (std::size_t k = 0; k < 3; ++k)
        for (int i = 0; i < 3; ++i) add(coordinate(t, k, i), coordinate(t, next(k), i));
    Eigen::SparseMatrix<double> matrix(size_, size_);
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor(matrix);
    if (factor.info() != Eigen::Success) return false;
    const Eigen::VectorXd solution = factor.solve(right_);
    for (std::size_t v = 0; v < unknowns_.size(); ++v) place(link_.vertices[v], unknowns_[v], solution);
    return true;
  }

 private:
  Coordinate coordinate(const LinkTriangle& t, std::size_t k, int i) const {
    const auto v = static_cast<std::size_t>(t.vertex[k]);
    const Mat3& r = octahedral::matrix(t.to_tet[k]);
    for (int j = 0; j < 3; ++j)
      if (r(i, j) != 0) {
        const int unknown = unknowns_[v][static_cast<std::size_t>(j)];
        const double known = is_placed(link_.vertices[v]) ? r(i, j) * link_.vertices[v].start[j] : 0;
        return {unknown, r(i, j), known};
      }
    return {};
  }

  // (a - b)^2 / 2
  void add(const Coordinate& a, const Coordinate& b) {
    auto side = [&](const Coordinate& x, const Coordinate& y) {
      if (x.unknown < 0) return;
      entries_.emplace_back(x.unknown, x.unknown, 1.0);
      if (y.unknown < 0)
        right_[x.unknown] += x.sign * y.known;
      else
        entries_.emplace_back(x.unknown, y.unknown, -x.sign * y.sign);
    };
    side(a, b);
    side(b, a);
  }

  static void place(LinkVertex& vertex, const std::array<int, 3>& unknowns, const Eigen::VectorXd& solution) {
    if (is_placed(vertex)) return;
    Vec3 image = Vec3::Zero();
    for (std::size_t i = 0; i < 3; ++i)
      if (unknowns[i] >= 0) image[static_cast<Eigen::Index>(i)] = solution[unknowns[i]];
    if (const double length = image.norm(); length > 1e-9) vertex.start = image / length;
  }

  Link& link_;
  int size_ = 0;
  std::vector<std::array<int, 3>> unknowns_;  // per link vertex and coordinate: -1 when it is known
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::VectorXd right_;
};

}  // namespace

bool place_harmonically(Link& link) { return HarmonicLink(link).solve(); }

}  // namespace hexfield
