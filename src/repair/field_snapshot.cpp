#include "hexfield/repair/field_snapshot.hpp"

#include <algorithm>

#include "hexfield/repair/state_ops.hpp"

namespace hexfield {
namespace {

// What `from` holds of these edges.
template <class Container>
Container part_of(const Container& from, std::span<const EdgeKey> edges) {
  Container part;
  for (const EdgeKey& e : edges)
    if (const auto found = from.find(e); found != from.end()) part.insert(part.end(), *found);
  return part;
}

template <class Container>
void put_back(Container& into, std::span<const EdgeKey> edges, const Container& part) {
  for (const EdgeKey& e : edges) into.erase(e);
  into.insert(part.begin(), part.end());
}

}  // namespace

FieldSnapshot::FieldSnapshot(const RepairState& state, std::span<const TetId> tets)
    : tets_(tets.begin(), tets.end()), edges_(edges_of(state.mesh, tets)) {
  std::sort(tets_.begin(), tets_.end());
  for (TetId t : tets_) {
    frames_.push_back(state.field.frames[t.index()]);
    matchings_.push_back(state.field.matchings[t.index()]);
  }
  codes_ = part_of(state.codes, edges_);
  pairs_ = part_of(state.pairs, edges_);
  kept_ = part_of(state.kept, edges_);
}

void FieldSnapshot::restore(RepairState& state) const {
  for (std::size_t i = 0; i < tets_.size(); ++i) {
    state.field.frames[tets_[i].index()] = frames_[i];
    state.field.matchings[tets_[i].index()] = matchings_[i];
  }
  put_back(state.codes, edges_, codes_);
  put_back(state.pairs, edges_, pairs_);
  put_back(state.kept, edges_, kept_);
}

EdgeCode FieldSnapshot::code(const EdgeKey& edge) const {
  const auto found = codes_.find(edge);
  return found == codes_.end() ? 0 : found->second;
}

}  // namespace hexfield
