#include "quad_classes.hpp"

#include <algorithm>

#include "hex_topology.hpp"

namespace hexfield::hex {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

IncidenceLists lists_of(std::vector<std::pair<int, int>>& pairs, std::size_t lists) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  IncidenceLists out;
  out.first.assign(lists + 1, 0);
  for (const auto& [list, entry] : pairs) {
    ++out.first[at(list) + 1];
    out.entries.push_back(entry);
  }
  for (std::size_t k = 0; k < lists; ++k) out.first[k + 1] += out.first[k];
  return out;
}

// The quad at a regular edge that shares no hex with `q`.
int opposite(const HexComplex& complex, int edge, int q) {
  const auto& mine = complex.quad_hexes[at(q)];
  for (int other : complex.edge_quads[edge]) {
    const auto& theirs = complex.quad_hexes[at(other)];
    if (mine[0] != theirs[0] && mine[0] != theirs[1] && mine[1] != theirs[0] && mine[1] != theirs[1]) return other;
  }
  return -1;
}

// Vertices where one straight curve of quads is not all that can pass.
std::vector<char> special_vertices(const HexComplex& complex, const std::vector<int>& bends) {
  std::vector<char> special(complex.num_vertices(), 0);
  std::vector<char> inner(complex.num_vertices(), 0);
  for (std::size_t e = 0; e < complex.edges.size(); ++e) {
    const int id = static_cast<int>(e);
    for (int v : complex.edges[e]) {
      if (complex.is_boundary_edge(id)) {
        if (complex.valence(id) > 2) special[at(v)] = 1;
      } else if (complex.is_singular(id) || (complex.is_boundary_vertex(v) && ++inner[at(v)] > 1)) {
        special[at(v)] = 1;
      }
    }
  }
  for (int e : bends)
    for (int v : complex.edges[at(e)]) special[at(v)] = 1;
  return special;
}

}  // namespace

QuadClasses build_quad_classes(const HexComplex& complex, const std::vector<int>& feature_quads,
                               const std::vector<int>& bends) {
  const auto straight = [&](int e) {
    return !complex.is_boundary_edge(e) && complex.valence(e) == 4 &&
           !std::binary_search(bends.begin(), bends.end(), e);
  };
  QuadClasses out;
  DisjointSets sets(complex.quads.size());
  std::vector<std::array<int, 4>> crossings;  // the two pairs at each regular edge
  for (std::size_t k = 0; k < complex.edges.size(); ++k) {
    const int e = static_cast<int>(k);
    if (!straight(e)) continue;
    const auto quads = complex.edge_quads[e];
    const int mate = opposite(complex, e, quads[0]);
    std::array<int, 4> pairs{quads[0], mate, -1, -1};
    for (int q : quads)
      if (q != quads[0] && q != mate) pairs[pairs[2] < 0 ? 2 : 3] = q;
    sets.join(at(pairs[0]), at(pairs[1]));
    sets.join(at(pairs[2]), at(pairs[3]));
    crossings.push_back(pairs);
  }
  out.class_of.assign(complex.quads.size(), -1);
  int n = 0;
  for (std::size_t q = 0; q < complex.quads.size(); ++q) {
    if (complex.is_boundary_quad(static_cast<int>(q))) continue;
    const std::size_t root = sets.find(q);
    out.class_of[q] = root == q ? n++ : out.class_of[root];
  }
  out.usable.assign(at(n), 1);
  for (int q : feature_quads)
    if (out.class_of[at(q)] >= 0) out.usable[at(out.class_of[at(q)])] = 0;
  std::vector<std::pair<int, int>> conflicts;
  const auto exclude = [&](int a, int b) {
    if (a == b) {
      out.usable[at(a)] = 0;
    } else {
      conflicts.emplace_back(a, b);
      conflicts.emplace_back(b, a);
    }
  };
  for (const auto& pairs : crossings) exclude(out.class_of[at(pairs[0])], out.class_of[at(pairs[2])]);
  std::vector<std::pair<int, int>> rims;
  for (std::size_t k = 0; k < complex.edges.size(); ++k) {
    const int e = static_cast<int>(k);
    std::vector<int> here;
    if (straight(e)) continue;
    for (int q : complex.edge_quads[e])
      if (!complex.is_boundary_quad(q)) here.push_back(out.class_of[at(q)]);
    std::sort(here.begin(), here.end());
    for (std::size_t i = 0; i < here.size(); ++i) {
      if (!complex.is_boundary_edge(e)) {
        rims.emplace_back(here[i], e);
        if (i >= 2 && here[i] == here[i - 2]) out.usable[at(here[i])] = 0;
      } else {
        for (std::size_t j = 0; j < i; ++j) exclude(here[i], here[j]);
      }
    }
  }
  std::vector<std::pair<int, int>> members;
  std::vector<std::pair<int, int>> special;
  const std::vector<char> is_special = special_vertices(complex, bends);
  for (std::size_t q = 0; q < complex.quads.size(); ++q) {
    if (out.class_of[q] < 0) continue;
    members.emplace_back(out.class_of[q], static_cast<int>(q));
    for (int v : complex.quads[q])
      if (is_special[at(v)] != 0) special.emplace_back(out.class_of[q], v);
  }
  out.quads = lists_of(members, at(n));
  out.conflicts = lists_of(conflicts, at(n));
  out.rims = lists_of(rims, at(n));
  out.special = lists_of(special, at(n));
  return out;
}

}  // namespace hexfield::hex
