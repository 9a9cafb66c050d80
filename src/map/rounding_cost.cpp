#include <petscmat.h>

#include <algorithm>

#include "hexfield/base/petsc.hpp"
#include "hexfield/solve/kernels.hpp"
#include "hexfield/solve/tet_energy.hpp"
#include "rounding.hpp"

namespace hexfield {
namespace {

struct Triplets {
  std::vector<PetscInt> rows, columns;
  std::vector<double> values;
};

// Stiffness matrix of sum_t V_t |(J - J_t) M_t|^2 in the unknowns, M_t the clamped inverse of J_t; upper triangle
// of the real block, the real-integer block and the integer block.
struct Stiffness {
  Triplets real;
  Eigen::MatrixXd mixed;
  Eigen::MatrixXd integer;
};

Mat3 clamped_metric(const Mat3& jacobian, double edge) {
  const solve::Svd3 svd = solve::svd(jacobian);
  Vec3 inverse;
  for (int k = 0; k < 3; ++k) {
    const double stretch = std::clamp(svd.sigma[k] * edge, 0.2, 5.0);
    inverse[k] = edge * edge / (stretch * stretch);
  }
  return svd.v * inverse.asDiagonal() * svd.v.transpose();
}

Stiffness assemble(const TetMesh& mesh, const ConformingSpace& space, std::span<const double> y, double edge) {
  const CornerMap map = to_corner_map(space, coordinates(space, y));
  Stiffness s;
  const auto reals = static_cast<Eigen::Index>(space.num_reals);
  const auto integers = static_cast<Eigen::Index>(space.num_integers);
  s.mixed = Eigen::MatrixXd::Zero(reals, integers);
  s.integer = Eigen::MatrixXd::Zero(integers, integers);
  for (std::size_t i = 0; i < mesh.num_tets(); ++i) {
    const auto& v = mesh.tets[i];
    const solve::GradientOperator d =
        solve::gradient_operator({mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3])});
    Mat3 jacobian = Mat3::Zero();
    for (int c = 0; c < 4; ++c) jacobian += map.uvw[i][static_cast<std::size_t>(c)] * d.row(c);
    const double volume = signed_volume6(mesh, TetId(i)) / 6;
    const Eigen::Matrix4d k = volume * d * clamped_metric(jacobian, edge) * d.transpose();
    for (Eigen::Index a = 0; a < 4; ++a)
      for (Eigen::Index b = 0; b < 4; ++b)
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const auto x = 3 * static_cast<std::size_t>(space.cut.classes[i][static_cast<std::size_t>(a)]) + axis;
          const auto z = 3 * static_cast<std::size_t>(space.cut.classes[i][static_cast<std::size_t>(b)]) + axis;
          for (std::size_t p = space.row_start[x]; p < space.row_start[x + 1]; ++p)
            for (std::size_t q = space.row_start[z]; q < space.row_start[z + 1]; ++q) {
              const Eigen::Index row = space.columns[p];
              const Eigen::Index column = space.columns[q];
              const double value = k(a, b) * space.coefficients[p] * space.coefficients[q];
              if (row < reals && column < reals) {
                if (row > column) continue;
                s.real.rows.push_back(static_cast<PetscInt>(row));
                s.real.columns.push_back(static_cast<PetscInt>(column));
                s.real.values.push_back(value);
              } else if (row < reals) {
                s.mixed(row, column - reals) += value;
              } else if (column >= reals) {
                s.integer(row - reals, column - reals) += value;
              }
            }
        }
  }
  return s;
}

// real_block^-1 right_sides by a sparse Cholesky factorisation in this process.
Eigen::MatrixXd solve_real_block(Triplets& real, PetscInt n, const Eigen::MatrixXd& right_sides) {
  Mat a = nullptr, factor = nullptr, b = nullptr, x = nullptr;
  check_petsc(MatCreate(PETSC_COMM_SELF, &a), "MatCreate");
  check_petsc(MatSetSizes(a, n, n, n, n), "MatSetSizes");
  check_petsc(MatSetType(a, MATSEQSBAIJ), "MatSetType");
  check_petsc(
      MatSetPreallocationCOO(a, static_cast<PetscCount>(real.rows.size()), real.rows.data(), real.columns.data()),
      "MatSetPreallocationCOO");
  check_petsc(MatSetValuesCOO(a, real.values.data(), INSERT_VALUES), "MatSetValuesCOO");
  check_petsc(MatGetFactor(a, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, &factor), "MatGetFactor");
  MatFactorInfo info;
  check_petsc(MatFactorInfoInitialize(&info), "MatFactorInfoInitialize");
  check_petsc(MatCholeskyFactorSymbolic(factor, a, nullptr, &info), "MatCholeskyFactorSymbolic");
  check_petsc(MatCholeskyFactorNumeric(factor, a, &info), "MatCholeskyFactorNumeric");
  Eigen::MatrixXd rhs = right_sides;
  Eigen::MatrixXd result(rhs.rows(), rhs.cols());
  const auto m = static_cast<PetscInt>(rhs.cols());
  check_petsc(MatCreateSeqDense(PETSC_COMM_SELF, n, m, rhs.data(), &b), "MatCreateSeqDense");
  check_petsc(MatCreateSeqDense(PETSC_COMM_SELF, n, m, result.data(), &x), "MatCreateSeqDense");
  if (m > 0) check_petsc(MatMatSolve(factor, b, x), "MatMatSolve");
  for (Mat* matrix : {&x, &b, &factor, &a}) check_petsc(MatDestroy(matrix), "MatDestroy");
  return result;
}

}  // namespace

RoundingCost rounding_cost(const TetMesh& mesh, const ConformingSpace& space, std::span<const double> y, double edge) {
  Stiffness s = assemble(mesh, space, y, edge);
  RoundingCost cost;
  if (space.num_reals == 0) {
    cost.schur = s.integer;
    cost.following = s.mixed;
    return cost;
  }
  cost.following = -solve_real_block(s.real, static_cast<PetscInt>(space.num_reals), s.mixed);
  cost.schur = s.integer + s.mixed.transpose() * cost.following;
  cost.schur = 0.5 * (cost.schur + cost.schur.transpose()).eval();
  return cost;
}

}  // namespace hexfield
