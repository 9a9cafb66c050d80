#include <algorithm>
#include <cmath>
#include <map>

#include "hexfield/base/parallel.hpp"
#include "hexfield/solve/tet_energy.hpp"
#include "integrable_coarse.hpp"

namespace hexfield::integrable {
namespace {

// The rows of x = N y, known to all ranks.
struct Rows {
  std::vector<std::int64_t> start;
  std::vector<std::int32_t> columns;
  std::vector<std::int32_t> coefficients;
  std::int64_t num_unknowns = 0;
};

Rows broadcast_rows(MPI_Comm comm, const ConformingSpace& space) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  Rows rows;
  if (rank == 0) {
    rows.start.assign(space.row_start.begin(), space.row_start.end());
    rows.columns = space.columns;
    rows.coefficients = space.coefficients;
    rows.num_unknowns = static_cast<std::int64_t>(space.num_unknowns());
  }
  std::int64_t sizes[3] = {static_cast<std::int64_t>(rows.start.size()), static_cast<std::int64_t>(rows.columns.size()),
                           rows.num_unknowns};
  MPI_Bcast(sizes, 3, MPI_INT64_T, 0, comm);
  rows.start.resize(static_cast<std::size_t>(sizes[0]));
  rows.columns.resize(static_cast<std::size_t>(sizes[1]));
  rows.coefficients.resize(static_cast<std::size_t>(sizes[1]));
  rows.num_unknowns = sizes[2];
  MPI_Bcast(rows.start.data(), static_cast<int>(sizes[0]), MPI_INT64_T, 0, comm);
  MPI_Bcast(rows.columns.data(), static_cast<int>(sizes[1]), MPI_INT32_T, 0, comm);
  MPI_Bcast(rows.coefficients.data(), static_cast<int>(sizes[1]), MPI_INT32_T, 0, comm);
  return rows;
}

// A sparse linear form in the needed unknowns.
using Form = std::map<PetscInt, double>;

class ConformingCoarse final : public CoarseSpace {
 public:
  ConformingCoarse(MPI_Comm comm, const Problem& problem, const ConformingSpace& space,
                   const IntegrableOptions& options)
      : comm_(comm), problem_(problem), kind_(solve::Preconditioner::cholesky) {
    std::vector<double> data;
    for (std::size_t t = 0; t < space.cut.classes.size(); ++t) {
      for (std::int32_t c : space.cut.classes[t]) data.push_back(c);
      data.push_back(space.cut.gauges[t]);
    }
    data = problem.mesh().scatter_tets(data, 5);
    const Rows rows = broadcast_rows(comm, space);
    size_ = static_cast<PetscInt>(rows.num_unknowns);
    if (rows.num_unknowns > options.cholesky_limit) kind_ = solve::Preconditioner::amg;
    collect(rows, data);
  }

  void set_stage(const IntegrableStage& stage) override {
    const bool faces = stage.smoothness > 0;
    if (inverse_ != nullptr && faces == with_faces_) return;
    with_faces_ = faces;
    build_pattern();
  }

