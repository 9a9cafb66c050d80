#include "path_objective.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <tuple>

#include "complex_stars.hpp"
#include "disjoint_sets.hpp"

namespace hexfield::quantize {
namespace {

using octahedral::Label;
using octahedral::Rotation;

constexpr double infinity = std::numeric_limits<double>::infinity();

class PathBuilder {
 public:
  PathBuilder(const BlockComplex& complex, const CriticalSet& critical)
      : complex_(complex), critical_(critical), stars_(complex), seed_(complex.nodes.size(), 0) {}

  std::vector<ObjectivePath> run() {
    choose_seeds();
    grow_cells();
    std::vector<ObjectivePath> paths;
    double sum = 0;
    for (const auto& [key, arcs] : borders()) {
      paths.push_back(path_through(arcs));
      sum += paths.back().weight;
    }
    for (ObjectivePath& p : paths) p.weight = sum > 0 ? p.weight / sum : 0;
    return paths;
  }

 private:
  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }
  double length(std::int32_t arc) const { return complex_.length(index(arc)); }

  void choose_seeds();
  void top_up(const std::vector<std::int32_t>& arcs, std::size_t wanted);
  /// Distance of every node from the seeds, over these arcs or all of them.
  void measure(const std::vector<char>* arcs);
  void grow_cells() { measure(nullptr); }
  std::map<std::int32_t, std::vector<std::int32_t>> borders() const;
  ObjectivePath path_through(const std::vector<std::int32_t>& border) const;
  void add_steps(const std::vector<std::int32_t>& nodes, const std::vector<std::int32_t>& arcs,
                 ObjectivePath& path) const;
  double dual_area(std::int32_t arc) const;

  const BlockComplex& complex_;
  const CriticalSet& critical_;
  ComplexStars stars_;
  std::vector<char> seed_;  // per node
  // Per node, after measure(): distance, the seed it belongs to, the arc towards it.
  std::vector<double> distance_;
  std::vector<std::int32_t> cell_, towards_;
};

// Critical nodes on features and the boundary; then links get at least two, regions four, each time the node that is
// furthest from all seeds, those on singular arcs first.
void PathBuilder::choose_seeds() {
  for (std::size_t n = 0; n < seed_.size(); ++n) {
    if (critical_.nodes[n] == 0) continue;
    bool outer = complex_.nodes[n].feature;
    for (std::int32_t a : stars_.node_arcs[n])
      outer = outer || complex_.arcs[index(a)].boundary || complex_.arcs[index(a)].feature;
    seed_[n] = outer;
  }
  for (const Link& link : critical_.links) top_up(link.arcs, 2);
  for (std::size_t s = critical_.links.size(); s < critical_.statics.size(); ++s) {
    std::vector<std::int32_t> arcs;
    for (const auto& term : critical_.statics[s]) arcs.push_back(term.first);
    top_up(arcs, 4);
  }
}

void PathBuilder::top_up(const std::vector<std::int32_t>& arcs, std::size_t wanted) {
  std::vector<char> used(complex_.arcs.size(), 0);
  std::vector<char> on_singular(complex_.nodes.size(), 0);
  std::vector<std::int32_t> nodes;
  for (std::int32_t a : arcs) {
    used[index(a)] = 1;
    for (std::int32_t n : complex_.arcs[index(a)].nodes) nodes.push_back(n);
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  for (std::int32_t n : nodes)
    for (std::int32_t a : stars_.node_arcs[index(n)])
      if (complex_.arcs[index(a)].singular) on_singular[index(n)] = 1;
  auto have = static_cast<std::size_t>(
      std::count_if(nodes.begin(), nodes.end(), [&](std::int32_t n) { return seed_[index(n)] != 0; }));
  for (; have < std::min(wanted, nodes.size()); ++have) {
    measure(&used);
    std::int32_t furthest = -1;
    const auto rank = [&](std::int32_t n) { return std::pair(on_singular[index(n)], distance_[index(n)]); };
    for (std::int32_t n : nodes)
      if (seed_[index(n)] == 0 && (furthest < 0 || rank(n) > rank(furthest))) furthest = n;
    seed_[index(furthest)] = 1;
  }
}

void PathBuilder::measure(const std::vector<char>* arcs) {
  distance_.assign(complex_.nodes.size(), infinity);
  cell_.assign(complex_.nodes.size(), -1);
  towards_.assign(complex_.nodes.size(), -1);
  using Entry = std::tuple<double, std::int32_t, std::int32_t, std::int32_t>;  // distance, seed, node, arc
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (std::size_t n = 0; n < seed_.size(); ++n)
    if (seed_[n] != 0) queue.emplace(0, static_cast<std::int32_t>(n), static_cast<std::int32_t>(n), -1);
  while (!queue.empty()) {
    const auto [far, seed, node, by] = queue.top();
    queue.pop();
    if (cell_[index(node)] >= 0) continue;
    distance_[index(node)] = far;
    cell_[index(node)] = seed;
    towards_[index(node)] = by;
    for (std::int32_t a : stars_.node_arcs[index(node)])
      if (arcs == nullptr || (*arcs)[index(a)] != 0)
        queue.emplace(far + length(a), seed, other_node(complex_, a, node), a);
  }
}

// Arcs between two cells, those of the same two that share a patch together.
std::map<std::int32_t, std::vector<std::int32_t>> PathBuilder::borders() const {
  const auto pair_of = [&](std::int32_t a) {
    const auto& ends = complex_.arcs[index(a)].nodes;
    return std::minmax(cell_[index(ends[0])], cell_[index(ends[1])]);
  };
  const auto crosses = [&](std::int32_t a) { return pair_of(a).first >= 0 && pair_of(a).first != pair_of(a).second; };
  DisjointSets sets(complex_.arcs.size());
  for (const auto& patch : complex_.patches) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> first;
    for (const auto& side : patch.sides)
      for (std::int32_t a : side) {
        if (!crosses(a)) continue;
        const auto [found, fresh] = first.emplace(pair_of(a), a);
        if (!fresh) sets.unite(found->second, a);
      }
  }
  std::map<std::int32_t, std::vector<std::int32_t>> result;
  for (std::size_t a = 0; a < complex_.arcs.size(); ++a)
    if (crosses(static_cast<std::int32_t>(a)))
      result[sets.find(static_cast<std::int32_t>(a))].push_back(static_cast<std::int32_t>(a));
  return result;
}

ObjectivePath PathBuilder::path_through(const std::vector<std::int32_t>& border) const {
  const auto whole = [&](std::int32_t a) {
    const auto& ends = complex_.arcs[index(a)].nodes;
    return distance_[index(ends[0])] + length(a) + distance_[index(ends[1])];
  };
  std::int32_t best = border[0];
  double area = 0;
  for (std::int32_t a : border) {
    if (whole(a) < whole(best)) best = a;
    area += dual_area(a);
  }
  std::vector<std::int32_t> nodes{complex_.arcs[index(best)].nodes[0]};
  std::vector<std::int32_t> arcs;
  const auto to_seed = [&] {
    while (towards_[index(nodes.back())] >= 0) {
      arcs.push_back(towards_[index(nodes.back())]);
      nodes.push_back(other_node(complex_, arcs.back(), nodes.back()));
    }
  };
  to_seed();
  std::reverse(nodes.begin(), nodes.end());
  std::reverse(arcs.begin(), arcs.end());
  arcs.push_back(best);
  nodes.push_back(complex_.arcs[index(best)].nodes[1]);
  to_seed();
  ObjectivePath path;
  path.weight = area / whole(best);
  add_steps(nodes, arcs, path);
  return path;
}

// Unfolds the path: from arc to arc around their node through as few patches as possible.
void PathBuilder::add_steps(const std::vector<std::int32_t>& nodes, const std::vector<std::int32_t>& arcs,
                            ObjectivePath& path) const {
  struct Reached {
    std::int32_t block;
    Rotation turn;  // start frame -> chart of the block
  };
  std::vector<Reached> reached{{stars_.arc_blocks[index(arcs[0])].front().first, octahedral::identity}};
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    const auto& blocks = stars_.arc_blocks[index(arcs[i])];
    std::size_t k = 0;
    auto here = blocks.end();
    for (; k < reached.size() && here == blocks.end(); ++k) {
      here = std::find_if(blocks.begin(), blocks.end(), [&](const auto& b) { return b.first == reached[k].block; });
      if (here != blocks.end()) break;
      for (std::int32_t p : stars_.node_patches[index(nodes[i])]) {
        const PatchStep next = across(complex_, p, reached[k].block);
        const auto same = [&](const Reached& r) { return r.block == next.block; };
        if (next.block < 0 || std::any_of(reached.begin(), reached.end(), same)) continue;
        reached.push_back({next.block, octahedral::product(next.rotation, reached[k].turn)});
      }
    }
    require(here != blocks.end(), "The blocks around a node of the complex are not connected.");
    const bool forward = complex_.arcs[index(arcs[i])].nodes[0] == nodes[i];
    const Label label = octahedral::image(octahedral::inverse(reached[k].turn),
                                          forward ? here->second : octahedral::negate(here->second));
    path.along[label / 2].emplace_back(arcs[i], (label & 1) != 0 ? -1 : 1);
    reached = {reached[k]};
  }
  for (ArcSum& sum : path.along) sum = sorted_sum(std::move(sum));
}

