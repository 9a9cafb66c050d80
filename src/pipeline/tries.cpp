#include "tries.hpp"

#include <array>

namespace hexfield {
namespace {

constexpr std::size_t few_tets = 8000;

using Change = void (*)(TrySetting&);
struct Variation {
  const char* name;
  Change apply;
};

constexpr std::array<Variation, 5> variations = {{
    {"default", [](TrySetting&) {}},
    {"input refined once", [](TrySetting& s) { s.refined_input = true; }},
    {"alignment weight 1", [](TrySetting& s) { s.repair.alignment_weight = 1; }},
    {"more iterations before free zipper nodes", [](TrySetting& s) { s.repair.first_iterations += 8; }},
    {"alignment weight 100", [](TrySetting& s) { s.repair.alignment_weight = 100; }},
}};

}  // namespace

TrySetting try_setting(const RepairOptions& options, int attempt, std::size_t input_tets) {
  std::size_t index = static_cast<std::size_t>(attempt);
  if (input_tets > few_tets && index > 0) ++index;  // no refinement
  const Variation& variation = variations[index % variations.size()];
  TrySetting setting{variation.name, options};
  variation.apply(setting);
  return setting;
}

}  // namespace hexfield
