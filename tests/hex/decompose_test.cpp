#include "hexfield/hex/decompose.hpp"

#include <gtest/gtest.h>

#include "hexfield/base/parallel.hpp"
#include "hexfield/hex/check.hpp"
#include "hexfield/hex/hex_surface.hpp"
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
      return true;
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

TEST(Decompose, IsProvenOnlyWhenNothingWasLeftOut) {
  HexMesh mesh = node_mesh("(4,0,0)");
  const HexComplex complex = build_hex_complex(mesh);
  for (const auto& quad : complex.quads)
    if (!complex.is_boundary_quad(complex.find_quad(quad))) mesh.feature_quads.push_back({quad, 1});
  DecomposeOptions greedy;
  greedy.search = DecomposeOptions::Search::greedy;
  EXPECT_FALSE(decompose(mesh, greedy, {}, {}).proven);
  DecomposeOptions none;
  none.budget = 0;
  const Decomposition untried = decompose(mesh, none, {}, {});
  EXPECT_FALSE(untried.proven);
  EXPECT_TRUE(untried.limits.contains("patches tried"));
  // Too few tries for each seed and too little work for the integer program.
  DecomposeOptions little;
  little.seed_budget = 0;
  little.work = 1;
  const Decomposition cut_short = decompose(node_mesh("(0,3,6)"), little, {}, {});
  EXPECT_FALSE(cut_short.proven);
  if (cut_short.measure > 0) {
    EXPECT_FALSE(cut_short.limits.empty());
  }
}

TEST(Decompose, StopsWithWhatWasReached) {
  const HexMesh cube = hex_grid({2, 2, 2});
  HexMesh padded = pad(cube, build_hex_complex(cube));
  const HexSurface surface = complete_hex_features(padded);
  Control control;
  control.stop_requested = [] { return true; };
  const Decomposition none = decompose_on_shape(padded, {&surface.mesh, &surface.features}, {}, control);
  EXPECT_TRUE(none.stopped);
  EXPECT_FALSE(none.proven);
  EXPECT_EQ(none.mesh.hexes, padded.hexes);
  EXPECT_EQ(none.nodes_left.size(), 8u);
  // Stopped while the second sheet is settled.
  int settled = 0;
  const auto settle = [&](HexMesh& mesh) {
    if (++settled == 2) throw Error(ExitCode::stopped, "Enough.");
    place_free(mesh);
    return true;
  };
  const Decomposition one = decompose(node_mesh("(1,3,3)"), {}, settle, {});
  EXPECT_TRUE(one.stopped);
  ASSERT_EQ(one.steps.size(), 1u);
  EXPECT_TRUE(check(one.mesh).empty());
  EXPECT_EQ(one.nodes_left.size(), 1u);
}

TEST(Decompose, SheetsThatCannotBePlacedAreTakenBack) {
  const HexMesh cube = hex_grid({2, 2, 2});
  const HexMesh padded = pad(cube, build_hex_complex(cube));
  const Decomposition none = decompose(padded, {}, [](HexMesh&) { return false; }, {});
  EXPECT_TRUE(none.steps.empty());
  EXPECT_EQ(none.mesh.hexes, padded.hexes);
  EXPECT_EQ(none.measure, none.measure_before);
  EXPECT_GT(none.sheets_refused, 1);
  EXPECT_FALSE(none.proven);
  // Only the first is refused: the others do as well.
  int calls = 0;
  const Decomposition second = decompose(padded, {}, [&](HexMesh&) { return ++calls > 1; }, {});
  EXPECT_EQ(second.measure, 0);
  EXPECT_EQ(second.sheets_refused, 1);
  EXPECT_EQ(static_cast<std::size_t>(calls), second.steps.size() + 1);
}

TEST(Decompose, OnAShapeTheSameForAnyNumberOfThreads) {
  const HexMesh cube = hex_grid({2, 2, 2});
  HexMesh padded = pad(cube, build_hex_complex(cube));
  const HexSurface surface = complete_hex_features(padded);
  const int before = threads();
  std::vector<HexMesh> results;
  for (int n : {1, 3}) {
    set_threads(n);
    const Decomposition done = decompose_on_shape(padded, {&surface.mesh, &surface.features}, {}, {});
    EXPECT_EQ(done.measure, 0);
    EXPECT_TRUE(check(done.mesh).empty());
    EXPECT_TRUE(check_against(done.mesh, surface.mesh, surface.features).violations.empty());
    EXPECT_GT(quality(done.mesh).min, quality(padded).min);
    results.push_back(done.mesh);
  }
  set_threads(before);
  EXPECT_EQ(results[0].hexes, results[1].hexes);
  EXPECT_EQ(results[0].points, results[1].points);
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

TEST(MaximiseMinimum, ReachesTheBoundOfACornerThatIsKept) {
  // At a corner of a padded cube three hexes share the octant: no better than 1 / sqrt(3).
  const HexMesh cube = hex_grid({3, 3, 3});
  HexMesh padded = pad(cube, build_hex_complex(cube));
  const HexSurface surface = complete_hex_features(padded);
  HexMesh best = padded;
  improve_thoroughly(best, {&surface.mesh, &surface.features}, {});
  EXPECT_NEAR(quality(best).min, std::sqrt(1.0 / 3), 1e-3);
  const Decomposition done = decompose_on_shape(padded, {&surface.mesh, &surface.features}, {}, {});
  EXPECT_TRUE(done.nodes_left.empty());
  EXPECT_GT(quality(done.mesh).min, std::sqrt(1.0 / 3) - 1e-3);
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

TEST(MaximiseMinimum, SlidesOnTheShape) {
  // A block whose inner vertices on one side are pushed together: only sliding along that side mends it.
  HexMesh mesh = hex_grid({3, 3, 3});
  const HexSurface surface = complete_hex_features(mesh);
  for (Vec3& p : mesh.points)
    if (p.z() == 3 && p.x() > 0 && p.x() < 3 && p.y() > 0 && p.y() < 3) p += Vec3(0.5 * (2 - p.x()), 0.4, 0);
  for (Vec3& p : mesh.points)
    if (p.x() == 1 && p.y() == 0 && p.z() == 0) p.x() = 1.7;  // on an edge of the block
  ASSERT_GT(quality(mesh).min, 0);
  ASSERT_LT(quality(mesh).min, 0.95);
  HexMesh held = mesh;
  MaximiseOptions hold;
  hold.free_boundary = false;
  maximise_minimum(held, hold, {});
  EXPECT_LT(quality(held).min, 0.95);
  maximise_minimum(mesh, surface.mesh, surface.features, {}, {});
  EXPECT_GT(quality(mesh).min, 0.99);
  EXPECT_TRUE(check_against(mesh, surface.mesh, surface.features, 1e-4).violations.empty());
}
