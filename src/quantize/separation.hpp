#pragma once

#include <optional>

#include "arc_system.hpp"
#include "complex_stars.hpp"
#include "integer_layout.hpp"

namespace hexfield::quantize {

/// Critical entities that integer lengths put in one place though the map keeps them apart, found by walking from
/// every critical node and link (spec-quantization 4.4).
struct Separation {
  ArcSum cut;            ///< must be at least the number of layers
  ArcSum positive_only;  ///< the part over axes walked one way; also positive in the map
  std::int32_t node;     ///< where the walk ended
};

class SeparationSearch {
 public:
  SeparationSearch(const BlockComplex& complex, const CriticalSet& critical);

  /// First coincidence of every sector of every source; lengths satisfy the equations of all patches. With more than
  /// one layer also the first entity that is closer than so many.
  std::vector<Separation> run(const std::vector<std::int64_t>& lengths, std::int64_t layers = 1);

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

  void widen(Source& source) const;
  void from_node(std::int32_t node, std::int32_t arc);
  void from_link(const Link& link, std::int32_t patch);
  void leave(const Source& source, const Place& from, std::int32_t arc, Label label);
  void search(const Source& source);
  void flood(const Source& source, const Place& at, std::vector<Reached>& reached) const;
  void flood_sector(const Place& at, Label leaves, std::vector<Reached>& reached) const;
  bool violated(const Source& source, const State& state, const std::vector<Reached>& reached);
  bool report(const Source& source, const State& state, unsigned hit_axes);
  IntegerBox in_block(const Source& source, const Place& at, const Reached& r) const;
  Place follow(const Place& at, const Reached& r, std::int32_t arc, Label label) const;
  /// Arcs of a block at a node, with the direction away from the node in the start frame.
  template <class Visit>
  void arcs_at(std::int32_t node, const Reached& r, const Visit& visit) const;

  const BlockComplex& complex_;
  const CriticalSet& critical_;
  ComplexStars stars_;
  std::optional<IntegerLayout> layout_;
  std::int64_t layers_ = 1;
  std::vector<State> queue_;  // a heap
  std::vector<Step> steps_;
  std::int64_t serial_ = 0;
  std::vector<std::int32_t> expanded_;  // per node: sector in which it was
  std::int32_t sector_ = 0;
  std::vector<Separation> found_;
};

}  // namespace hexfield::quantize
