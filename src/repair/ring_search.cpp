#include "hexfield/repair/ring_search.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "hexfield/field/edge_codes.hpp"
#include "hexfield/repair/state_ops.hpp"

namespace hexfield {
namespace {

using octahedral::Label;

const double through_limit = std::cos(100 * M_PI / 180);
const double parallel_limit = std::cos(45 * M_PI / 180);

struct Step {
  TetId tet;
  Label label;
  int parent;          // -1 at the start
  HalfFaceId through;  // of the parent
};

// Steps are free when there are too few arcs to confuse two of them.
bool steps_are_free(const OneRing& ring, const Spoke& start, RingTarget target) {
  int quarter = 0, in_region = 0;
  std::set<int> regions;
  for (TetId t : start.tets) regions.insert(ring.region(t));
  for (const Spoke& s : ring.spokes()) {
    quarter += std::abs(s.code) == 1;
    in_region += s.free_arc() && regions.contains(ring.region(s.tets.front()));
  }
  return quarter <= 2 || in_region <= (target == RingTarget::surface_arc ? 1 : 2);
}

class Search {
 public:
  Search(const RepairState& state, const OneRing& ring, const RingQuery& query, bool free_steps)
      : state_(state),
        ring_(ring),
        query_(query),
        start_(*ring.spoke(query.start)),
        free_(free_steps),
        seen_(6 * ring.tets().size(), 0) {}

  std::vector<RingPath> run() {
    if (start_.labels.empty()) return {};
    for (std::size_t k = 0; k < start_.tets.size(); ++k) {
      const Label out = start_.labels[k];
      visit({start_.tets[k], query_.flow == Flow::through ? octahedral::negate(out) : out, -1, HalfFaceId()});
    }
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      find_targets(static_cast<int>(i));
      const Step step = steps_[i];
      for (int f = 0; f < 4; ++f) {
        const HalfFaceId h(step.tet, f);
        if (state_.mesh.vertices(step.tet)[static_cast<std::size_t>(f)] == ring_.centre()) continue;
        if (state_.mesh.is_boundary(h) || !admissible(h, step.label)) continue;
        visit(
            {state_.mesh.opposite_half_face(h).tet(), transport(state_.field, h, step.label), static_cast<int>(i), h});
      }
    }
    return std::move(paths_);
  }

 private:
  void visit(const Step& step) {
    char& seen = seen_[static_cast<std::size_t>(6 * ring_.index(step.tet) + step.label)];
    if (seen == 0) steps_.push_back(step);
    seen = 1;
  }

  double along(HalfFaceId h, Label label) const {
    return outward_normal(state_.mesh, h).dot(ring_.axis(h.tet(), label));
  }

  bool admissible(HalfFaceId h, Label label) const {
    if (is_feature_face(state_, h)) {
      if (!query_.cross_surfaces) return false;
      const Label normal = closest_label(ring_.frame(h.tet()), outward_normal(state_.mesh, h));
      if (query_.flow == Flow::through ? normal != label : octahedral::axis(normal) == octahedral::axis(label))
        return false;
    }
    if (free_) return true;
    return query_.flow == Flow::through ? along(h, label) >= through_limit : along(h, label) <= parallel_limit;
  }

  bool wanted(const Spoke& s) const {
    if (s.end == start_.end || s.code == compound_code || s.labels.empty()) return false;
    if (query_.target == RingTarget::free_arc && !s.free_arc()) return false;
    if (query_.target == RingTarget::surface_arc && !s.in_surface && !s.feature) return false;
    if (query_.any_code) return true;
    if (s.code == 0) return false;
    return s.code == undetermined_code || s.code == (query_.flow == Flow::through ? start_.code : -start_.code);
  }

  void find_targets(int i) {
    const Step& step = steps_[static_cast<std::size_t>(i)];
    if (query_.target == RingTarget::surface) {
      for (int f = 0; f < 4; ++f) find_exit(i, HalfFaceId(step.tet, f));
      return;
    }
    for (const auto& [place, label] : ring_.labels_at(ring_.index(step.tet))) {
      const Spoke& s = ring_.spokes()[place];
      if (label != step.label || reached_.contains(s.end) || !wanted(s)) continue;
      if (add(i, s.end, HalfFaceId())) reached_.insert(s.end);
    }
  }

