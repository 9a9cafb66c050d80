#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <functional>
#include <span>
#include <vector>

#include "hexfield/base/geometry.hpp"

/// Energies of singularity relocation (Liu and Bommes 2023, section 5.3; spec-lmff section 6): what they are and
/// their derivatives. Which edges and vertices carry them is decided in repair/relocation.hpp. Thread safe.
namespace hexfield {

/// Shape energy log(tr(J^T J) / det(J)^{2/3}) of a tet against the regular one, with gradient and Hessian by corner;
/// infinite (and no derivatives) where the tet is not positive.
struct TetShape {
  double value = 0;
  std::array<Vec3, 4> gradient;
  std::array<std::array<Mat3, 4>, 4> hessian;  ///< not projected
};
double tet_shape(const std::array<Vec3, 4>& x);
TetShape tet_shape_derivatives(const std::array<Vec3, 4>& x);

/// The same for one moving corner (0 to 3).
struct CornerShape {
  double value = 0;
  Vec3 gradient;
  Mat3 hessian;
};
CornerShape tet_corner_derivatives(const std::array<Vec3, 4>& x, int corner);

/// The same in the plane perpendicular to the unit `normal`: log(tr(J^T J) / det(J)) of the projected triangle;
/// infinite where it does not turn counter-clockwise about the normal.
struct TriangleShape {
  double value = 0;
  std::array<Vec3, 3> gradient;
  std::array<std::array<Mat3, 3>, 3> hessian;  ///< not projected
};
double triangle_shape(const std::array<Vec3, 3>& x, const Vec3& normal);
TriangleShape triangle_shape_derivatives(const std::array<Vec3, 3>& x, const Vec3& normal);

/// Sets negative eigenvalues of a symmetric matrix to zero.
void project_to_semidefinite(Eigen::Ref<Eigen::MatrixXd> matrix);

/// Sum of energies over points, some of which may move: x_i = p_i + B_i y_i, with 1 to 3 orthonormal columns in B_i.
class RelocationEnergy {
 public:
  /// What a point may do.
  struct Freedom {
    int dimensions = 0;             ///< 0: fixed
    Mat3 basis = Mat3::Identity();  ///< the first columns count
  };

  RelocationEnergy(std::vector<Vec3> points, std::vector<Freedom> freedoms);

  /// weight * |direction x (x_i - x_j)|^2 with a unit direction: E_a.
  void add_alignment(int i, int j, const Vec3& direction, double weight);
  /// weight * |x_i - x_j|^2: E_s.
  void add_shrinkage(int i, int j, double weight);
  /// weight * |x_i + x_k - 2 x_j|^2: E_c.
  void add_curvature(int i, int j, int k, double weight);
  /// weight * |x_i - target|^2: E_r.
  void add_attraction(int i, const Vec3& target, double weight);
  /// weight * tet_shape and weight * triangle_shape: E_d. Without a free corner they are left out.
  void add_tet(const std::array<int, 4>& corners, double weight);
  void add_triangle(const std::array<int, 3>& corners, const Vec3& normal, double weight);

  int num_unknowns() const { return first_.back(); }
  Vec3 position(int i, const Eigen::VectorXd& y) const;
  /// Infinite where a tet or triangle is not positive.
  double value(const Eigen::VectorXd& y) const;
  /// Shortens the step of each point by itself until no shape of it gets worse by more than 1.5 on the way from y to
  /// y + step (a loss of about nine tenths of the volume): one tight place does not hold up the others.
  void shorten(const Eigen::VectorXd& y, Eigen::VectorXd& step) const;
  /// Also the gradient and, lower triangle, the sum of element Hessians that are positive-semidefinite: those of the
  /// shapes are projected after restriction to the unknowns of the element.
  double derivatives(const Eigen::VectorXd& y, Eigen::VectorXd& gradient, Eigen::SparseMatrix<double>& hessian) const;

 private:
  struct Quadratic {  // weight * |metric (sum of coefficients x - offset)|^2, metric a projection
    std::array<int, 3> points;
    std::array<double, 3> coefficients;
    int count;
    Mat3 metric;
    Vec3 offset;
    double weight;
  };
  struct Tet {
    std::array<int, 4> corners;
    double weight;
  };
  struct Triangle {
    std::array<int, 3> corners;
    Vec3 normal;
    double weight;
  };
  struct Contribution;

  int dimensions(int i) const { return first_[static_cast<std::size_t>(i) + 1] - first_[static_cast<std::size_t>(i)]; }
  std::size_t num_elements() const { return quadratics_.size() + tets_.size() + triangles_.size(); }
  std::span<const int> corners(std::size_t e) const;
  double element_value(std::size_t e, const Eigen::VectorXd& y) const;
  double shape_of(std::size_t e, const Eigen::VectorXd& y) const;  // of tets and triangles, without weight
  void element_derivatives(std::size_t e, const Eigen::VectorXd& y, Contribution& out) const;

  void restrict_to_unknowns(std::span<const int> points, const std::array<Vec3, 4>& gradient,
                            const std::array<std::array<Mat3, 4>, 4>& hessian, Contribution& out) const;

  std::vector<Vec3> points_;
  std::vector<Freedom> freedoms_;
  std::vector<int> first_;  // first unknown per point
  std::vector<Quadratic> quadratics_;
  std::vector<Tet> tets_;
  std::vector<Triangle> triangles_;
};

struct NewtonDescent {
  int iterations = 0;
  double start = 0, end = 0;  ///< energies
};
/// Projected Newton with sparse LDL^T from y, which is overwritten: ends after `max_iterations` or when a step
/// lowers the energy by less than `tolerance` of it. Never leaves the domain. Same bytes for any number of threads.
NewtonDescent descend(const RelocationEnergy& energy, Eigen::VectorXd& y, int max_iterations, double tolerance,
                      const std::function<void()>& before_step = {});

}  // namespace hexfield
