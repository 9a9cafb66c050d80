#include "../../src/hex/sheet_program.hpp"

#include <gtest/gtest.h>

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
    hex::SheetSearch search(mesh, complex, classes, spheres, measure, {6, 10000000, 1000000});
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
    return hex::SheetProgram(mesh, complex, classes, spheres, measure, 6).solve(100000);
  }

  HexMesh mesh;
  HexComplex complex;
  hex::QuadClasses classes;
  std::vector<VertexSphere> spheres;
  hex::NodeMeasure measure{5};
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