  void find_exit(int i, HalfFaceId h) {
    const Step& step = steps_[static_cast<std::size_t>(i)];
    if (!state_.mesh.is_boundary(h) || !state_.mesh.has_vertex(step.tet, ring_.centre())) return;
    if (state_.mesh.vertices(step.tet)[static_cast<std::size_t>(h.local())] == ring_.centre()) return;
    const Label normal = closest_label(ring_.frame(step.tet), outward_normal(state_.mesh, h));
    const bool leaves = query_.flow == Flow::through ? normal == step.label && along(h, step.label) >= 0
                                                     : normal == octahedral::negate(step.label);
    if (leaves && !exits_.contains(h) && add(i, VertexId(), h)) exits_.insert(h);
  }

  bool add(int i, VertexId to, HalfFaceId exit) {
    RingPath path;
    path.from = start_.end;
    path.to = to;
    path.exit = exit;
    for (int k = i; k >= 0; k = steps_[static_cast<std::size_t>(k)].parent) {
      const Step& step = steps_[static_cast<std::size_t>(k)];
      path.tets.push_back(step.tet);
      if (step.parent >= 0) path.faces.push_back(step.through);
    }
    std::reverse(path.tets.begin(), path.tets.end());
    std::reverse(path.faces.begin(), path.faces.end());
    if (std::set<TetId>(path.tets.begin(), path.tets.end()).size() != path.tets.size()) return false;
    paths_.push_back(std::move(path));
    return true;
  }

  const RepairState& state_;
  const OneRing& ring_;
  const RingQuery& query_;
  const Spoke& start_;
  bool free_;
  std::vector<char> seen_;  // per tet and label
  std::vector<Step> steps_;
  std::set<VertexId> reached_;
  std::set<HalfFaceId> exits_;
  std::vector<RingPath> paths_;
};

// Boundary faces ordered by what their surface sector can spare or needs (spec-lmff section 5.3).
void prefer_exits(const RepairState& state, const OneRing& ring, EdgeCode code, std::vector<RingPath>& paths) {
  std::map<HalfFaceId, int> quads;
  bool wide = false;
  for (const SurfaceSector& s : surface_sectors(state, ring)) {
    wide = wide || s.quads == 3;
    for (HalfFaceId h : s.faces) quads[h] = s.quads;
  }
  auto of = [&](const RingPath& p) {
    const auto found = quads.find(p.exit);
    return found == quads.end() ? 4 : found->second;
  };
  if (code > 0) {  // takes a quad from the sector it enters
    std::erase_if(paths, [&](const RingPath& p) { return of(p) <= 1 || (wide && of(p) == 2); });
  } else {
    std::stable_sort(paths.begin(), paths.end(), [&](const RingPath& a, const RingPath& b) { return of(a) < of(b); });
  }
}

}  // namespace

std::vector<RingPath> find_ring_paths(const RepairState& state, const OneRing& ring, const RingQuery& query) {
  const Spoke* start = ring.spoke(query.start);
  if (start == nullptr) return {};
  RingQuery search = query;
  bool free = steps_are_free(ring, *start, query.target);
  if (query.target == RingTarget::surface && query.flow == Flow::parallel) {
    free = true;
  }
  auto paths = Search(state, ring, search, free).run();
  if (query.target == RingTarget::surface) prefer_exits(state, ring, start->code, paths);
  return paths;
}

std::vector<ParabolicSector> parabolic_sectors(const RepairState& state, const OneRing& ring) {
  std::set<ParabolicSector> found;
  for (const Spoke& s : ring.spokes()) {
    RingQuery query;
    query.flow = Flow::parallel;
    query.start = s.end;
    query.target = RingTarget::any_edge;
    query.any_code = true;
    for (const RingPath& p : Search(state, ring, query, false).run())
      found.insert({std::min(p.from, p.to), std::max(p.from, p.to)});
  }
  for (const SurfaceSector& s : surface_sectors(state, ring))
    if (s.quads <= 0) found.insert({std::min(s.first, s.last), std::max(s.first, s.last)});
  return {found.begin(), found.end()};
}

}  // namespace hexfield
