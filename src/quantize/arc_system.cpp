#include "arc_system.hpp"

#include <algorithm>
#include <set>

#include "disjoint_sets.hpp"
#include "reduction.hpp"

namespace hexfield::quantize {
namespace {

std::vector<Link> links_of(const BlockComplex& complex, const CriticalSet& critical) {
  std::vector<std::vector<std::int32_t>> at(complex.nodes.size());
  for (std::size_t a = 0; a < complex.arcs.size(); ++a)
    if (critical.arcs[a] != 0)
      for (std::int32_t n : complex.arcs[a].nodes)
        at[static_cast<std::size_t>(n)].push_back(static_cast<std::int32_t>(a));
  std::vector<Link> links;
  std::vector<char> used(complex.arcs.size(), 0);
  const auto walk = [&](std::int32_t start, std::int32_t arc) {
    Link link{{}, {start}, false};
    for (;;) {
      used[static_cast<std::size_t>(arc)] = 1;
      const auto& ends = complex.arcs[static_cast<std::size_t>(arc)].nodes;
      const std::int32_t next = ends[0] == link.nodes.back() ? ends[1] : ends[0];
      link.arcs.push_back(arc);
      link.nodes.push_back(next);
      if (critical.nodes[static_cast<std::size_t>(next)] != 0) break;
      if (next == start) {
        link.closed = true;
        break;
      }
      const auto& star = at[static_cast<std::size_t>(next)];
      arc = star[0] == arc ? star[1] : star[0];
    }
    links.push_back(std::move(link));
  };
  for (const bool open : {true, false})
    for (std::size_t n = 0; n < at.size(); ++n)
      for (std::int32_t a : at[n])
        if ((!open || critical.nodes[n] != 0) && used[static_cast<std::size_t>(a)] == 0)
          walk(static_cast<std::int32_t>(n), a);
  return links;
}

}  // namespace

ArcSum sorted_sum(ArcSum terms) {
  std::sort(terms.begin(), terms.end());
  ArcSum sum;
  for (const auto& [a, c] : terms) {
    if (!sum.empty() && sum.back().first == a)
      sum.back().second += c;
    else
      sum.emplace_back(a, c);
  }
  std::erase_if(sum, [](const auto& term) { return term.second == 0; });
  return sum;
}

std::int64_t value_of(const ArcSum& sum, const std::vector<std::int64_t>& lengths) {
  std::int64_t total = 0;
  for (const auto& [a, c] : sum) total += c * lengths[static_cast<std::size_t>(a)];
  return total;
}

CriticalSet critical_set(const BlockComplex& complex) {
  CriticalSet critical;
  critical.nodes = critical_nodes(complex);
  for (const auto& arc : complex.arcs) critical.arcs.push_back(arc.singular || arc.feature);
  for (const auto& patch : complex.patches) critical.patches.push_back(patch.feature || patch.blocks[1] < 0);
  critical.links = links_of(complex, critical);
  for (const Link& link : critical.links) {
    ArcSum sum;
    for (std::int32_t a : link.arcs) sum.emplace_back(a, 1);
    critical.statics.push_back(sorted_sum(std::move(sum)));
  }
  // Regions: critical patches connected across arcs that are not.
  DisjointSets sets(complex.patches.size());
  std::vector<std::int32_t> last(complex.arcs.size(), -1);
  const auto for_arcs = [&](std::size_t p, const auto& visit) {
    for (const auto& side : complex.patches[p].sides)
      for (std::int32_t a : side) visit(a);
  };
  for (std::size_t p = 0; p < complex.patches.size(); ++p)
    if (critical.patches[p] != 0)
      for_arcs(p, [&](std::int32_t a) {
        if (critical.arcs[static_cast<std::size_t>(a)] != 0) return;
        std::int32_t& other = last[static_cast<std::size_t>(a)];
        if (other >= 0) sets.unite(other, static_cast<std::int32_t>(p));
        other = static_cast<std::int32_t>(p);
      });
  std::vector<std::set<std::int32_t>> arcs(complex.patches.size());
  for (std::size_t p = 0; p < complex.patches.size(); ++p)
    if (critical.patches[p] != 0)
      for_arcs(p, [&](std::int32_t a) {
        arcs[static_cast<std::size_t>(sets.find(static_cast<std::int32_t>(p)))].insert(a);
      });
  for (const auto& region : arcs) {
    ArcSum sum;
    for (std::int32_t a : region) sum.emplace_back(a, 1);
    if (!sum.empty()) critical.statics.push_back(std::move(sum));
  }
  return critical;
}

ArcSum BundleSystem::on_bundles(const ArcSum& arcs) const {
  ArcSum sum;
  for (const auto& [a, c] : arcs) sum.emplace_back(bundle[static_cast<std::size_t>(a)], c);
  return sorted_sum(std::move(sum));
}

std::vector<std::int64_t> BundleSystem::on_arcs(const std::vector<std::int64_t>& bundles) const {
  std::vector<std::int64_t> lengths;
  for (std::int32_t b : bundle) lengths.push_back(bundles[static_cast<std::size_t>(b)]);
  return lengths;
}

BundleSystem bundle_system(const BlockComplex& complex, double scale) {
  DisjointSets sets(complex.arcs.size());
  for (const auto& patch : complex.patches)
    for (std::size_t k = 0; k < 3; ++k)
      if (patch.sides[2 * k].size() == 1 && patch.sides[2 * k + 1].size() == 1)
        sets.unite(patch.sides[2 * k][0], patch.sides[2 * k + 1][0]);
  BundleSystem system;
  system.bundle.assign(complex.arcs.size(), -1);
  for (std::size_t a = 0; a < complex.arcs.size(); ++a) {
    const auto root = static_cast<std::size_t>(sets.find(static_cast<std::int32_t>(a)));
    if (root == a) {
      system.bundle[a] = static_cast<std::int32_t>(system.size.size());
      system.size.push_back(0);
      system.target.push_back(scale * complex.length(a));
    }
    system.bundle[a] = system.bundle[root];
    system.size[static_cast<std::size_t>(system.bundle[a])] += 1;
  }
  std::set<ArcSum> distinct;
  for (const auto& patch : complex.patches)
    for (std::size_t k = 0; k < 3; ++k) {
      ArcSum sum;
      for (std::int32_t a : patch.sides[2 * k]) sum.emplace_back(a, 1);
      for (std::int32_t a : patch.sides[2 * k + 1]) sum.emplace_back(a, -1);
      ArcSum row = system.on_bundles(sorted_sum(std::move(sum)));
      if (row.empty()) continue;
      if (row[0].second < 0)
        for (auto& term : row) term.second = -term.second;
      if (distinct.insert(row).second) system.equations.push_back(row);
    }
  return system;
}

}  // namespace hexfield::quantize
