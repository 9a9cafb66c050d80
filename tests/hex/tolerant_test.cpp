// Maps with small defects: put right, passed through, or left out; never a wrong hex.
#include <gtest/gtest.h>

#include "hexfield/base/parallel.hpp"
#include "hexfield/hex/extract.hpp"
#include "support/block_maps.hpp"

using namespace hexfield;
using namespace hexfield::testing;

namespace {

Features coloured_boundary(const TetMesh& mesh) {
  Features features;
  for (std::size_t t = 0; t < mesh.num_tets(); ++t)
    for (int i = 0; i < 4; ++i)
      if (mesh.is_boundary(HalfFaceId(TetId(t), i))) features.faces[mesh.key(HalfFaceId(TetId(t), i))] = 5;
  return features;
}

VertexId vertex_at(const MappedMesh& m, const Vec3& p) {
  for (std::size_t v = 0; v < m.mesh.num_vertices(); ++v)
    if ((m.mesh.points[v] - p).norm() < 1e-12) return VertexId(v);
  ADD_FAILURE() << "no vertex there";
  return VertexId(0);
}

void set_image(MappedMesh& m, VertexId v, const Vec3& uvw) {
  for (std::size_t t = 0; t < m.mesh.num_tets(); ++t)
    for (std::size_t k = 0; k < 4; ++k)
      if (m.mesh.tets[t][k] == v) m.map.uvw[t][k] = uvw;
}

MappedMesh cube(int n) {
  return grid_of_blocks({{{n}, {n}, {n}}}, [](int, int, int) { return true; });
}

}  // namespace

TEST(Tolerant, AValidMapGivesWhatStrictModeGives) {
  for (const MappedMesh& m : {cube(4), polygon_prism({2, 3, 4}, 3), ball(2, 2, 2, 1), square_torus(8, 3, 2, 1)}) {
    const Features features = coloured_boundary(m.mesh);
    const HexMesh strict = extract_hex_mesh(m.mesh, features, m.map);
    const TolerantExtraction tolerant = extract_tolerantly(m.mesh, features, m.map);
    EXPECT_TRUE(tolerant.complete);
    EXPECT_TRUE(tolerant.defects.empty());
    EXPECT_EQ(tolerant.moved, 0u);
    EXPECT_EQ(tolerant.mesh.hexes, strict.hexes);
    EXPECT_EQ(tolerant.mesh.points, strict.points);
    EXPECT_EQ(tolerant.mesh.feature_quads.size(), strict.feature_quads.size());
  }
}

TEST(Tolerant, AFoldIsTakenOutByMovingTheImage) {
  for (const Vec3& wrong : {Vec3(4.5, 2, 2), Vec3(2, -0.5, 2), Vec3(4.2, 4.2, 4.2)}) {
    MappedMesh m = cube(4);
    set_image(m, vertex_at(m, Vec3(2, 2, 2)), wrong);
    EXPECT_THROW(extract_hex_mesh(m.mesh, {}, m.map), Error);
    const TolerantExtraction result = extract_tolerantly(m.mesh, coloured_boundary(m.mesh), m.map);
    EXPECT_TRUE(result.complete);
    EXPECT_FALSE(result.defects.empty());
    EXPECT_GT(result.moved, 0u);
    EXPECT_EQ(result.mesh.hexes.size(), 64u);
    EXPECT_EQ(result.mesh.points.size(), 125u);
    EXPECT_EQ(result.mesh.feature_quads.size(), 96u);
  }
}

TEST(Tolerant, OneCornerOffIsOutvotedByTheOthers) {
  for (const std::size_t t : {0UL, 5UL, 33UL}) {
    MappedMesh m = scaled_box(2, 2, 2, Vec3::Constant(2));
    m.map.uvw[t][1] += Vec3(0.3, -0.2, 0.25);
    EXPECT_THROW(extract_hex_mesh(m.mesh, {}, m.map), Error);
    const TolerantExtraction result = extract_tolerantly(m.mesh, {}, m.map);
    EXPECT_TRUE(result.complete);
    EXPECT_FALSE(result.defects.empty());
    EXPECT_EQ(result.mesh.hexes.size(), 64u);
  }
}

TEST(Tolerant, SameForAnyNumberOfThreads) {
  MappedMesh m = cube(6);
  set_image(m, vertex_at(m, Vec3(3, 3, 3)), Vec3(6.5, 3, 3));
  const int before = threads();
  set_threads(1);
  const TolerantExtraction one = extract_tolerantly(m.mesh, {}, m.map);
  set_threads(3);
  const TolerantExtraction three = extract_tolerantly(m.mesh, {}, m.map);
  set_threads(before);
  EXPECT_EQ(one.mesh.hexes, three.mesh.hexes);
  EXPECT_EQ(one.mesh.points, three.mesh.points);
  EXPECT_EQ(one.mesh.hexes.size(), 216u);
}
