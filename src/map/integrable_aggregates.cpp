#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "hexfield/base/agree.hpp"
#include "hexfield/base/parallel.hpp"
#include "integrable_coarse.hpp"

namespace hexfield::integrable {
namespace {

// Calls visit(neighbour) for the tets across faces off the cut.
template <class Visit>
void for_joined(const TetMesh& mesh, const CutGraph& cut, TetId t, Visit visit) {
  for (int f = 0; f < 4; ++f) {
    const HalfFaceId h(t, f);
    if (!mesh.is_boundary(h) && cut.patch(h) == 0) visit(mesh.opposite_half_face(h).tet());
  }
}

class AggregateSpace final : public CoarseSpace {
 public:
  AggregateSpace(MPI_Comm comm, const Problem& problem, std::vector<double> data, PetscInt count,
                 const IntegrableOptions& options)
      : problem_(problem) {
    const std::size_t tets = problem.mesh().local().num_tets();
    std::vector<PetscInt> blocks;  // coarse blocks that this rank touches
    for (std::size_t t = 0; t < tets; ++t) {
      blocks.push_back(static_cast<PetscInt>(std::lround(data[2 * t])));
      gauges_.push_back(octahedral::matrix(static_cast<octahedral::Rotation>(std::lround(data[2 * t + 1]))));
    }
    std::vector<PetscInt> needed = blocks;
    std::sort(needed.begin(), needed.end());
    needed.erase(std::unique(needed.begin(), needed.end()), needed.end());
    for (PetscInt b : blocks)
      local_.push_back(static_cast<std::int32_t>(std::lower_bound(needed.begin(), needed.end(), b) - needed.begin()));
    std::vector<PetscInt> unknowns;
    for (PetscInt b : needed)
      for (PetscInt i = 0; i < 9; ++i) unknowns.push_back(9 * b + i);
    find_pairs();
    std::vector<PetscInt> rows, columns;
    for (const auto& [a, b] : pairs_)
      for (PetscInt i = 0; i < 9; ++i)
        for (PetscInt j = 0; j < 9; ++j) rows.push_back(9 * a + i), columns.push_back(9 * b + j);
    const auto kind = 9 * count > options.cholesky_limit ? solve::Preconditioner::amg : solve::Preconditioner::cholesky;
    inverse_ = std::make_unique<solve::SparseInverse>(comm, 9 * count, std::move(unknowns), rows, columns, kind);
    rhs_.resize(inverse_->num_needed());
    x_.resize(inverse_->num_needed());
  }

  void set_stage(const IntegrableStage&) override {}

  void update() override {
    std::vector<solve::Mat9> values(pairs_.size(), solve::Mat9::Zero());
    const std::size_t owned = problem_.mesh().num_owned();
    std::vector<std::array<solve::Mat9, 5>> parts;
    constexpr std::size_t chunk = 4096;
    for (std::size_t first = 0; first < owned; first += chunk) {
      const std::size_t n = std::min(chunk, owned - first);
      parts.resize(n);
      parallel_for(n, 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) parts[i] = contributions(first + i);
      });
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < 5; ++k)
          if (slots_[first + i][k] >= 0) values[static_cast<std::size_t>(slots_[first + i][k])] += parts[i][k];
    }
    inverse_->update({values.empty() ? nullptr : values[0].data(), 81 * values.size()}, 1e-9);
  }

  void add_correction(std::span<const double> r, std::span<double> z) override {
    const std::size_t owned = problem_.mesh().num_owned();
    std::fill(rhs_.begin(), rhs_.end(), 0.0);
    // r is in the constrained space already, so P^T r = r.
    for (std::size_t t = 0; t < owned; ++t) {
      Eigen::Map<RowMajor3> coarse(rhs_.data() + 9 * static_cast<std::size_t>(local_[t]));
      coarse += gauges_[t].transpose() * Jacobians(r.data() + 9 * t);
    }
    inverse_->apply(rhs_, x_);
    for (std::size_t t = 0; t < owned; ++t) {
      const Mat3 j = gauges_[t] * Jacobians(x_.data() + 9 * static_cast<std::size_t>(local_[t]));
      Eigen::Map<RowMajor3> out(z.data() + 9 * t);
      for (int k = 0; k < 3; ++k)
        out.row(k) += (problem_.projectors(t)[static_cast<std::size_t>(k)] * j.row(k).transpose()).transpose();
    }
  }

 private:
  // The pairs of aggregates that share a tet or a face, and where each tet and half-face adds.
  void find_pairs() {
    const TetMesh& mesh = problem_.mesh().local();
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> slot;
    slots_.assign(problem_.mesh().num_owned(), {-1, -1, -1, -1, -1});
    auto slot_of = [&](std::int32_t a, std::int32_t b) {
      const auto [it, fresh] = slot.emplace(std::pair{a, b}, static_cast<std::int32_t>(pairs_.size()));
      if (fresh) pairs_.emplace_back(a, b);
      return it->second;
    };
    for (std::size_t t = 0; t < slots_.size(); ++t) {
      slots_[t][4] = slot_of(local_[t], local_[t]);
      for (int f = 0; f < 4; ++f) {
        const HalfFaceId o = mesh.opposite_half_face(HalfFaceId(TetId(static_cast<std::int64_t>(t)), f));
        if (o.valid()) slots_[t][static_cast<std::size_t>(f)] = slot_of(local_[t], local_[o.tet().index()]);
      }
    }
  }

  // T^T H T of the rows of tet t: with its neighbours (0..3) and with itself (4).
  std::array<solve::Mat9, 5> contributions(std::size_t t) const {
    const TetMesh& mesh = problem_.mesh().local();
    std::array<solve::Mat9, 5> result;
    for (int f = 0; f < 4; ++f) {
      solve::Mat9& part = result[static_cast<std::size_t>(f)];
      part.setZero();
      const HalfFaceId o = mesh.opposite_half_face(HalfFaceId(TetId(static_cast<std::int64_t>(t)), f));
      if (!o.valid()) continue;
      const auto w = problem_.face_weights(t, f);
      const Mat3 q = w.whole * Mat3::Identity() - w.normal * w.n * w.n.transpose();
      const Mat3& m = problem_.matching(t, f);
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l)
          if (m(k, l) != 0) add(t, k, o.tet().index(), l, -m(k, l) * q, part);
    }
    result[4].setZero();
    const solve::Mat9 own = problem_.block(t);
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l) add(t, k, t, l, own.block<3, 3>(3 * k, 3 * l), result[4]);
    return result;
  }

  // Adds the Hessian block between row k of tet s and row l of tet t, seen by their aggregates.
  void add(std::size_t s, int k, std::size_t t, int l, const Mat3& block, solve::Mat9& part) const {
    const Mat3 inner = problem_.projectors(s)[static_cast<std::size_t>(k)] * block *
                       problem_.projectors(t)[static_cast<std::size_t>(l)];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const double factor = gauges_[s](k, i) * gauges_[t](l, j);
        if (factor != 0) part.block<3, 3>(3 * i, 3 * j) += factor * inner;
      }
  }

  const Problem& problem_;
  std::vector<Mat3> gauges_;         // per local tet: J = gauge * combed J
  std::vector<std::int32_t> local_;  // aggregate per local tet, as position among those needed here
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs_;
  std::vector<std::array<std::int32_t, 5>> slots_;
  std::unique_ptr<solve::SparseInverse> inverse_;
  std::vector<double> rhs_, x_;
};

}  // namespace

