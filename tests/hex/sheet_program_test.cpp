#include "../../src/hex/sheet_program.hpp"

#include <gtest/gtest.h>

#include "../../src/hex/boundary_passes.hpp"
#include "hexfield/hex/sheet.hpp"
#include "support/hex_meshes.hpp"

using namespace hexfield;
using namespace hexfield::testing;

namespace {

/// What both searches need of a mesh.
struct Searched {
  explicit Searched(HexMesh m)
      : mesh(std::move(m)), complex(build_hex_complex(mesh)), classes(hex::build_quad_classes(complex, {})) {
    spheres.resize(mesh.points.size());
    for (std::size_t e = 0; e < complex.edges.size(); ++e)
      for (int v : complex.edges[e])
        if (complex.is_singular(static_cast<int>(e)) && !complex.is_boundary_vertex(v))
          spheres[static_cast<std::size_t>(v)] = vertex_sphere(mesh, complex, v);
  }

  /// The least change of any sheet through a vertex, by backtracking from all cycles there.
  int least_by_seeds() {
    hex::SheetSearch search(mesh, complex, classes, spheres, measure, {6, 10000000, 1000000}, control);
    int least = 0;
    for (const VertexSphere& star : spheres) {
      if (star.edges.empty()) continue;
      for (const auto& cycle : simple_cycles(star.sphere, 6)) {
        std::vector<int> quads;
        for (std::size_t k = 0; k < cycle.size(); ++k)
          quads.push_back(complex.quad_between(star.edges[static_cast<std::size_t>(cycle[k])],
                                               star.edges[static_cast<std::size_t>(cycle[(k + 1) % cycle.size()])]));
        std::vector<hex::SheetCandidate> found;
        EXPECT_TRUE(search.find(quads, found));
        for (const auto& sheet : found) {
          if (sheet.change >= least) continue;
          EXPECT_NO_THROW(inflate_sheet(mesh, complex, sheet.quads));
          least = sheet.change;
        }
      }
    }
    return least;
  }

  hex::SheetProgram::Result by_program() {
    return hex::SheetProgram(mesh, complex, classes, spheres, measure, 6).solve({100000, 1e10}, {});
  }

  HexMesh mesh;
  HexComplex complex;
  hex::QuadClasses classes;
  std::vector<VertexSphere> spheres;
  hex::NodeMeasure measure{5};
  Control control;
};

HexMesh padded(const HexMesh& mesh) { return pad(mesh, build_hex_complex(mesh), 0.2); }

}  // namespace

TEST(SheetProgram, IsNotWorseThanTheSearchFromEverySeed) {
  std::map<std::string, HexMesh> meshes{{"cube", padded(hex_grid({1, 1, 1}, false))},
                                        {"corner", padded(hex_blocks({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}))},
                                        {"step", padded(hex_blocks({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}}))}};
  for (const auto& [name, triangles] : eight_nodes())
    if (name != "(0,0,12)") meshes[name] = node_mesh(name);
  int improvable = 0;
  for (const auto& [name, mesh] : meshes) {
    Searched searched(mesh);
    const int least = searched.least_by_seeds();
    const auto result = searched.by_program();
    ASSERT_EQ(result.sheets.empty(), least == 0) << name;
    int sum = 0;
    for (const auto& sheet : result.sheets) {
      EXPECT_GE(sheet.change, least) << name;
      EXPECT_NO_THROW(inflate_sheet(searched.mesh, searched.complex, sheet.quads));
      sum += sheet.change;
    }
    EXPECT_LE(sum, least) << name;
    improvable += least < 0;
  }
  EXPECT_GE(improvable, 7);
}

TEST(SheetProgram, ProvesThatThereIsNoSheet) {
  // A node whose quads all hold features has none; a block has no node.
  Searched held(node_mesh("(2,2,2)"));
  std::vector<int> all;
  for (std::size_t q = 0; q < held.complex.quads.size(); ++q)
    if (!held.complex.is_boundary_quad(static_cast<int>(q))) all.push_back(static_cast<int>(q));
  held.classes = hex::build_quad_classes(held.complex, all);
  EXPECT_TRUE(held.by_program().sheets.empty());
  EXPECT_TRUE(held.by_program().complete);
  Searched block(hex_grid({3, 3, 3}, false));
  EXPECT_TRUE(block.by_program().sheets.empty());
  EXPECT_TRUE(block.by_program().complete);
}

