#include "complex_stars.hpp"

namespace hexfield::quantize {

ComplexStars::ComplexStars(const BlockComplex& complex)
    : node_patches(complex.nodes.size()), node_arcs(complex.nodes.size()), arc_blocks(complex.arcs.size()) {
  for (std::size_t a = 0; a < complex.arcs.size(); ++a)
    for (std::int32_t n : complex.arcs[a].nodes)
      node_arcs[static_cast<std::size_t>(n)].push_back(static_cast<std::int32_t>(a));
  for (std::size_t p = 0; p < complex.patches.size(); ++p)
    for (const auto& side : complex.patches[p].sides)
      for (std::int32_t a : side)
        for (std::int32_t n : complex.arcs[static_cast<std::size_t>(a)].nodes) {
          auto& patches = node_patches[static_cast<std::size_t>(n)];
          if (patches.empty() || patches.back() != static_cast<std::int32_t>(p))
            patches.push_back(static_cast<std::int32_t>(p));
        }
  for (std::size_t b = 0; b < complex.blocks.size(); ++b)
    for (const auto& [arc, label] : complex.blocks[b].arcs)
      arc_blocks[static_cast<std::size_t>(arc)].emplace_back(static_cast<std::int32_t>(b), label);
}

PatchStep across(const BlockComplex& complex, std::int32_t patch, std::int32_t block) {
  const auto& p = complex.patches[static_cast<std::size_t>(patch)];
  if (p.blocks[1] < 0 || (p.blocks[0] != block && p.blocks[1] != block)) return {};
  if (p.blocks[0] == block) return {p.blocks[1], p.rotation};
  return {p.blocks[0], octahedral::inverse(p.rotation)};
}

}  // namespace hexfield::quantize
