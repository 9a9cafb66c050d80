#include "reduced_laplacian.hpp"

#include <algorithm>

#include "hexfield/base/parallel.hpp"
#include "hexfield/base/petsc.hpp"

namespace hexfield {
namespace {

// Unknowns of two full nodes couple only component by component; all others are dense blocks.
bool is_diagonal(int rows, int columns) { return rows == 9 && columns == 9; }

double entry(const NodeBasis& a, int row, const NodeBasis& b, int column) {
  if (a.size == 9 && b.size == 9) return row == column ? 1.0 : 0.0;
  if (a.size == 9) return b.columns(row, column);
  if (b.size == 9) return a.columns(column, row);
  return a.columns.col(row).dot(b.columns.col(column));
}

}  // namespace

ReducedLaplacian::ReducedLaplacian(const NodeGraph& graph, std::vector<int> sizes)
    : graph_(graph), sizes_(std::move(sizes)) {
  std::vector<double> numbers(graph.local(), 0.0);
  PetscInt owned = 0;
  for (std::size_t i = 0; i < graph.owned(); ++i) owned += sizes_[i];
  PetscInt first = 0;
  MPI_Exscan(&owned, &first, 1, MPIU_INT, MPI_SUM, graph.comm());
  owned_unknowns_ = static_cast<std::size_t>(owned);
  for (std::size_t i = 0; i < graph.owned(); ++i) {
    numbers[i] = static_cast<double>(first);
    first += sizes_[i];
  }
  graph.update_ghosts(numbers, 1);
  starts_.resize(std::max<std::size_t>(graph.local(), 1), 0);
  for (std::size_t i = 0; i < graph.local(); ++i) starts_[i] = static_cast<PetscInt>(numbers[i]);
  build_pattern();
}

ReducedLaplacian::~ReducedLaplacian() {
  KSPDestroy(&solver_);
  MatDestroy(&matrix_);
  PetscOptionsDestroy(&options_);
}

void ReducedLaplacian::build_pattern() {
  rows_.assign(1, 0);
  for (std::size_t i = 0; i < graph_.owned(); ++i) {
    // Neighbours ascend; the node itself goes where its number belongs.
    std::vector<std::size_t> around;
    for (auto k = graph_.offsets[i]; k < graph_.offsets[i + 1]; ++k)
      around.push_back(static_cast<std::size_t>(graph_.columns[static_cast<std::size_t>(k)]));
    around.push_back(i);
    std::sort(around.begin(), around.end(), [&](std::size_t a, std::size_t b) { return starts_[a] < starts_[b]; });
    for (int r = 0; r < sizes_[i]; ++r) {
      for (std::size_t j : around) {
        if (is_diagonal(sizes_[i], sizes_[j])) {
          columns_.push_back(starts_[j] + r);
          continue;
        }
        for (int c = 0; c < sizes_[j]; ++c) columns_.push_back(starts_[j] + c);
      }
      rows_.push_back(static_cast<PetscInt>(columns_.size()));
    }
  }
  values_.assign(columns_.size(), 0.0);
}

void ReducedLaplacian::fill_row(std::size_t i, const std::vector<NodeBasis>& bases) {
  double total = 0;
  for (auto k = graph_.offsets[i]; k < graph_.offsets[i + 1]; ++k) total += graph_.weights[static_cast<std::size_t>(k)];
  struct Neighbour {
    std::size_t node;
    double weight;
  };
  std::vector<Neighbour> around;
  for (auto k = graph_.offsets[i]; k < graph_.offsets[i + 1]; ++k)
    around.push_back({static_cast<std::size_t>(graph_.columns[static_cast<std::size_t>(k)]),
                      -graph_.weights[static_cast<std::size_t>(k)]});
  around.push_back({i, total});
  std::sort(around.begin(), around.end(),
            [&](const Neighbour& a, const Neighbour& b) { return starts_[a.node] < starts_[b.node]; });
  auto at = static_cast<std::size_t>(rows_[start(i)]);
  for (int r = 0; r < sizes_[i]; ++r)
    for (const Neighbour& n : around) {
      if (is_diagonal(sizes_[i], sizes_[n.node])) {
        values_[at++] = n.weight;
        continue;
      }
      for (int c = 0; c < sizes_[n.node]; ++c) values_[at++] = n.weight * entry(bases[i], r, bases[n.node], c);
    }
}

void ReducedLaplacian::set(const std::vector<NodeBasis>& bases, bool keep_preconditioner) {
  parallel_for(graph_.owned(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (sizes_[i] > 0) fill_row(i, bases);
  });
  const auto n = static_cast<PetscInt>(owned_unknowns_);
  if (matrix_ == nullptr) {
    check_petsc(MatCreateMPIAIJWithArrays(graph_.comm(), n, n, PETSC_DETERMINE, PETSC_DETERMINE, rows_.data(),
                                          columns_.data(), values_.data(), &matrix_),
                "MatCreateMPIAIJWithArrays");
    check_petsc(MatSetOption(matrix_, MAT_SPD, PETSC_TRUE), "MatSetOption");
    check_petsc(KSPCreate(graph_.comm(), &solver_), "KSPCreate");
    check_petsc(KSPSetType(solver_, KSPCG), "KSPSetType");
    check_petsc(KSPSetNormType(solver_, KSP_NORM_UNPRECONDITIONED), "KSPSetNormType");
    PC pc = nullptr;
    check_petsc(KSPGetPC(solver_, &pc), "KSPGetPC");
    check_petsc(PetscOptionsCreate(&options_), "PetscOptionsCreate");
    const char* const settings[][2] = {{"-pc_hypre_boomeramg_strong_threshold", "0.5"},
                                       {"-pc_hypre_boomeramg_coarsen_type", "HMIS"},
                                       {"-pc_hypre_boomeramg_interp_type", "ext+i"},
                                       {"-pc_hypre_boomeramg_P_max", "4"},
                                       {"-pc_hypre_boomeramg_agg_nl", "1"}};
    for (const auto& s : settings) check_petsc(PetscOptionsSetValue(options_, s[0], s[1]), "PetscOptionsSetValue");
    check_petsc(PetscObjectSetOptions(reinterpret_cast<PetscObject>(pc), options_), "PetscObjectSetOptions");
    check_petsc(PCSetType(pc, PCHYPRE), "PCSetType");
    check_petsc(PCHYPRESetType(pc, "boomeramg"), "PCHYPRESetType");
    check_petsc(PCSetFromOptions(pc), "PCSetFromOptions");
  } else {
    check_petsc(MatUpdateMPIAIJWithArray(matrix_, values_.data()), "MatUpdateMPIAIJWithArray");
  }
  check_petsc(KSPSetOperators(solver_, matrix_, matrix_), "KSPSetOperators");
  check_petsc(KSPSetReusePreconditioner(solver_, keep_preconditioner ? PETSC_TRUE : PETSC_FALSE),
              "KSPSetReusePreconditioner");
}

LinearReport ReducedLaplacian::solve(const std::vector<double>& rhs, std::vector<double>& x, double tolerance,
                                     int max_iterations) {
  LinearReport report;
  PetscInt total = 0;
  check_petsc(MatGetSize(matrix_, &total, nullptr), "MatGetSize");
  x.assign(owned_unknowns_, 0.0);
  if (total == 0) return report;
  Vec b = nullptr, y = nullptr;
  const auto n = static_cast<PetscInt>(owned_unknowns_);
  check_petsc(VecCreateMPIWithArray(graph_.comm(), 1, n, PETSC_DETERMINE, rhs.data(), &b), "VecCreateMPIWithArray");
  check_petsc(VecCreateMPIWithArray(graph_.comm(), 1, n, PETSC_DETERMINE, x.data(), &y), "VecCreateMPIWithArray");
  check_petsc(KSPSetTolerances(solver_, tolerance, 0.0, PETSC_DEFAULT, max_iterations), "KSPSetTolerances");
  check_petsc(KSPSolve(solver_, b, y), "KSPSolve");
  PetscInt iterations = 0;
  check_petsc(KSPGetIterationNumber(solver_, &iterations), "KSPGetIterationNumber");
  double residual = 0, norm = 0;
  check_petsc(KSPGetResidualNorm(solver_, &residual), "KSPGetResidualNorm");
  check_petsc(VecNorm(b, NORM_2, &norm), "VecNorm");
  report.iterations = static_cast<int>(iterations);
  report.residual = norm > 0 ? residual / norm : 0;
  VecDestroy(&b);
  VecDestroy(&y);
  return report;
}

}  // namespace hexfield