TEST(SheetProgram, RemovesManyNodesAtOnce) {
  // A square frame: sixteen nodes, two sheets.
  std::vector<std::array<int, 3>> cells;
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 3; ++y)
      if (x != 1 || y != 1) cells.push_back({x, y, 0});
  Searched frame(padded(hex_blocks(cells)));
  const auto result = frame.by_program();
  int sum = 0;
  for (const auto& sheet : result.sheets) sum += sheet.change;
  EXPECT_EQ(sum, -16);
}

TEST(SheetProgram, EndsAtItsLimitsAndSaysSo) {
  std::vector<std::array<int, 3>> cells;
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 3; ++y)
      if (x != 1 || y != 1) cells.push_back({x, y, 0});
  Searched frame(padded(hex_blocks(cells)));
  const auto result = hex::SheetProgram(frame.mesh, frame.complex, frame.classes, frame.spheres, frame.measure, 6)
                          .solve({100000, 100}, {});
  EXPECT_FALSE(result.complete);
  EXPECT_TRUE(result.sheets.empty());
  EXPECT_FALSE(result.limit.empty());
}

TEST(SheetProgram, StopsInsideALinearProgram) {
  std::vector<std::array<int, 3>> cells;
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 3; ++y)
      if (y != 1 || x == 0 || x == 2) cells.push_back({x, y, 0});
  Searched mesh(padded(hex_blocks(cells)));
  Control control;
  int looks = 0;
  control.stop_requested = [&] { return ++looks > 0; };
  try {
    hex::SheetProgram(mesh.mesh, mesh.complex, mesh.classes, mesh.spheres, mesh.measure, 6).solve({500, 1e9}, control);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::stopped);
  }
  EXPECT_EQ(looks, 1);
}

TEST(BinaryProgram, FindsTheLeastAndProvesIt) {
  // Of three that exclude each other in pairs only one; a fourth goes with any and a fifth may not be taken.
  hex::BinaryProgram program;
  for (double cost : {-2.0, -3.0, -2.5, -1.0}) program.add(cost, 1);
  program.add(-9, 0);
  for (int a = 0; a < 3; ++a) program.rows.push_back({{{a, 1}, {(a + 1) % 3, 1}}, -1e300, 1});
  const auto best = hex::minimise(program, 0, 0.1, {}, {});
  EXPECT_TRUE(best.proven);
  EXPECT_EQ(best.values, (std::vector<char>{0, 1, 0, 1, 0}));
  const auto none = hex::minimise(program, -4.5, 0.1, {}, {});
  EXPECT_TRUE(none.proven);
  EXPECT_TRUE(none.values.empty());
}

TEST(BoundaryPasses, OfABlock) {
  const HexMesh mesh = hex_grid({2, 2, 2}, false);
  const HexComplex complex = build_hex_complex(mesh);
  const hex::QuadClasses classes = hex::build_quad_classes(complex, {});
  const auto at = [&](double x, double y, double z) {
    const auto found = std::find(mesh.points.begin(), mesh.points.end(), Vec3(x, y, z));
    return static_cast<int>(found - mesh.points.begin());
  };
  EXPECT_TRUE(hex::boundary_passes(complex, classes, at(0, 0, 0))->empty());  // no quad inside ends there
  EXPECT_EQ(hex::boundary_passes(complex, classes, at(1, 0, 0))->size(), 1u);
  const auto middle = hex::boundary_passes(complex, classes, at(1, 1, 0));  // two planes cross, no way around a corner
  ASSERT_EQ(middle->size(), 2u);
  for (const auto& pass : *middle) EXPECT_EQ(pass.size(), 1u);
}

TEST(BoundaryPasses, AroundACurveOfValenceThree) {
  // Where a singular curve ends on the boundary a sheet comes in over one quad and leaves over another: three ways.
  const HexMesh mesh = node_mesh("(4,0,0)");
  const HexComplex complex = build_hex_complex(mesh);
  const hex::QuadClasses classes = hex::build_quad_classes(complex, {});
  int ends = 0;
  for (std::size_t e = 0; e < complex.edges.size(); ++e) {
    if (!complex.is_singular(static_cast<int>(e))) continue;
    for (int v : complex.edges[e]) {
      if (!complex.is_boundary_vertex(v)) continue;
      EXPECT_EQ(hex::boundary_passes(complex, classes, v)->size(), 3u);
      ++ends;
    }
  }
  EXPECT_EQ(ends, 4);
}
