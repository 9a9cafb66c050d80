#include "hexfield/hex/decompose.hpp"

#include <gtest/gtest.h>

#include "hexfield/hex/check.hpp"
#include "hexfield/hex/improve.hpp"
#include "hexfield/hex/sheet.hpp"
#include "support/hex_meshes.hpp"

using namespace hexfield;
using namespace hexfield::testing;

namespace {

void place_free(HexMesh& mesh) { improve_free_hex_mesh(mesh, {}, {}); }

}  // namespace

TEST(Decompose, TheEightNodesInNoMoreSheetsThanKnown) {
  const std::map<std::string, std::size_t> most{{"(4,0,0)", 1}, {"(2,2,2)", 1}, {"(0,4,4)", 1}, {"(1,3,3)", 2},
                                                {"(0,3,6)", 3}, {"(0,2,8)", 5}, {"(2,0,6)", 5}, {"(0,0,12)", 6}};
  const std::map<std::string, std::map<int, int>> curves{{"(4,0,0)", {{3, 2}}},         {"(2,2,2)", {{3, 1}, {5, 1}}},
                                                         {"(0,4,4)", {{5, 2}}},         {"(1,3,3)", {{3, 1}, {5, 2}}},
                                                         {"(0,3,6)", {{5, 3}}},         {"(0,2,8)", {{5, 4}}},
                                                         {"(2,0,6)", {{3, 2}, {5, 4}}}, {"(0,0,12)", {{5, 6}}}};
  for (const auto& [name, sheets] : most) {
    int meshes = 0;
    const auto settle = [&](HexMesh& mesh) {
      place_free(mesh);
      for (const auto& violation : check(mesh)) ADD_FAILURE() << name << ": " << violation.sentence;
      ++meshes;
    };
    const Decomposition done = decompose(node_mesh(name), {}, settle, {});
    EXPECT_LE(done.steps.size(), sheets) << name;
    EXPECT_EQ(static_cast<std::size_t>(meshes), done.steps.size());
    EXPECT_EQ(done.measure, 0) << name;
    EXPECT_TRUE(done.nodes_left.empty()) << name;
    const HexComplex complex = build_hex_complex(done.mesh);
    EXPECT_EQ(curves_by_valence(hex_singular_graph(done.mesh, complex)), curves.at(name)) << name;
    EXPECT_TRUE(check_for_sheets(done.mesh, complex).empty()) << name;
  }
}

TEST(Decompose, PaddedCubeLosesItsNodes) {
  const HexMesh cube = hex_grid({2, 2, 2});
  const HexMesh padded = pad(cube, build_hex_complex(cube));
  const Decomposition done = decompose(padded, {}, {}, {});
  EXPECT_EQ(done.measure_before, 8);
  EXPECT_EQ(done.measure, 0);
  EXPECT_TRUE(done.nodes_left.empty());
  EXPECT_LE(done.steps.size(), 8u);
  const HexComplex complex = build_hex_complex(done.mesh);
  EXPECT_TRUE(check_for_sheets(done.mesh, complex).empty());
  EXPECT_EQ(done.mesh.feature_points.size(), 8u);
}

TEST(Decompose, GreedySearchOfThePaperDoesASingleNode) {
  DecomposeOptions options;
  options.search = DecomposeOptions::Search::greedy;
  for (const char* name : {"(4,0,0)", "(2,2,2)", "(0,4,4)", "(1,3,3)"}) {
    const Decomposition done = decompose(node_mesh(name), options, {}, {});
    EXPECT_EQ(done.measure, 0) << name;
  }
}

TEST(Decompose, ANodeHeldByAFeatureSurfaceIsReportedWithProof) {
  HexMesh mesh = node_mesh("(4,0,0)");
  const HexComplex complex = build_hex_complex(mesh);
  for (const auto& quad : complex.quads)
    if (complex.find_quad(quad) >= 0 && !complex.is_boundary_quad(complex.find_quad(quad)))
      mesh.feature_quads.push_back({quad, 1});
  const Decomposition done = decompose(mesh, {}, {}, {});
  EXPECT_TRUE(done.steps.empty());
  ASSERT_EQ(done.nodes_left.size(), 1u);
  EXPECT_EQ(done.nodes_left[0].signature, "(4,0,0)");
  EXPECT_TRUE(done.proven);
}

TEST(MaximiseMinimum, ReachesTheBoundOfANode) {
  const std::map<std::string, double> bounds{{"(4,0,0)", 0.7698}, {"(0,4,4)", 0.9079}, {"(0,0,12)", 0.7608}};
  for (const auto& [name, bound] : bounds) {
    HexMesh mesh = node_mesh(name);
    ASSERT_GT(quality(mesh).min, 0) << name;
    maximise_minimum(mesh, {}, {});
    EXPECT_NEAR(quality(mesh).min, bound, 0.002) << name;
  }
}

TEST(MaximiseMinimum, KeepsTheBoundaryWhenTold) {
  HexMesh mesh = hex_grid({3, 3, 3});
  mesh.points[21] += Vec3(0.3, 0.2, -0.3);
  const HexMesh before = mesh;
  const double least = quality(mesh).min;
  MaximiseOptions options;
  options.free_boundary = false;
  maximise_minimum(mesh, options, {});
  EXPECT_GT(quality(mesh).min, std::max(least, 0.99));
  const HexComplex complex = build_hex_complex(mesh);
  for (int v = 0; v < 64; ++v)
    if (complex.is_boundary_vertex(v)) {
      EXPECT_EQ(mesh.points[static_cast<std::size_t>(v)], before.points[static_cast<std::size_t>(v)]);
    }
}
