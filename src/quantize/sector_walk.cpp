#include "sector_walk.hpp"

#include <algorithm>
#include <functional>

namespace hexfield::quantize {
namespace {

constexpr std::int64_t unbounded = std::int64_t{1} << 40;

template <class List>
bool contains(const List& list, std::int32_t x) {
  return std::find(list.begin(), list.end(), x) != list.end();
}

template <class Reached>
bool holds(const std::vector<Reached>& reached, std::int32_t block) {
  return std::any_of(reached.begin(), reached.end(), [&](const Reached& r) { return r.block == block; });
}

}  // namespace

SectorWalk::SectorWalk(const BlockComplex& complex, const CriticalSet& critical, const ComplexStars& stars,
                       const IntegerLayout& layout, std::int64_t layers)
    : complex_(complex),
      critical_(critical),
      stars_(stars),
      layout_(layout),
      layers_(layers),
      expanded_(complex.nodes.size(), -1) {}

template <class Visit>
void SectorWalk::arcs_at(std::int32_t node, const Reached& r, const Visit& visit) const {
  const Rotation back = octahedral::inverse(r.turn);
  for (std::int32_t a : stars_.node_arcs[static_cast<std::size_t>(node)])
    for (const auto& [block, label] : stars_.arc_blocks[static_cast<std::size_t>(a)]) {
      if (block != r.block) continue;
      const bool forward = complex_.arcs[static_cast<std::size_t>(a)].nodes[0] == node;
      visit(a, octahedral::image(back, forward ? label : octahedral::negate(label)));
      break;
    }
}

void SectorWalk::start() {
  queue_.clear();
  steps_.clear();
  serial_ = 0;
  ++sector_;
  found_.reset();
}

// The entities to be found are those closer than the number of layers.
void SectorWalk::widen(Source& source) const {
  for (std::size_t k = 0; k < 3; ++k) {
    source.box.low[k] -= layers_ - 1;
    source.box.high[k] += layers_ - 1;
  }
}

std::optional<Separation> SectorWalk::from_node(std::int32_t node, std::int32_t arc) {
  const auto [block, label] = stars_.arc_blocks[static_cast<std::size_t>(arc)].front();
  Source source;
  widen(source);
  source.leaves = complex_.arcs[static_cast<std::size_t>(arc)].nodes[0] == node ? label : octahedral::negate(label);
  start();
  leave(source, {node, block, octahedral::identity, {}}, arc, source.leaves);
  search(source);
  return std::move(found_);
}

// The sector of the patch at the first arc of the link: marches along the link and leaves on every arc that goes
// the way of the patch.
std::optional<Separation> SectorWalk::from_link(const Link& link, std::int32_t patch) {
  const auto& p = complex_.patches[static_cast<std::size_t>(patch)];
  const auto side =
      std::find_if(p.sides.begin(), p.sides.end(), [&](const auto& arcs) { return contains(arcs, link.arcs[0]); });
  if (side == p.sides.end()) return std::nullopt;
  Source source;
  source.leaves = octahedral::negate(static_cast<Label>(side - p.sides.begin()));
  Place at{link.nodes[0], p.blocks[0], octahedral::identity, {}};
  Label along = 0;
  arcs_at(at.node, {at.block, at.turn}, [&](std::int32_t a, Label label) {
    if (a == link.arcs[0]) along = label;
  });
  std::int64_t length = 0;
  for (std::int32_t a : link.arcs) length += layout_.length(a);
  source.axes = 1U << octahedral::axis(along);
  source.box.add(step(along, link.closed ? unbounded : length));
  if (link.closed) source.box.add(step(along, -unbounded));
  widen(source);
  start();
  std::vector<Reached> reached;
  for (std::size_t i = 0; i < link.nodes.size(); ++i) {
    flood_sector(at, source.leaves, reached);
    std::vector<std::int32_t> left;
    std::optional<Place> next;
    for (const Reached& r : reached)
      arcs_at(at.node, r, [&](std::int32_t a, Label label) {
        if (label == source.leaves && !contains(left, a)) {
          left.push_back(a);
          if (stays_close(source, a, label, at)) leave(source, {at.node, r.block, r.turn, at.offset}, a, label);
        }
        if (!next && i < link.arcs.size() && a == link.arcs[i] && label == along) next = follow(at, r, a, label);
      });
    if (!next) break;
    at = *next;
  }
  search(source);
  return std::move(found_);
}

SectorWalk::Place SectorWalk::follow(const Place& at, const Reached& r, std::int32_t arc, Label label) const {
  Place next{other_node(complex_, arc, at.node), r.block, r.turn, at.offset};
  const Integer3 d = step(label, layout_.length(arc));
  for (std::size_t k = 0; k < 3; ++k) next.offset[k] += d[k];
  return next;
}

void SectorWalk::leave(const Source& source, const Place& from, std::int32_t arc, Label label) {
  steps_.push_back({arc, -1, label});
  const double walked =
      (source.axes >> octahedral::axis(label) & 1U) != 0 ? 0 : complex_.length(static_cast<std::size_t>(arc));
  queue_.push_back({walked, 1, serial_++, follow(from, {from.block, from.turn}, arc, label),
                    static_cast<std::int32_t>(steps_.size() - 1)});
  std::push_heap(queue_.begin(), queue_.end(), std::greater<>());
}

void SectorWalk::search(const Source& source) {
  std::vector<Reached> reached;
  while (!queue_.empty()) {
    std::pop_heap(queue_.begin(), queue_.end(), std::greater<>());
    const State state = queue_.back();
    queue_.pop_back();
    if (std::exchange(expanded_[static_cast<std::size_t>(state.place.node)], sector_) == sector_) continue;
    flood(source, state.place, reached);
    if (violated(source, state, reached)) return;
    std::vector<std::int32_t> taken;
    for (const Reached& r : reached) {
      if (!layout_.cuboid(r.block).meets(in_block(source, state.place, r))) continue;
      arcs_at(state.place.node, r, [&](std::int32_t a, Label label) {
        if (label == octahedral::negate(source.leaves) || contains(taken, a)) return;
        if (a == steps_[static_cast<std::size_t>(state.last)].arc) return;
        if (!stays_close(source, a, label, state.place)) return;
        taken.push_back(a);
        const Place next = follow(state.place, r, a, label);
        if (expanded_[static_cast<std::size_t>(next.node)] == sector_) return;
        steps_.push_back({a, state.last, label});
        const bool across = (source.axes >> octahedral::axis(label) & 1U) == 0;
        queue_.push_back({state.walked + (across ? complex_.length(static_cast<std::size_t>(a)) : 0), state.count + 1,
                          serial_++, next, static_cast<std::int32_t>(steps_.size() - 1)});
        std::push_heap(queue_.begin(), queue_.end(), std::greater<>());
      });
    }
  }
}

// The source's box in the chart of a block around the place.
IntegerBox SectorWalk::in_block(const Source& source, const Place& at, const Reached& r) const {
  return moved(rotate(r.turn, moved(source.box, at.offset, -1)), layout_.place(r.block, at.node));
}

void SectorWalk::flood(const Source& source, const Place& at, std::vector<Reached>& reached) const {
  reached.assign(1, {at.block, at.turn});
  for (std::size_t k = 0; k < reached.size(); ++k) {
    const Reached here = reached[k];
    const IntegerBox box = in_block(source, at, here);
    for (std::int32_t p : stars_.node_patches[static_cast<std::size_t>(at.node)]) {
      const PatchStep next = across(complex_, p, here.block);
      if (next.block < 0 || holds(reached, next.block)) continue;
      if (!layout_.rectangle(here.block, p).meets(box)) continue;
      reached.push_back({next.block, octahedral::product(next.rotation, here.turn)});
    }
  }
}

// Blocks around the half-line that leaves the node in a direction of the start frame.
void SectorWalk::flood_sector(const Place& at, Label leaves, std::vector<Reached>& reached) const {
  reached.assign(1, {at.block, at.turn});
  for (std::size_t k = 0; k < reached.size(); ++k) {
    const Reached here = reached[k];
    const Label label = octahedral::image(here.turn, leaves);
    const auto axis = static_cast<std::size_t>(octahedral::axis(label));
    const Integer3& x = layout_.real_place(here.block, at.node);
    for (std::int32_t p : stars_.node_patches[static_cast<std::size_t>(at.node)]) {
      const PatchStep next = across(complex_, p, here.block);
      if (next.block < 0 || holds(reached, next.block)) continue;
      const auto& patch = complex_.patches[static_cast<std::size_t>(p)];
      bool extends = false;
      for (const auto& side : patch.sides)
        for (std::int32_t a : side)
          for (std::int32_t n : complex_.arcs[static_cast<std::size_t>(a)].nodes) {
            const std::int64_t d = layout_.real_place(here.block, n)[axis] - x[axis];
            extends = extends || ((label & 1) != 0 ? d < 0 : d > 0);
          }
      if (!extends) continue;
      reached.push_back({next.block, octahedral::product(next.rotation, here.turn)});
    }
  }
}

bool SectorWalk::violated(const Source& source, const State& state, const std::vector<Reached>& reached) {
  const Place& at = state.place;
  const IntegerBox point{at.offset, at.offset};
  if (critical_.nodes[static_cast<std::size_t>(at.node)] != 0 && point.meets(source.box) && report(source, state, 0))
    return true;
  for (const Reached& r : reached) {
    bool hit = false;
    arcs_at(at.node, r, [&](std::int32_t a, Label label) {
      if (hit || critical_.arcs[static_cast<std::size_t>(a)] == 0) return;
      IntegerBox interval = point;
      interval.add(follow(at, r, a, label).offset);
      hit = interval.meets(source.box) && report(source, state, 1U << octahedral::axis(label));
    });
    if (hit) return true;
    for (std::int32_t p : stars_.node_patches[static_cast<std::size_t>(at.node)]) {
      const auto& patch = complex_.patches[static_cast<std::size_t>(p)];
      if (critical_.patches[static_cast<std::size_t>(p)] == 0) continue;
      if (patch.blocks[0] != r.block && patch.blocks[1] != r.block) continue;
      const Label normal =
          octahedral::image(octahedral::inverse(r.turn), patch.normals[patch.blocks[0] == r.block ? 0 : 1]);
      const unsigned tangential = 7U & ~(1U << octahedral::axis(normal));
      if (layout_.rectangle(r.block, p).meets(in_block(source, at, r)) && report(source, state, tangential))
        return true;
    }
  }
  return false;
}

// Adds the cut along the walk to the state unless the first direction belongs to the hit entity.
bool SectorWalk::report(const Source& source, const State& state, unsigned hit_axes) {
  const unsigned excluded = source.axes | hit_axes;
  if ((excluded >> octahedral::axis(source.leaves) & 1U) != 0) return false;
  std::array<bool, 6> walked{};
  std::array<std::int64_t, 3> net{};
  for (std::int32_t s = state.last; s >= 0; s = steps_[static_cast<std::size_t>(s)].before) {
    const Step& step_taken = steps_[static_cast<std::size_t>(s)];
    walked[step_taken.label] = true;
    const std::int64_t length = complex_.arcs[static_cast<std::size_t>(step_taken.arc)].length;
    net[step_taken.label / 2] += (step_taken.label & 1) != 0 ? -length : length;
  }
  ArcSum all, one_way;
  for (std::int32_t s = state.last; s >= 0; s = steps_[static_cast<std::size_t>(s)].before) {
    const Step& step_taken = steps_[static_cast<std::size_t>(s)];
    const auto axis = static_cast<std::size_t>(step_taken.label / 2);
    if ((excluded >> axis & 1U) != 0) continue;
    if (walked[2 * axis] && walked[2 * axis + 1]) {
      if (net[axis] == 0) continue;
      all.emplace_back(step_taken.arc, ((step_taken.label & 1) != 0) == (net[axis] < 0) ? 1 : -1);
    } else {
      all.emplace_back(step_taken.arc, 1);
      one_way.emplace_back(step_taken.arc, 1);
    }
  }
  all = sorted_sum(std::move(all));
  std::int64_t apart = 0;
  for (const auto& [arc, sign] : all) apart += sign * layout_.length(arc);
  if (apart >= layers_) return false;
  found_ = {std::move(all), sorted_sum(std::move(one_way)), state.place.node};
  return true;
}

}  // namespace hexfield::quantize