  void update() override {
    std::vector<double> values(num_values_);
    parallel_for(problem_.mesh().num_owned(), 64, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) tet_values(t, values.data() + first_value_[t]);
    });
    for (const FaceRow& row : face_rows_) {
      const auto w = problem_.face_weights(row.tet, row.face);
      double* v = values.data() + row.first_value;
      for (double a : row.coefficients)
        for (double b : row.coefficients) *v++ = (w.whole - w.normal) * a * b;
    }
    inverse_->update(values, 1e-10);
  }

  void add_correction(std::span<const double> r, std::span<double> z) override {
    const std::size_t owned = problem_.mesh().num_owned();
    corners_.resize(12 * owned);
    parallel_for(owned, 256, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) {
        Eigen::Map<Eigen::Matrix<double, 4, 3>> x(corners_.data() + 12 * t);
        x = gradients_[t] * Jacobians(r.data() + 9 * t).transpose();
      }
    });
    std::fill(rhs_.begin(), rhs_.end(), 0.0);
    for (std::size_t t = 0; t < owned; ++t)
      for (std::size_t i = first_entry_[t]; i < first_entry_[t + 1]; ++i)
        rhs_[static_cast<std::size_t>(entries_[i].unknown)] +=
            entries_[i].coefficient * corners_[12 * t + static_cast<std::size_t>(entries_[i].corner)];
    inverse_->apply(rhs_, x_);
    parallel_for(owned, 256, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) {
        Eigen::Matrix<double, 4, 3> x = Eigen::Matrix<double, 4, 3>::Zero();
        for (std::size_t i = first_entry_[t]; i < first_entry_[t + 1]; ++i)
          x.data()[entries_[i].corner] += entries_[i].coefficient * x_[static_cast<std::size_t>(entries_[i].unknown)];
        const Mat3 j = x.transpose() * gradients_[t];
        Eigen::Map<RowMajor3> out(z.data() + 9 * t);
        for (int k = 0; k < 3; ++k)
          out.row(k) += (problem_.projectors(t)[static_cast<std::size_t>(k)] * j.row(k).transpose()).transpose();
      }
    });
  }

 private:
  struct Entry {
    std::int32_t unknown;  // position among the needed ones
    std::int32_t corner;   // 4 k + c: coordinate k of corner c, in the chart of the tet
    double coefficient;
  };
  struct FaceRow {
    std::size_t tet;
    int face;
    std::vector<PetscInt> unknowns;
    std::vector<double> coefficients;
    std::size_t first_value;
  };

  // Entries of all local tets, ghosts too, and the unknowns they need.
  void collect(const Rows& rows, const std::vector<double>& data) {
    const TetMesh& mesh = problem_.mesh().local();
    for (std::size_t t = 0; t < mesh.num_tets(); ++t) {
      const Mat3& gauge = octahedral::matrix(static_cast<octahedral::Rotation>(std::lround(data[5 * t + 4])));
      for (std::size_t c = 0; c < 4; ++c)
        for (int k = 0; k < 3; ++k)
          for (int i = 0; i < 3; ++i) {
            if (gauge(k, i) == 0) continue;
            const auto x = static_cast<std::size_t>(3 * std::lround(data[5 * t + c]) + i);
            for (std::int64_t e = rows.start[x]; e < rows.start[x + 1]; ++e)
              entries_.push_back({rows.columns[static_cast<std::size_t>(e)], 4 * k + static_cast<std::int32_t>(c),
                                  gauge(k, i) * rows.coefficients[static_cast<std::size_t>(e)]});
          }
      first_entry_.push_back(entries_.size());
      const auto& v = mesh.tets[t];
      gradients_.push_back(
          solve::gradient_operator({mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3])}));
    }
    for (const Entry& e : entries_) needed_.push_back(e.unknown);
    std::sort(needed_.begin(), needed_.end());
    needed_.erase(std::unique(needed_.begin(), needed_.end()), needed_.end());
    for (Entry& e : entries_)
      e.unknown =
          static_cast<std::int32_t>(std::lower_bound(needed_.begin(), needed_.end(), e.unknown) - needed_.begin());
  }

  std::vector<PetscInt> unknowns_of(std::size_t t) const {
    std::vector<PetscInt> unknowns;
    for (std::size_t i = first_entry_[t]; i < first_entry_[t + 1]; ++i) unknowns.push_back(entries_[i].unknown);
    std::sort(unknowns.begin(), unknowns.end());
    unknowns.erase(std::unique(unknowns.begin(), unknowns.end()), unknowns.end());
    return unknowns;
  }

  // Rows of the linear map from unknowns to J n of a tet, left-multiplied by `m`, times `factor`.
  void add_normal_derivative(std::size_t t, const Vec3& n, const Mat3& m, double factor,
                             std::array<Form, 3>& rows) const {
    const Eigen::Vector4d slope = gradients_[t] * n;
    for (std::size_t i = first_entry_[t]; i < first_entry_[t + 1]; ++i) {
      const Entry& e = entries_[i];
      for (int r = 0; r < 3; ++r)
        if (m(r, e.corner / 4) != 0)
          rows[static_cast<std::size_t>(r)][e.unknown] +=
              factor * m(r, e.corner / 4) * slope[e.corner % 4] * e.coefficient;
    }
  }

  void build_face_rows() {
    const TetMesh& mesh = problem_.mesh().local();
    const auto global = problem_.mesh().global_tets();
    for (std::size_t t = 0; t < problem_.mesh().num_owned(); ++t)
      for (int f = 0; f < 4; ++f) {
        const HalfFaceId o = mesh.opposite_half_face(HalfFaceId(TetId(static_cast<std::int64_t>(t)), f));
        // The side of the lower global id speaks for the face.
        if (!o.valid() || global[o.tet().index()] < global[t]) continue;
        const Vec3 n = problem_.face_weights(t, f).n;
        std::array<Form, 3> rows;
        add_normal_derivative(t, n, Mat3::Identity(), 1.0, rows);
        add_normal_derivative(o.tet().index(), n, problem_.matching(t, f), -1.0, rows);
        for (const Form& form : rows) {
          FaceRow row{t, f, {}, {}, 0};
          for (const auto& [unknown, coefficient] : form)
            if (std::abs(coefficient) > 0) row.unknowns.push_back(unknown), row.coefficients.push_back(coefficient);
          if (!row.unknowns.empty()) face_rows_.push_back(std::move(row));
        }
      }
  }

  void build_pattern() {
    std::vector<PetscInt> rows, columns;
    auto add_square = [&](const std::vector<PetscInt>& unknowns) {
      for (PetscInt i : unknowns)
        for (PetscInt j : unknowns) rows.push_back(i), columns.push_back(j);
    };
    first_value_.clear();
    face_rows_.clear();
    for (std::size_t t = 0; t < problem_.mesh().num_owned(); ++t) {
      first_value_.push_back(rows.size());
      add_square(unknowns_of(t));
    }
    if (with_faces_) build_face_rows();
    for (FaceRow& row : face_rows_) {
      row.first_value = rows.size();
      add_square(row.unknowns);
    }
    num_values_ = rows.size();
    inverse_ = std::make_unique<solve::SparseInverse>(comm_, size_, needed_, rows, columns, kind_);
    rhs_.resize(inverse_->num_needed());
    x_.resize(inverse_->num_needed());
  }

  void tet_values(std::size_t t, double* values) const {
    const std::vector<PetscInt> unknowns = unknowns_of(t);
    const auto n = static_cast<Eigen::Index>(unknowns.size());
    Eigen::Matrix<double, 9, Eigen::Dynamic> b = Eigen::Matrix<double, 9, Eigen::Dynamic>::Zero(9, n);
    for (std::size_t i = first_entry_[t]; i < first_entry_[t + 1]; ++i) {
      const Entry& e = entries_[i];
      const auto column = std::lower_bound(unknowns.begin(), unknowns.end(), e.unknown) - unknowns.begin();
      b.block<3, 1>(3 * (e.corner / 4), column) += e.coefficient * gradients_[t].row(e.corner % 4).transpose();
    }
    Eigen::Map<Eigen::MatrixXd>(values, n, n) = b.transpose() * (problem_.distortion_block(t) * b);
  }

  MPI_Comm comm_;
  const Problem& problem_;
  solve::Preconditioner kind_;
  PetscInt size_ = 0;
  bool with_faces_ = false;
  std::vector<Entry> entries_;
  std::vector<std::size_t> first_entry_{0};
  std::vector<solve::GradientOperator> gradients_;
  std::vector<PetscInt> needed_;
  std::vector<FaceRow> face_rows_;
  std::vector<std::size_t> first_value_;
  std::size_t num_values_ = 0;
  std::unique_ptr<solve::SparseInverse> inverse_;
  std::vector<double> corners_, rhs_, x_;
};

}  // namespace

std::unique_ptr<CoarseSpace> conforming_coarse_space(MPI_Comm comm, const Problem& problem,
                                                     const ConformingSpace& space, const IntegrableOptions& options) {
  return std::make_unique<ConformingCoarse>(comm, problem, space, options);
}

}  // namespace hexfield::integrable
