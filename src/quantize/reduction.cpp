#include "reduction.hpp"

#include <algorithm>
#include <set>

namespace hexfield::quantize {

std::vector<char> critical_nodes(const BlockComplex& complex) {
  struct Count {
    int singular = 0, feature = 0, either = 0;
  };
  std::vector<Count> count(complex.nodes.size());
  for (const auto& arc : complex.arcs)
    for (std::int32_t n : arc.nodes) {
      Count& c = count[static_cast<std::size_t>(n)];
      c.singular += arc.singular;
      c.feature += arc.feature;
      c.either += arc.singular || arc.feature;
    }
  std::vector<char> critical(complex.nodes.size(), 0);
  for (std::size_t n = 0; n < count.size(); ++n) {
    const Count& c = count[n];
    critical[n] = complex.nodes[n].feature || (c.singular != 0 && c.singular != 2) ||
                  (c.feature != 0 && c.feature != 2) || (c.either != 0 && c.either != 2);
  }
  return critical;
}

std::vector<std::int32_t> removable_patches(const BlockComplex& complex) {
  const std::vector<char> critical = critical_nodes(complex);
  std::vector<std::int32_t> order;
  for (std::size_t p = 0; p < complex.patches.size(); ++p) {
    const auto& patch = complex.patches[p];
    if (patch.feature || patch.blocks[1] < 0 || patch.blocks[0] == patch.blocks[1]) continue;
    bool alone = true;
    for (std::size_t s = 0; s < 2; ++s)
      alone = alone && complex.blocks[static_cast<std::size_t>(patch.blocks[s])].faces[patch.normals[s]].size() == 1;
    if (!alone) continue;
    bool needed = false;
    std::set<std::int32_t> nodes;
    for (const auto& side : patch.sides)
      for (std::int32_t a : side) {
        const auto& arc = complex.arcs[static_cast<std::size_t>(a)];
        needed = needed || arc.singular || arc.feature;
        for (std::int32_t n : arc.nodes) {
          needed = needed || critical[static_cast<std::size_t>(n)] != 0;
          nodes.insert(n);
        }
      }
    if (needed) continue;
    // Nodes that both blocks have beyond the patch would be met twice by their union.
    const auto& here = complex.blocks[static_cast<std::size_t>(patch.blocks[0])].nodes;
    const auto& there = complex.blocks[static_cast<std::size_t>(patch.blocks[1])].nodes;
    bool twice = false;
    for (auto i = here.begin(), j = there.begin(); i != here.end() && j != there.end();) {
      if (i->first == j->first) twice = twice || !nodes.contains(i->first);
      if (i->first <= j->first)
        ++i;
      else
        ++j;
    }
    if (!twice) order.push_back(static_cast<std::int32_t>(p));
  }
  std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    return complex.patches[static_cast<std::size_t>(a)].distance >
           complex.patches[static_cast<std::size_t>(b)].distance;
  });
  std::vector<char> used(complex.blocks.size(), 0);
  std::vector<std::int32_t> chosen;
  for (std::int32_t p : order) {
    const auto& blocks = complex.patches[static_cast<std::size_t>(p)].blocks;
    const auto first = static_cast<std::size_t>(blocks[0]);
    const auto second = static_cast<std::size_t>(blocks[1]);
    if (used[first] != 0 || used[second] != 0) continue;
    used[first] = used[second] = 1;
    chosen.push_back(p);
  }
  return chosen;
}

}  // namespace hexfield::quantize
