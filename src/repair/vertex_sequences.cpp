#include <algorithm>
#include <tuple>

#include "hexfield/repair/one_ring.hpp"
#include "hexfield/repair/state_ops.hpp"

#include "vertex_score.hpp"

/// Sequences of vertex operations (Liu and Bommes 2023 section 4.4: all parabolic sectors of a node are resolved one
/// after the other). Where several features force parabolic sectors on a node, no single operation makes it
/// meshable, and some that are needed make a parabolic sector of an arc that only the next one resolves.
namespace hexfield {
namespace {

// What tells two states of a vertex apart: quads of feature edges and surface sectors, arcs and parabolic sectors.
using Signature =
    std::tuple<std::vector<std::pair<VertexId, EdgeCode>>, std::vector<std::tuple<VertexId, VertexId, int>>,
               std::vector<EdgeCode>, std::vector<std::pair<VertexId, VertexId>>>;

Signature signature_of(RepairState& state, VertexId v) {
  const OneRing ring(state, v);
  auto feature_end = [&](VertexId end) {
    const Spoke* spoke = end.valid() ? ring.spoke(end) : nullptr;
    return spoke != nullptr && spoke->feature ? end : VertexId();
  };
  Signature s;
  auto& [features, quads, arcs, parabolic] = s;
  for (const Spoke& spoke : ring.spokes())
    if (spoke.feature)
      features.emplace_back(spoke.end, spoke.code);
    else
      arcs.push_back(spoke.code);
  for (const SurfaceSector& sector : surface_sectors(state, ring))
    quads.emplace_back(feature_end(sector.first), feature_end(sector.last), sector.quads);
  for (const ParabolicSector& p : parabolic_sectors(state, ring))
    parabolic.emplace_back(feature_end(p.first), feature_end(p.second));
  std::sort(quads.begin(), quads.end());
  std::sort(arcs.begin(), arcs.end());
  std::sort(parabolic.begin(), parabolic.end());
  return s;
}

struct Candidate {
  RepairState state;
  VertexScore score;
  int steps = 0;
  std::size_t number = 0;  // in the order of discovery
};

bool before(const Candidate& a, const Candidate& b) {
  return std::tie(a.score.empty, a.score.sectors, a.score.edges, a.steps, a.number) <
         std::tie(b.score.empty, b.score.sectors, b.score.edges, b.steps, b.number);
}

class Sequences {
 public:
  Sequences(RepairState& local, VertexId v, const VertexRepairOptions& options)
      : v_(v), options_(options), near_(near_of(local.mesh, v)), local_(local) {}

  bool run() {
    Candidate root{local_, {}, 0, 0};
    isolate_star(root.state, v_);
    invalid_ = score_near(root.state, v_, near_).invalid;
    seen_.insert(signature_of(root.state, v_));
    open_.push_back(std::move(root));
    for (int step = 0; step < options_.search_steps && !open_.empty() && !found_; ++step) expand();
    return found_;
  }

 private:
  void expand() {
    const auto best = std::min_element(open_.begin(), open_.end(), before);
    const Candidate from = std::move(*best);
    open_.erase(best);
    for (const VertexOperation& operation : sequence_operations(from.state, v_)) {
      RepairState trial = from.state;
      trial.begin_operation(trial.mesh.num_tets());
      operation(trial, v_, [&](RepairState& state) {
        consider(state, from.steps + 1);
        return found_;
      });
      if (found_) return;
    }
  }

  void consider(RepairState& state, int steps) {
    state.begin_operation(work_of_judging * state.mesh.num_tets());
    const Signature signature = signature_of(state, v_);
    if (!seen_.insert(signature).second) return;
    VertexScore score = score_near(state, v_, near_);
    score.sectors = std::get<3>(signature).size();
    if (score.invalid > invalid_) return;
    const auto& quads = std::get<1>(signature);
    score.empty = std::ranges::count_if(quads, [](const auto& q) { return std::get<2>(q) < 1; });
    if (score.empty == 0 && !needs_repair(state, v_, options_)) {
      local_ = state;
      found_ = true;
      return;
    }
    if (steps < options_.rounds) open_.push_back({state, score, steps, ++number_});
  }

  VertexId v_;
  const VertexRepairOptions& options_;
  Near near_;
  RepairState& local_;
  int invalid_ = 0;
  bool found_ = false;
  std::size_t number_ = 0;
  std::set<Signature> seen_;
  std::vector<Candidate> open_;
};

}  // namespace

bool repair_by_sequence(RepairState& local, VertexId v, const VertexRepairOptions& options) {
  return Sequences(local, v, options).run();
}

}  // namespace hexfield