// Triangles between the middles of the arc, of its blocks and of its patches.
double PathBuilder::dual_area(std::int32_t arc) const {
  double area = 0;
  for (const auto& [b, label] : stars_.arc_blocks[index(arc)]) {
    const auto& block = complex_.blocks[index(b)];
    const auto place = [&](std::int32_t node) {
      const auto found = std::lower_bound(block.nodes.begin(), block.nodes.end(), node,
                                          [](const auto& entry, std::int32_t n) { return entry.first < n; });
      const auto& x = found->second;
      const double unit = std::ldexp(1.0, -complex_.grid_exponent);
      return Vec3(unit * Vec3(static_cast<double>(x[0]), static_cast<double>(x[1]), static_cast<double>(x[2])));
    };
    const auto middle = [&](const std::vector<std::int32_t>& nodes) {
      Vec3 low = place(nodes[0]);
      Vec3 high = low;
      for (std::int32_t n : nodes) low = low.cwiseMin(place(n)), high = high.cwiseMax(place(n));
      return Vec3(0.5 * (low + high));
    };
    std::vector<std::int32_t> corners(block.corners.begin(), block.corners.end());
    const Vec3 centre = middle(corners);
    const Vec3 at = middle({complex_.arcs[index(arc)].nodes[0], complex_.arcs[index(arc)].nodes[1]});
    for (const auto& face : block.faces)
      for (std::int32_t p : face) {
        std::vector<std::int32_t> nodes;
        bool beside = false;
        for (const auto& side : complex_.patches[index(p)].sides)
          for (std::int32_t a : side) {
            beside = beside || a == arc;
            for (std::int32_t n : complex_.arcs[index(a)].nodes) nodes.push_back(n);
          }
        if (beside) area += 0.5 * (centre - at).cross(middle(nodes) - at).norm();
      }
  }
  return area;
}

}  // namespace

std::vector<ObjectivePath> objective_paths(const BlockComplex& complex, const CriticalSet& critical) {
  return PathBuilder(complex, critical).run();
}

}  // namespace hexfield::quantize
