#include <algorithm>
#include <limits>
#include <set>

#include "hexfield/base/error.hpp"
#include "hexfield/hex/cut_table.hpp"

namespace hexfield {
namespace {

constexpr int unknown = std::numeric_limits<int>::max() / 4;

struct Option {
  std::size_t left;
  std::size_t right;
  std::vector<int> cycle;  ///< a representative
  bool operator<(const Option& o) const { return std::tie(left, right) < std::tie(o.left, o.right); }
};

struct Type {
  std::string code;
  SphereTriangulation sphere;  ///< numbered as in the code
  std::vector<Option> options;
  int to_5 = unknown;
  int to_6 = unknown;
};

std::vector<int> normal_form(std::vector<int> cycle) {
  std::rotate(cycle.begin(), std::min_element(cycle.begin(), cycle.end()), cycle.end());
  if (cycle[1] > cycle.back()) std::reverse(cycle.begin() + 1, cycle.end());
  return cycle;
}

std::vector<int> image(const std::vector<int>& cycle, const std::vector<int>& map) {
  std::vector<int> out;
  for (int v : cycle) out.push_back(map[static_cast<std::size_t>(v)]);
  return normal_form(std::move(out));
}

// All types that splits reach from some, and the least number of splits for each.
class SplitSearch {
 public:
  explicit SplitSearch(const CutLimits& limits) : limits_(limits) {}

  std::size_t add(const SphereTriangulation& sphere) {
    std::string code = canonical_code(sphere);
    const auto [entry, fresh] = numbers_.try_emplace(code, types_.size());
    if (fresh) {
      Type type;
      type.sphere = sphere_from_code(code);
      type.code = std::move(code);
      if (vertex_type(sphere) != VertexType::node) {
        type.to_5 = sphere.max_degree() <= 5 ? 0 : unknown;
        type.to_6 = sphere.max_degree() <= 6 ? 0 : unknown;
      }
      types_.push_back(std::move(type));
    }
    return entry->second;
  }

  void close() {
    for (std::size_t t = 0; t < types_.size(); ++t) {
      const SphereTriangulation sphere = types_[t].sphere;
      if (types_[t].to_5 != 0) find_options(t, sphere);
    }
  }

  void relax() {
    for (bool changed = true; changed;) {
      changed = false;
      for (Type& type : types_)
        for (const Option& option : type.options) {
          changed |= lower(type.to_5, 1 + types_[option.left].to_5 + types_[option.right].to_5);
          changed |= lower(type.to_6, 1 + types_[option.left].to_6 + types_[option.right].to_6);
        }
    }
  }

  // Rows of all types that splits make curves.
  CutTable table() const {
    CutTable out;
    for (const Type& type : types_) {
      if (type.to_5 >= unknown) continue;
      CutRow& row = out[type.code];
      row.splits_to_5 = type.to_5;
      row.splits_to_6 = type.to_6;
      if (type.to_5 > 0) row.cycles = best_cycles(type);
    }
    return out;
  }

 private:
  static bool lower(int& value, int candidate) {
    if (candidate >= value) return false;
    value = candidate;
    return true;
  }
  bool within(const SphereTriangulation& sphere) const {
    return sphere.size() <= limits_.max_vertices && sphere.max_degree() <= limits_.max_valence;
  }

  void find_options(std::size_t t, const SphereTriangulation& sphere) {
    std::set<Option> options;
    for (const auto& cycle : simple_cycles(sphere, limits_.max_valence)) {
      const SphereSplit halves = split(sphere, cycle);
      if (!within(halves.left) || !within(halves.right)) continue;
      const std::size_t a = add(halves.left);
      const std::size_t b = add(halves.right);
      if (a != t && b != t) options.insert({std::min(a, b), std::max(a, b), cycle});
    }
    types_[t].options.assign(options.begin(), options.end());
  }

  std::vector<std::vector<int>> best_cycles(const Type& type) const {
    const auto maps = automorphisms(type.sphere);
    std::set<std::vector<int>> orbits;
    for (const auto& cycle : simple_cycles(type.sphere, limits_.max_valence)) {
      const SphereSplit halves = split(type.sphere, cycle);
      if (!within(halves.left) || !within(halves.right)) continue;
      const int left = types_[numbers_.at(canonical_code(halves.left))].to_5;
      const int right = types_[numbers_.at(canonical_code(halves.right))].to_5;
      if (1 + left + right != type.to_5) continue;
      std::vector<int> least = cycle;
      for (const auto& map : maps) least = std::min(least, image(cycle, map));
      orbits.insert(least);
    }
    return {orbits.begin(), orbits.end()};
  }

  CutLimits limits_;
  std::map<std::string, std::size_t> numbers_;
  std::vector<Type> types_;
};

}  // namespace

CutTable make_cut_table(const std::vector<SphereTriangulation>& types, const CutLimits& limits) {
  SplitSearch search(limits);
  for (const auto& sphere : types) search.add(sphere);
  search.close();
  search.relax();
  return search.table();
}

std::vector<SphereTriangulation> types_of_valence_345() {
  std::vector<SphereTriangulation> out;
  // 12 vertices at most: the sum of 6 - degree is 12. All types of 12 vertices are many, the icosahedron is known.
  for (const auto& same_size : all_sphere_triangulations(10))
    for (const auto& sphere : same_size)
      if (sphere.max_degree() <= 5) out.push_back(sphere);
  std::vector<std::array<int, 3>> icosahedron;
  for (int k = 0; k < 5; ++k) {
    const int next = (k + 1) % 5;
    icosahedron.push_back({0, 1 + k, 1 + next});
    icosahedron.push_back({1 + next, 1 + k, 6 + k});
    icosahedron.push_back({1 + next, 6 + k, 6 + next});
    icosahedron.push_back({11, 6 + next, 6 + k});
  }
  out.push_back(sphere_from_triangles(12, icosahedron));
  return out;
}

std::vector<std::vector<int>> table_cycles(const CutTable& table, const SphereTriangulation& sphere) {
  const auto row = table.find(canonical_code(sphere));
  if (row == table.end()) return {};
  const std::vector<int> to = isomorphism(sphere_from_code(row->first), sphere);
  const auto maps = automorphisms(sphere);
  std::set<std::vector<int>> out;
  for (const auto& cycle : row->second.cycles)
    for (const auto& map : maps) out.insert(image(image(cycle, to), map));
  return {out.begin(), out.end()};
}

}  // namespace hexfield
