#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <set>

#include "hexfield/base/error.hpp"
#include "hexfield/hex/cut_table.hpp"
#include "support/hex_meshes.hpp"

using namespace hexfield;
using namespace hexfield::testing;

namespace {

SphereTriangulation node(const std::string& name) {
  auto triangles = eight_nodes().at(name);
  int n = 0;
  for (auto& t : triangles)
    for (int& v : t) n = std::max(n, v--);
  return sphere_from_triangles(n, triangles);
}

// A triangulation with n vertices by random insertions, its vertices shuffled.
SphereTriangulation random_sphere(int n, int max_degree, std::mt19937& random) {
  SphereTriangulation sphere = node("(4,0,0)");
  while (sphere.size() < n) {
    auto triangles = sphere.triangles();
    const int v = static_cast<int>(random() % sphere.rings.size());
    const auto& ring = sphere.rings[static_cast<std::size_t>(v)];
    const std::size_t k = random() % ring.size();
    const std::size_t removed = random() % 3;
    if (removed + 2 > ring.size()) continue;
    std::vector<int> hole{v};
    for (std::size_t i = 0; i <= removed + 1; ++i) hole.push_back(ring[(k + i) % ring.size()]);
    std::erase_if(triangles, [&](const auto& t) {
      for (std::size_t i = 1; i + 1 < hole.size(); ++i) {
        std::array<int, 3> a = t;
        std::array<int, 3> b{v, hole[i], hole[i + 1]};
        std::sort(a.begin(), a.end());
        std::sort(b.begin(), b.end());
        if (a == b) return true;
      }
      return false;
    });
    for (std::size_t i = 0; i < hole.size(); ++i)
      triangles.push_back({hole[i], hole[(i + 1) % hole.size()], sphere.size()});
    SphereTriangulation next;
    std::string reason;
    if (try_sphere_from_triangles(sphere.size() + 1, triangles, next, reason) && next.max_degree() <= max_degree)
      sphere = next;
  }
  std::vector<int> name(static_cast<std::size_t>(n));
  std::iota(name.begin(), name.end(), 0);
  std::shuffle(name.begin(), name.end(), random);
  auto triangles = sphere.triangles();
  const bool mirror = random() % 2 == 0;
  for (auto& t : triangles) {
    for (int& v : t) v = name[static_cast<std::size_t>(v)];
    if (mirror) std::swap(t[1], t[2]);
  }
  return sphere_from_triangles(n, triangles);
}

// Applies general cuts until no degree is above 5; checks that each makes less.
int cut_down(const SphereTriangulation& sphere) {
  if (sphere.max_degree() <= 5) return 0;
  const SphereSplit halves = split(sphere, general_cut(sphere));
  const bool smaller = halves.left.size() < sphere.size() && halves.right.size() < sphere.size();
  const bool base = halves.left.max_degree() <= 5 && halves.right.max_degree() <= 5;
  EXPECT_TRUE(smaller || (base && signature_text(sphere) == "(3,0,3,1)")) << canonical_code(sphere);
  return 1 + (smaller || base ? cut_down(halves.left) + cut_down(halves.right) : 0);
}

}  // namespace

TEST(Sphere, NumbersOfTypesAreThoseKnown) {
  const auto all = all_sphere_triangulations(9);
  std::vector<std::size_t> count;
  for (const auto& types : all) count.push_back(types.size());
  EXPECT_EQ(count, (std::vector<std::size_t>{1, 1, 2, 5, 14, 50}));
}

TEST(Sphere, ElevenTypesHaveValences345) {
  std::map<std::string, VertexType> found;
  for (const auto& sphere : types_of_valence_345()) found[signature_text(sphere)] = vertex_type(sphere);
  EXPECT_EQ(found.size(), 11u);
  EXPECT_EQ(found.at("(0,6,0)"), VertexType::regular);
  EXPECT_EQ(found.at("(2,3,0)"), VertexType::curve);
  EXPECT_EQ(found.at("(0,5,2)"), VertexType::curve);
  for (const auto& [name, triangles] : eight_nodes()) EXPECT_EQ(found.at(name), VertexType::node) << name;
}

TEST(Sphere, OrdersOfTheAutomorphismGroups) {
  const std::map<std::string, std::size_t> orders{{"(4,0,0)", 24}, {"(2,2,2)", 4},  {"(0,4,4)", 8},  {"(1,3,3)", 6},
                                                  {"(0,3,6)", 12}, {"(0,2,8)", 16}, {"(2,0,6)", 12}, {"(0,0,12)", 120}};
  for (const auto& [name, order] : orders) EXPECT_EQ(automorphisms(node(name)).size(), order) << name;
}

