#include "multigrid.hpp"

#include <cmath>

#include "hexfield/base/parallel.hpp"

namespace hexfield {
namespace {

constexpr std::size_t grain = 512;
constexpr int degree = 2;             // of the Chebyshev polynomials
constexpr double lowest_share = 0.2;  // of the largest eigenvalue, where smoothing begins
constexpr std::size_t most_dense = 700;

template <int B>
auto at(std::vector<double>& x, std::size_t i) {
  return Eigen::Map<Eigen::Matrix<double, B, 1>>(x.data() + static_cast<std::size_t>(B) * i);
}
template <int B>
auto at(const std::vector<double>& x, std::size_t i) {
  return Eigen::Map<const Eigen::Matrix<double, B, 1>>(x.data() + static_cast<std::size_t>(B) * i);
}

template <class Body>
void for_rows(std::size_t n, const Body& body) {
  parallel_for(n, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

// Weights of the residual and of the last step in each Chebyshev step on [lowest_share, 1] x largest.
struct Chebyshev {
  double theta, delta, rho;
  explicit Chebyshev(double largest)
      : theta((1 + lowest_share) * largest / 2), delta((1 - lowest_share) * largest / 2), rho(delta / theta) {}
  double first() const { return 1 / theta; }
  // Moves on; the step is keep * (last step) + factor * D^-1 (residual).
  std::pair<double, double> next() {
    const double before = rho;
    rho = 1 / (2 * theta / delta - before);
    return {2 * rho / delta, rho * before};
  }
};

}  // namespace

template <int B, int K>
template <class Entry>
void Multigrid<B, K>::add_blocks(const SparseRows& finer, const SparseRows& prolongation, const SparseRows& restriction,
                                 const Entry& entry, Level& level) {
  const SparseRows& matrix = *level.matrix;
  struct Piece {
    std::vector<std::size_t> places;
    std::vector<Block> blocks;
  };
  constexpr std::size_t rows_of_piece = 128;
  std::vector<Piece> pieces((matrix.rows() + rows_of_piece - 1) / rows_of_piece);
  parallel_for(matrix.rows(), rows_of_piece, [&](std::size_t begin, std::size_t end) {
    Piece& piece = pieces[begin / rows_of_piece];
    std::vector<std::int32_t> place_of;  // per entry of the row
    Block e;
    for (std::size_t row = begin; row < end; ++row) {
      place_of.assign(matrix.end(row) - matrix.begin(row), -1);
      for (std::size_t a = restriction.begin(row); a < restriction.end(row); ++a) {
        const std::size_t i = restriction.column(a);
        for (std::size_t k = finer.begin(i); k < finer.end(i); ++k) {
          const std::size_t j = finer.column(k);
          if (!entry(i, k, e)) continue;
          for (std::size_t c = prolongation.begin(j); c < prolongation.end(j); ++c) {
            const std::size_t place = matrix.find(row, prolongation.columns[c]);
            std::int32_t& mine = place_of[place - matrix.begin(row)];
            if (mine < 0) {
              mine = static_cast<std::int32_t>(piece.blocks.size());
              piece.places.push_back(place);
              piece.blocks.push_back(Block::Zero());
            }
            piece.blocks[static_cast<std::size_t>(mine)] += restriction.values[a] * prolongation.values[c] * e;
          }
        }
      }
    }
  });
  level.block_of.assign(matrix.columns.size(), -1);
  for (Piece& piece : pieces) {
    for (std::size_t n = 0; n < piece.places.size(); ++n)
      level.block_of[piece.places[n]] = static_cast<std::int32_t>(level.blocks.size() + n);
    level.blocks.insert(level.blocks.end(), piece.blocks.begin(), piece.blocks.end());
    piece = Piece();
  }
}

// What projections change in the first coarser matrix: prolongation^T (P L P - L) prolongation.
template <int B, int K>
void Multigrid<B, K>::first_blocks(const Spaces& root_spaces) {
  Level& level = levels_[0];
  int rank = 0;
  MPI_Comm_rank(hierarchy_.graph().comm(), &rank);
  if (rank == 0) {
    const SparseRows& finer = hierarchy_.root_matrix;
    const auto entry = [&](std::size_t i, std::size_t k, Block& e) {
      const std::size_t j = finer.column(k);
      if (root_spaces.slot[i] == Spaces::free && root_spaces.slot[j] == Spaces::free) return false;
      if (root_spaces.slot[i] == Spaces::free)
        e = root_spaces.at(j) * root_spaces.at(j).transpose();
      else if (root_spaces.slot[j] == Spaces::free)
        e = root_spaces.at(i) * root_spaces.at(i).transpose();
      else
        e = root_spaces.at(i) * (root_spaces.at(i).transpose() * root_spaces.at(j)) * root_spaces.at(j).transpose();
      e -= Block::Identity();
      e *= finer.values[k];
      return true;
    };
    add_blocks(finer, hierarchy_.root_interpolation, transposed(hierarchy_.root_interpolation), entry, level);
  }
  const MPI_Comm comm = hierarchy_.graph().comm();
  auto count = static_cast<std::int64_t>(level.blocks.size());
  MPI_Bcast(&count, 1, MPI_INT64_T, 0, comm);
  level.blocks.resize(static_cast<std::size_t>(count));
  level.block_of.resize(level.matrix->columns.size());
  MPI_Bcast(level.block_of.data(), static_cast<int>(level.block_of.size()), MPI_INT32_T, 0, comm);
  constexpr std::size_t chunk = 1 << 20;
  for (std::size_t first = 0; first < level.blocks.size(); first += chunk)
    MPI_Bcast(level.blocks[first].data(), static_cast<int>(std::min(chunk, level.blocks.size() - first)) * B * B,
              MPI_DOUBLE, 0, comm);
}

template <int B, int K>
Multigrid<B, K>::Multigrid(const Hierarchy& hierarchy, const Spaces& spaces, const Spaces& root_spaces)
    : hierarchy_(hierarchy), spaces_(spaces), levels_(hierarchy.matrices.size()) {
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    Level& level = levels_[l];
    level.matrix = &hierarchy.matrices[l];
    if (l == 0) {
      first_blocks(root_spaces);
    } else {
      const Level& finer = levels_[l - 1];
      level.prolongation = &hierarchy.prolongations[l - 1];
      level.restriction = transposed(*level.prolongation);
      const auto entry = [&](std::size_t, std::size_t k, Block& e) {
        if (finer.block_of[k] < 0) return false;
        e = finer.blocks[static_cast<std::size_t>(finer.block_of[k])];
        return true;
      };
      add_blocks(*finer.matrix, *level.prolongation, level.restriction, entry, level);
    }
    const std::size_t n = static_cast<std::size_t>(B) * level.matrix->rows();
    for (auto* v : {&level.x, &level.b, &level.r, &level.d, &level.t}) v->assign(n, 0.0);
    invert_diagonal(level);
    estimate_largest(level);
  }
  if (!levels_.empty()) factor(levels_.back());
  const std::size_t n = static_cast<std::size_t>(B) * hierarchy.graph().local();
  for (auto* v : {&r_, &d_, &t_}) v->assign(n, 0.0);
}

template <int B, int K>
void Multigrid<B, K>::invert_diagonal(Level& level) {
  const SparseRows& m = *level.matrix;
  level.inverse_diagonal.assign(m.rows(), 0.0);
  level.inverse_of.assign(m.rows(), -1);
  for (std::size_t i = 0; i < m.rows(); ++i) {
    const std::size_t k = m.find(i, static_cast<std::int32_t>(i));
    level.inverse_diagonal[i] = m.values[k] > 0 ? 1 / m.values[k] : 0;
    if (level.block_of[k] >= 0) level.inverse_of[i] = level.block_of[k];
  }
  std::int32_t count = 0;
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < m.rows(); ++i)
    if (level.inverse_of[i] >= 0) level.inverse_of[i] = count++, rows.push_back(i);
  level.inverses.resize(rows.size());
  for_rows(rows.size(), [&](std::size_t n) {
    const std::size_t k = m.find(rows[n], static_cast<std::int32_t>(rows[n]));
    const Block full = m.values[k] * Block::Identity() + level.blocks[static_cast<std::size_t>(level.block_of[k])];
    const Eigen::SelfAdjointEigenSolver<Block> eigen(full);
    Vector inverse = Vector::Zero();  // directions that projections remove altogether have no unknown
    for (int c = 0; c < B; ++c)
      if (eigen.eigenvalues()[c] > 1e-9 * std::abs(m.values[k])) inverse[c] = 1 / eigen.eigenvalues()[c];
    level.inverses[n] = eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
  });
}

template <int B, int K>
void Multigrid<B, K>::multiply(const Level& level, const std::vector<double>& x, std::vector<double>& y) {
  const SparseRows& m = *level.matrix;
  for_rows(m.rows(), [&](std::size_t i) {
    Vector sum = Vector::Zero();
    for (std::size_t k = m.begin(i); k < m.end(i); ++k) {
      const auto other = at<B>(x, m.column(k));
      sum += m.values[k] * other;
      if (level.block_of[k] >= 0) sum += level.blocks[static_cast<std::size_t>(level.block_of[k])] * other;
    }
    at<B>(y, i) = sum;
  });
}

// d = keep d + factor D^-1 r
template <int B, int K>
void Multigrid<B, K>::scaled_by_inverse(const Level& level, const std::vector<double>& r, double factor, double keep,
                                        std::vector<double>& d) {
  for_rows(level.matrix->rows(), [&](std::size_t i) {
    const auto own = at<B>(r, i);
    Vector step = level.inverse_diagonal[i] * own;
    if (level.inverse_of[i] >= 0) step = level.inverses[static_cast<std::size_t>(level.inverse_of[i])] * own;
    at<B>(d, i) = keep * at<B>(d, i) + factor * step;
  });
}

template <int B, int K>
void Multigrid<B, K>::estimate_largest(Level& level) {
  for (std::size_t i = 0; i < level.x.size(); ++i) level.x[i] = std::sin(static_cast<double>(i) * 1.618 + 1);
  double value = 0;
  for (int step = 0; step < 12; ++step) {
    multiply(level, level.x, level.r);
    scaled_by_inverse(level, level.r, 1, 0, level.d);
    double before = 0, after = 0;
    for (std::size_t i = 0; i < level.x.size(); ++i) {
      before += level.x[i] * level.x[i];
      after += level.d[i] * level.d[i];
    }
    if (!(after > 0)) break;
    value = std::sqrt(after / before);
    for (std::size_t i = 0; i < level.x.size(); ++i) level.x[i] = level.d[i] / std::sqrt(after);
  }
  level.largest = value > 0 ? 1.1 * value : 1;
}

template <int B, int K>
void Multigrid<B, K>::factor(Level& level) {
  const SparseRows& m = *level.matrix;
  const std::size_t n = static_cast<std::size_t>(B) * m.rows();
  if (n > most_dense || n == 0) return;
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
  for (std::size_t i = 0; i < m.rows(); ++i)
    for (std::size_t k = m.begin(i); k < m.end(i); ++k) {
      Block block = m.values[k] * Block::Identity();
      if (level.block_of[k] >= 0) block += level.blocks[static_cast<std::size_t>(level.block_of[k])];
      full.template block<B, B>(static_cast<Eigen::Index>(B * i), static_cast<Eigen::Index>(B * m.column(k))) = block;
    }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(full);
  Eigen::VectorXd inverse = eigen.eigenvalues();
  const double floor = 1e-11 * inverse.cwiseAbs().maxCoeff();
  for (double& v : inverse) v = v > floor ? 1 / v : 0;
  level.pseudo_inverse = eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
}

template <int B, int K>
void Multigrid<B, K>::smooth(Level& level, bool from_zero) {
  Chebyshev weights(level.largest);
  level.r = level.b;
  if (from_zero) {
    std::fill(level.x.begin(), level.x.end(), 0.0);
  } else {
    multiply(level, level.x, level.t);
    for (std::size_t i = 0; i < level.r.size(); ++i) level.r[i] -= level.t[i];
  }
  scaled_by_inverse(level, level.r, weights.first(), 0, level.d);
  for (int step = 1;; ++step) {
    for (std::size_t i = 0; i < level.x.size(); ++i) level.x[i] += level.d[i];
    if (step == degree) return;
    multiply(level, level.d, level.t);
    for (std::size_t i = 0; i < level.r.size(); ++i) level.r[i] -= level.t[i];
    const auto [factor, keep] = weights.next();
    scaled_by_inverse(level, level.r, factor, keep, level.d);
  }
}

template <int B, int K>
void Multigrid<B, K>::solve(std::size_t l) {
  Level& level = levels_[l];
  if (level.pseudo_inverse.size() > 0) {
    using Dense = Eigen::Map<Eigen::VectorXd>;
    const auto n = static_cast<Eigen::Index>(level.b.size());
    Dense(level.x.data(), n) = level.pseudo_inverse * Dense(level.b.data(), n);
    return;
  }
  smooth(level, true);
  if (l + 1 < levels_.size()) {
    Level& coarser = levels_[l + 1];
    multiply(level, level.x, level.t);
    for_rows(coarser.matrix->rows(), [&](std::size_t row) {
      Vector sum = Vector::Zero();
      for (std::size_t k = coarser.restriction.begin(row); k < coarser.restriction.end(row); ++k) {
        const std::size_t i = coarser.restriction.column(k);
        sum += coarser.restriction.values[k] * (at<B>(level.b, i) - at<B>(level.t, i));
      }
      at<B>(coarser.b, row) = sum;
    });
    solve(l + 1);
    const SparseRows& p = *coarser.prolongation;
    for_rows(p.rows(), [&](std::size_t i) {
      for (std::size_t k = p.begin(i); k < p.end(i); ++k)
        at<B>(level.x, i) += p.values[k] * at<B>(coarser.x, p.column(k));
    });
  }
  smooth(level, false);
}

template <int B, int K>
void Multigrid<B, K>::apply(std::vector<double>& x, std::vector<double>& y) const {
  const NodeGraph& graph = hierarchy_.graph();
  graph.update_ghosts(x, B);
  for_rows(graph.owned(), [&](std::size_t i) {
    if (spaces_.slot[i] == Spaces::fixed) {
      at<B>(y, i).setZero();
      return;
    }
    Vector sum = hierarchy_.diagonal[i] * at<B>(x, i);
    for (auto k = static_cast<std::size_t>(graph.offsets[i]); k < static_cast<std::size_t>(graph.offsets[i + 1]); ++k)
      sum -= graph.weights[k] * at<B>(x, static_cast<std::size_t>(graph.columns[k]));
    at<B>(y, i) = spaces_.projected(i, sum);
  });
}

template <int B, int K>
void Multigrid<B, K>::smooth_fine(const std::vector<double>& b, std::vector<double>& x, bool from_zero) {
  Chebyshev weights(hierarchy_.largest);
  const std::size_t owned = hierarchy_.graph().owned();
  if (!from_zero) apply(x, t_);
  for (int step = 0; step < degree; ++step) {
    const auto [factor, keep] = step == 0 ? std::pair<double, double>{weights.first(), 0.0} : weights.next();
    if (step > 0) apply(d_, t_);
    for_rows(owned, [&](std::size_t i) {
      Vector r = step == 0 ? Vector(at<B>(b, i)) : Vector(at<B>(r_, i));
      if (step > 0 || !from_zero) r -= at<B>(t_, i);
      at<B>(r_, i) = r;
      const double inverse = hierarchy_.diagonal[i] > 0 ? 1 / hierarchy_.diagonal[i] : 0;
      const Vector d = step == 0 ? Vector(factor * inverse * r) : Vector(keep * at<B>(d_, i) + factor * inverse * r);
      at<B>(d_, i) = d;
      at<B>(x, i) = step == 0 && from_zero ? d : Vector(at<B>(x, i) + d);
    });
  }
}

template <int B, int K>
void Multigrid<B, K>::restrict_fine(const std::vector<double>& b, std::vector<double>& x) {
  const NodeGraph& graph = hierarchy_.graph();
  Level& coarser = levels_[0];
  apply(x, t_);
  for_rows(graph.owned(), [&](std::size_t i) { at<B>(r_, i) = at<B>(b, i) - at<B>(t_, i); });
  graph.update_ghosts(r_, B);
  const SparseRows& restriction = hierarchy_.restriction;
  for_rows(restriction.rows(), [&](std::size_t row) {
    Vector sum = Vector::Zero();
    for (std::size_t k = restriction.begin(row); k < restriction.end(row); ++k)
      sum += restriction.values[k] * at<B>(r_, restriction.column(k));
    at<B>(coarser.b, row) = sum;
  });
  // Every row has one owner, the others add zeros.
  MPI_Allreduce(MPI_IN_PLACE, coarser.b.data(), static_cast<int>(coarser.b.size()), MPI_DOUBLE, MPI_SUM, graph.comm());
}

template <int B, int K>
void Multigrid<B, K>::cycle(const std::vector<double>& b, std::vector<double>& x) {
  const NodeGraph& graph = hierarchy_.graph();
  smooth_fine(b, x, true);
  if (!levels_.empty()) {
    restrict_fine(b, x);
    solve(0);
    const SparseRows& p = hierarchy_.interpolation;
    for_rows(graph.owned(), [&](std::size_t i) {
      Vector sum = Vector::Zero();
      for (std::size_t k = p.begin(i); k < p.end(i); ++k) sum += p.values[k] * at<B>(levels_[0].x, p.column(k));
      at<B>(x, i) += spaces_.projected(i, sum);
    });
  }
  smooth_fine(b, x, false);
}

template class Multigrid<3, 1>;
template class Multigrid<9, 2>;

}  // namespace hexfield
