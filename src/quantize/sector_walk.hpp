#pragma once

#include <optional>

#include "integer_layout.hpp"
#include "separation.hpp"

namespace hexfield::quantize {

/// The walks of one thread of the separation search (spec-quantization 4.4): from a source, a critical node or link,
/// into one sector of directions, best first.
class SectorWalk {
 public:
  SectorWalk(const BlockComplex& complex, const CriticalSet& critical, const ComplexStars& stars,
             const IntegerLayout& layout, std::int64_t layers);

  /// The first coincidence of a critical node with what is reached by leaving it along an arc.
  std::optional<Separation> from_node(std::int32_t node, std::int32_t arc);
  /// That of a link with what is reached by leaving it on the side of a patch at its first arc; none where the patch
  /// does not bound that arc.
  std::optional<Separation> from_link(const Link& link, std::int32_t patch);

 private:
  using Label = octahedral::Label;
  using Rotation = octahedral::Rotation;
  using Integer3 = BlockComplex::Integer3;
  struct Place {
    std::int32_t node, block;
    Rotation turn;    // start frame -> chart of the block
    Integer3 offset;  // of the node in the start frame
  };
  struct Step {
    std::int32_t arc, before;  // before: index into steps_, -1 at the start
    Label label;               // in the start frame
  };
  struct State {
    double walked;
    int count;
    std::int64_t serial;
    Place place;
    std::int32_t last;  // step
    bool operator>(const State& o) const {
      if (walked != o.walked) return walked > o.walked;
      return count != o.count ? count > o.count : serial > o.serial;
    }
  };
  struct Reached {
    std::int32_t block;
    Rotation turn;
  };
  struct Source {
    IntegerBox box;
    unsigned axes = 0;  // mask of the axes along which it extends
    Label leaves = 0;
  };

  void start();
  void widen(Source& source) const;
  void leave(const Source& source, const Place& from, std::int32_t arc, Label label);
  void search(const Source& source);
  void flood(const Source& source, const Place& at, std::vector<Reached>& reached) const;
  void flood_sector(const Place& at, Label leaves, std::vector<Reached>& reached) const;
  bool violated(const Source& source, const State& state, const std::vector<Reached>& reached);
  bool report(const Source& source, const State& state, unsigned hit_axes);
  IntegerBox in_block(const Source& source, const Place& at, const Reached& r) const;
  /// Whether a walk may go on over this arc: the steps in the first direction only add up, and must stay below the
  /// number of layers for any coincidence.
  bool stays_close(const Source& source, std::int32_t arc, Label label, const Place& at) const {
    if (label != source.leaves) return true;
    const std::int64_t walked = at.offset[static_cast<std::size_t>(octahedral::axis(label))];
    return ((label & 1) != 0 ? -walked : walked) + layout_.length(arc) < layers_;
  }
  Place follow(const Place& at, const Reached& r, std::int32_t arc, Label label) const;
  /// Arcs of a block at a node, with the direction away from the node in the start frame.
  template <class Visit>
  void arcs_at(std::int32_t node, const Reached& r, const Visit& visit) const;

  const BlockComplex& complex_;
  const CriticalSet& critical_;
  const ComplexStars& stars_;
  const IntegerLayout& layout_;
  std::int64_t layers_;
  std::vector<State> queue_;  // a heap
  std::vector<Step> steps_;
  std::int64_t serial_ = 0;
  std::vector<std::int32_t> expanded_;  // per node: sector in which it was
  std::int32_t sector_ = 0;
  std::optional<Separation> found_;
};

}  // namespace hexfield::quantize
