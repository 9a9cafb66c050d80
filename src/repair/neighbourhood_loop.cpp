#include "hexfield/repair/neighbourhood_loop.hpp"

#include <algorithm>
#include <memory>

#include "hexfield/base/parallel.hpp"

namespace hexfield {
namespace {

bool alive(const TetMesh& mesh, const Place& place) {
  return std::all_of(place.seeds.begin(), place.seeds.end(),
                     [&](VertexId v) { return mesh.vertex_tet[v.index()].valid(); });
}

// Which tets of the parent belong to a place of the present round; grows with the mesh.
class Claims {
 public:
  void begin_round(std::size_t tets) {
    ++round_;
    claimed_.resize(tets, 0);
  }
  bool taken(std::span<const TetId> tets) const {
    return std::any_of(tets.begin(), tets.end(), [&](TetId t) { return claimed_[t.index()] == round_; });
  }
  bool claim(std::span<const TetId> footprint) {
    if (taken(footprint)) return false;
    for (TetId t : footprint) claimed_[t.index()] = round_;
    return true;
  }

 private:
  std::vector<int> claimed_;
  int round_ = 0;
};

// Region and shell of a place: what its copy will hold.
std::vector<TetId> footprint(const RepairState& state, const Place& place) {
  return tets_around(state.mesh, place.seeds, place.rings + 1);
}

struct Task {
  std::size_t place;
  std::unique_ptr<Neighbourhood> copy;
  bool changed = false;
};

void work(const RepairState& state, const Place& place, const LocalOperation& operation, Task& task) {
  const std::vector<TetId> region = tets_around(state.mesh, place.seeds, place.rings);
  state.begin_operation(region.size());
  task.copy = std::make_unique<Neighbourhood>(state, region);
  std::vector<VertexId> seeds;
  for (VertexId v : place.seeds) seeds.push_back(task.copy->to_local(v));
  task.changed = operation(*task.copy, seeds);
}

}  // namespace

std::vector<char> for_places(RepairState& state, std::span<const Place> places, const LocalOperation& operation) {
  std::vector<char> commits(places.size(), 0);
  std::vector<std::size_t> waiting(places.size());
  for (std::size_t i = 0; i < waiting.size(); ++i) waiting[i] = i;
  Claims claims;
  while (!waiting.empty() && !state.exhausted()) {
    claims.begin_round(state.mesh.num_tets());
    std::vector<Task> tasks;
    std::vector<std::size_t> later;
    for (std::size_t i : waiting) {
      if (!alive(state.mesh, places[i])) continue;
      // Looking at the stars of the seeds alone spares most of the crowded places their footprints.
      if (!claims.taken(tets_around(state.mesh, places[i].seeds, 0)) && claims.claim(footprint(state, places[i])))
        tasks.push_back({i, nullptr});
      else
        later.push_back(i);
    }
    parallel_for(tasks.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) work(state, places[tasks[k].place], operation, tasks[k]);
    });
    for (const Task& task : tasks) {
      if (!task.changed) continue;
      task.copy->commit(state);
      commits[task.place] = 1;
    }
    waiting.swap(later);
  }
  return commits;
}

}  // namespace hexfield
