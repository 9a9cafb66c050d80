#include "separation.hpp"

#include <algorithm>
#include <optional>

#include "hexfield/base/parallel.hpp"
#include "sector_walk.hpp"

namespace hexfield::quantize {
namespace {

/// Sectors that one task searches.
constexpr std::size_t grain = 32;

/// A sector of directions of a source: an arc that leaves a node, or a patch beside a link.
struct Sector {
  const Link* link;  ///< nullptr: a node
  std::int32_t node;
  std::int32_t way;  ///< arc or patch
};

}  // namespace

SeparationSearch::SeparationSearch(const BlockComplex& complex, const CriticalSet& critical)
    : complex_(complex), critical_(critical), stars_(complex) {}

std::vector<Separation> SeparationSearch::run(const std::vector<std::int64_t>& lengths, std::int64_t layers) const {
  const IntegerLayout layout(complex_, lengths);
  const auto is_short = [&](std::int32_t arc) { return layout.length(arc) < layers; };
  std::vector<Sector> sectors;
  for (std::size_t n = 0; n < complex_.nodes.size(); ++n)
    if (critical_.nodes[n] != 0)
      for (std::int32_t a : stars_.node_arcs[n])
        if (is_short(a)) sectors.push_back({nullptr, static_cast<std::int32_t>(n), a});
  for (const Link& link : critical_.links) {
    // No arc that leaves the link is short enough to lead to anything close.
    if (std::none_of(link.nodes.begin(), link.nodes.end(), [&](std::int32_t n) {
          const auto& arcs = stars_.node_arcs[static_cast<std::size_t>(n)];
          return std::any_of(arcs.begin(), arcs.end(), is_short);
        }))
      continue;
    for (std::int32_t p : stars_.node_patches[static_cast<std::size_t>(link.nodes[0])])
      sectors.push_back({&link, link.nodes[0], p});
  }
  std::vector<std::optional<Separation>> found(sectors.size());
  parallel_for(sectors.size(), grain, [&](std::size_t begin, std::size_t end) {
    SectorWalk walk(complex_, critical_, stars_, layout, layers);
    for (std::size_t s = begin; s < end; ++s) {
      const Sector& sector = sectors[s];
      found[s] =
          sector.link != nullptr ? walk.from_link(*sector.link, sector.way) : walk.from_node(sector.node, sector.way);
    }
  });
  std::vector<Separation> separations;
  for (auto& one : found)
    if (one) separations.push_back(std::move(*one));
  return separations;
}

}  // namespace hexfield::quantize