TEST(Sphere, CodesAreThoseOfTheTypeWhateverTheNumbering) {
  std::mt19937 random(5);
  const SphereTriangulation sphere = random_sphere(14, 8, random);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<int> name(14);
    std::iota(name.begin(), name.end(), 0);
    std::shuffle(name.begin(), name.end(), random);
    auto triangles = sphere.triangles();
    for (auto& t : triangles)
      for (int& v : t) v = name[static_cast<std::size_t>(v)];
    const SphereTriangulation other = sphere_from_triangles(14, triangles);
    EXPECT_EQ(canonical_code(other), canonical_code(sphere));
    const auto map = isomorphism(sphere, other);
    ASSERT_EQ(map.size(), 14u);
    for (int v = 0; v < 14; ++v)
      for (int w : sphere.rings[static_cast<std::size_t>(v)])
        EXPECT_TRUE(other.has_edge(map[static_cast<std::size_t>(v)], map[static_cast<std::size_t>(w)]));
  }
  EXPECT_EQ(canonical_code(sphere_from_code(canonical_code(sphere))), canonical_code(sphere));
}

TEST(Sphere, NumbersOfCycles) {
  const std::map<std::string, std::size_t> counts{{"(4,0,0)", 7},   {"(2,2,2)", 54},    {"(0,4,4)", 363},
                                                  {"(1,3,3)", 141}, {"(0,3,6)", 885},   {"(0,2,8)", 2139},
                                                  {"(2,0,6)", 306}, {"(0,0,12)", 12878}};
  for (const auto& [name, count] : counts) EXPECT_EQ(simple_cycles(node(name), 12).size(), count) << name;
}

TEST(Sphere, HalvesOfASplitHaveTheRightSizes) {
  const SphereTriangulation sphere = node("(0,3,6)");
  for (const auto& cycle : simple_cycles(sphere, 9)) {
    const SphereSplit halves = split(sphere, cycle);
    const int n = static_cast<int>(cycle.size());
    EXPECT_EQ(halves.left.size() + halves.right.size(), sphere.size() + n + 2);
    for (const auto* half : {&halves.left, &halves.right}) {
      EXPECT_EQ(sphere_from_triangles(half->size(), half->triangles()).size(), half->size());
      EXPECT_EQ(half->degree(half->size() - 1), n);
    }
  }
}

TEST(Sphere, RefusesWhatIsNoSphere) {
  EXPECT_THROW(sphere_from_triangles(4, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}}), Error);
  EXPECT_THROW(sphere_from_triangles(3, {{0, 1, 2}, {0, 2, 1}}), Error);  // degree 2
  EXPECT_THROW(sphere_from_triangles(4, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 2, 3}}), Error);
}

TEST(CutTable, RowsOfTheEightNodes) {
  struct Wanted {
    int splits_to_5;
    std::size_t cycles;
  };
  const std::map<std::string, Wanted> wanted{{"(4,0,0)", {1, 3}},  {"(2,2,2)", {1, 1}},  {"(0,4,4)", {1, 1}},
                                             {"(1,3,3)", {2, 6}},  {"(0,3,6)", {3, 6}},  {"(0,2,8)", {5, 12}},
                                             {"(2,0,6)", {5, 15}}, {"(0,0,12)", {9, 40}}};
  for (const auto& [name, row] : wanted) {
    const SphereTriangulation sphere = node(name);
    EXPECT_EQ(cut_table().at(canonical_code(sphere)).splits_to_5, row.splits_to_5) << name;
    const auto cycles = table_cycles(cut_table(), sphere);
    EXPECT_EQ(cycles.size(), row.cycles) << name;
    for (const auto& cycle : cycles) {
      const SphereSplit halves = split(sphere, cycle);
      EXPECT_EQ(1 + cut_table().at(canonical_code(halves.left)).splits_to_5 +
                    cut_table().at(canonical_code(halves.right)).splits_to_5,
                row.splits_to_5);
    }
  }
  EXPECT_EQ(cut_table().at(canonical_code(node("(2,0,6)"))).splits_to_6, 4);
  EXPECT_EQ(cut_table().at(canonical_code(node("(0,0,12)"))).splits_to_6, 8);
}

TEST(CutTable, IsWhatTheSearchGives) {
  EXPECT_EQ(to_text(cut_table()), to_text(make_cut_table(types_of_valence_345())));
}

TEST(GeneralCut, AppliesToAllTypesUpToTenVertices) {
  int pairs = 0;
  for (const auto& types : all_sphere_triangulations(10))
    for (const auto& sphere : types)
      if (sphere.max_degree() >= 6) pairs += cut_down(sphere) > 0 ? 1 : 0;
  EXPECT_EQ(pairs, 1 + 1 + 2 + 5 + 14 + 50 + 233 - 10);  // all but those of valences 3, 4 and 5
}

TEST(GeneralCut, AppliesToRandomTypesUpToTwentyVertices) {
  std::mt19937 random(11);
  int cuts = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const int n = 11 + trial % 10;
    cuts += cut_down(random_sphere(n, 9, random));
  }
  EXPECT_GT(cuts, 1000);
}