std::vector<std::int32_t> aggregate_tets(const TetMesh& mesh, const CutGraph& cut, int size) {
  const std::size_t n = mesh.num_tets();
  std::vector<std::int32_t> label(n, -1);
  std::vector<std::vector<TetId>> members;
  // Seeds follow a breadth-first front, so that aggregates are compact and few scraps remain between them.
  std::vector<TetId> order;
  std::vector<char> seen(n, 0);
  for (std::size_t s = 0; s < n; ++s) {
    if (seen[s] != 0) continue;
    seen[s] = 1;
    order.emplace_back(static_cast<std::int64_t>(s));
    for (std::size_t i = order.size() - 1; i < order.size(); ++i)
      for_joined(mesh, cut, order[i], [&](TetId o) {
        if (seen[o.index()] == 0) seen[o.index()] = 1, order.push_back(o);
      });
  }
  for (TetId seed : order) {
    if (label[seed.index()] >= 0) continue;
    const auto id = static_cast<std::int32_t>(members.size());
    std::vector<TetId> group{seed};
    label[seed.index()] = id;
    for (std::size_t i = 0; i < group.size() && group.size() < static_cast<std::size_t>(size); ++i)
      for_joined(mesh, cut, group[i], [&](TetId o) {
        if (label[o.index()] >= 0 || group.size() >= static_cast<std::size_t>(size)) return;
        label[o.index()] = id;
        group.push_back(o);
      });
    members.push_back(std::move(group));
  }
  // Scraps join the first neighbour that is not one.
  for (std::size_t a = 0; a < members.size(); ++a) {
    if (members[a].size() * 3 >= static_cast<std::size_t>(size)) continue;
    std::int32_t host = -1;
    for (TetId t : members[a])
      for_joined(mesh, cut, t, [&](TetId o) {
        const std::int32_t other = label[o.index()];
        if (host < 0 && other != static_cast<std::int32_t>(a)) host = other;
      });
    if (host < 0) continue;
    auto& target = members[static_cast<std::size_t>(host)];
    for (TetId t : members[a]) label[t.index()] = host;
    target.insert(target.end(), members[a].begin(), members[a].end());
    members[a].clear();
  }
  std::vector<std::int32_t> dense(members.size(), -1);
  std::int32_t next = 0;
  for (std::size_t a = 0; a < members.size(); ++a)
    if (!members[a].empty()) dense[a] = next++;
  for (std::int32_t& l : label) l = dense[static_cast<std::size_t>(l)];
  return label;
}

std::unique_ptr<CoarseSpace> aggregate_coarse_space(MPI_Comm comm, const Problem& problem, const CutGraph& cut,
                                                    const std::vector<std::int32_t>& aggregates,
                                                    const IntegrableOptions& options) {
  std::vector<double> data;
  std::int32_t count = 0;
  for (std::size_t t = 0; t < aggregates.size(); ++t) {
    data.push_back(aggregates[t]);
    data.push_back(cut.gauges[t]);
    count = std::max(count, aggregates[t] + 1);
  }
  MPI_Bcast(&count, 1, MPI_INT32_T, 0, comm);
  return std::make_unique<AggregateSpace>(comm, problem, problem.mesh().scatter_tets(data, 2), count, options);
}

}  // namespace hexfield::integrable
