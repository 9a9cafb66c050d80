// Maps with small defects: put right, passed through, or left out; never a wrong hex.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "hexfield/base/parallel.hpp"
#include "hexfield/hex/check.hpp"
#include "hexfield/hex/extract.hpp"
#include "hexfield/hex/sanitise.hpp"
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

// Every hex is a unit cube along the axes: the maps here are the identity where they are right.
std::size_t cubes(const HexMesh& mesh) {
  std::set<std::array<double, 3>> places;
  for (const auto& hex : mesh.hexes) {
    Vec3 low = Vec3::Constant(1e9), high = Vec3::Constant(-1e9);
    for (int v : hex) {
      low = low.cwiseMin(mesh.points[static_cast<std::size_t>(v)]);
      high = high.cwiseMax(mesh.points[static_cast<std::size_t>(v)]);
    }
    if (((high - low) - Vec3::Ones()).cwiseAbs().maxCoeff() < 1e-9) places.insert({low[0], low[1], low[2]});
  }
  return places.size();
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

// Some tets of a mesh left out and others added; each vertex is mapped to where it was, in one global chart.
MappedMesh rebuilt(const MappedMesh& m, const std::vector<TetId>& without, std::vector<std::array<VertexId, 4>> added,
                   const std::vector<Vec3>& points) {
  const std::vector<Vec3>& images = m.mesh.points;
  std::vector<std::array<VertexId, 4>> tets;
  for (std::size_t t = 0; t < m.mesh.num_tets(); ++t) {
    if (std::find(without.begin(), without.end(), TetId(t)) == without.end()) tets.push_back(m.mesh.tets[t]);
  }
  for (auto& tet : added) {
    const auto at = [&](std::size_t k) { return points[tet[k].index()]; };
    if ((at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) < 0) std::swap(tet[2], tet[3]);
    tets.push_back(tet);
  }
  MappedMesh out{build_tet_mesh(points, tets), {}};
  out.map.rotations.assign(tets.size(), {});
  for (const auto& tet : out.mesh.tets) {
    auto& uvw = out.map.uvw.emplace_back();
    for (std::size_t k = 0; k < 4; ++k) uvw[k] = images[tet[k].index()];
  }
  return out;
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
  // A vertex of the hull stays in its plane.
  MappedMesh m = cube(4);
  const VertexId v = vertex_at(m, Vec3(2, 2, 0));
  set_image(m, v, Vec3(5, 2, 0));
  const HealedMap healed = heal_igm(m.mesh, {}, m.map);
  for (std::size_t t = 0; t < m.mesh.num_tets(); ++t) {
    EXPECT_EQ(healed.tets[t], HealedMap::Tet::positive);
    for (std::size_t k = 0; k < 4; ++k)
      if (m.mesh.tets[t][k] == v) {
        EXPECT_EQ(healed.map.uvw[t][k].z(), 0);
      }
  }
  EXPECT_EQ(extract_tolerantly(m.mesh, {}, m.map).mesh.hexes.size(), 64u);
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

TEST(Tolerant, AFlatTetOnTheHullIsPassedThrough) {
  const MappedMesh m = cube(4);
  std::vector<Vec3> points = m.mesh.points;
  const VertexId a = vertex_at(m, Vec3(0, 0, 0)), b = vertex_at(m, Vec3(4, 0, 0)), c = vertex_at(m, Vec3(4, 4, 0));
  const VertexId middle = vertex_at(m, Vec3(2, 2, 0));
  points[middle.index()].z() += 0.3;
  const MappedMesh flat = rebuilt(m, {}, {{a, middle, c, b}}, points);
  const auto id = static_cast<std::int64_t>(flat.mesh.num_tets()) - 1;
  try {
    extract_hex_mesh(flat.mesh, {}, flat.map);
    FAIL() << "strict mode took a flat tet";
  } catch (const Error& error) {
    EXPECT_EQ(error.ids(), std::vector<std::int64_t>{id});
  }
  const TolerantExtraction result = extract_tolerantly(flat.mesh, coloured_boundary(flat.mesh), flat.map);
  EXPECT_TRUE(result.complete);
  EXPECT_EQ(result.moved, 0u);
  ASSERT_EQ(result.defects.size(), 1u);
  EXPECT_EQ(result.defects[0].ids, std::vector<std::int64_t>{id});
  EXPECT_EQ(result.mesh.hexes.size(), 64u);
  EXPECT_EQ(result.mesh.points.size(), 125u);
  EXPECT_EQ(result.mesh.feature_quads.size(), 96u);
}

// Between two blocks: one side has the middle of their common side, the other only its corners there.
TEST(Tolerant, FlatTetsInsideArePassedThrough) {
  const MappedMesh m = grid_of_blocks({{{4, 4}, {4}, {4}}}, [](int, int, int) { return true; });
  std::vector<Vec3> points = m.mesh.points;
  const VertexId a = vertex_at(m, Vec3(4, 0, 0)), b = vertex_at(m, Vec3(4, 4, 0)), c = vertex_at(m, Vec3(4, 4, 4));
  const VertexId middle = vertex_at(m, Vec3(4, 2, 2)), centre = vertex_at(m, Vec3(6, 2, 2));
  points[middle.index()] += Vec3(-0.3, -0.2, 0.2);
  std::vector<TetId> without;
  for (std::size_t t = 0; t < m.mesh.num_tets(); ++t)
    if (m.mesh.has_vertex(TetId(t), centre) && m.mesh.has_vertex(TetId(t), middle) && m.mesh.has_vertex(TetId(t), b))
      without.emplace_back(t);
  ASSERT_EQ(without.size(), 2u);
  const MappedMesh flat = rebuilt(m, without, {{a, b, c, centre}, {a, middle, c, b}, {a, c, middle, centre}}, points);
  EXPECT_THROW(extract_hex_mesh(flat.mesh, {}, flat.map), Error);
  // Moving the middle off the line takes the flat tets away; where it is a feature point, it cannot move.
  for (const bool fixed : {false, true}) {
    Features features = coloured_boundary(flat.mesh);
    if (fixed) features.points[middle] = 9;
    const TolerantExtraction result = extract_tolerantly(flat.mesh, features, flat.map);
    EXPECT_TRUE(result.complete) << result.defects.back().sentence;
    EXPECT_EQ(result.mesh.hexes.size(), 128u);
    EXPECT_EQ(result.mesh.points.size(), 9u * 25u);
    EXPECT_EQ(result.mesh.feature_quads.size(), 2u * 16u + 4u * 32u);
    EXPECT_EQ(result.mesh.feature_points.size(), fixed ? 1u : 0u);
  }
}

// A point that must lie where it folds the map: hexes around it are missing, it is said, and the others are right.
TEST(Tolerant, WhatCannotBePutRightIsLeftOutAndSaid) {
  MappedMesh m = scaled_box(5, 5, 5, Vec3::Ones());
  const VertexId v = vertex_at(m, Vec3(2, 2, 0));
  set_image(m, v, Vec3(7, 2, 0));
  Features features = coloured_boundary(m.mesh);
  features.points[v] = 3;
  EXPECT_THROW(extract_hex_mesh(m.mesh, features, m.map), Error);
  const TolerantExtraction result = extract_tolerantly(m.mesh, features, m.map);
  EXPECT_FALSE(result.complete);
  ASSERT_FALSE(result.defects.empty());
  EXPECT_FALSE(result.defects.back().places.empty());
  EXPECT_LT(result.mesh.hexes.size(), 125u);
  // Hexes away from the fold are the unit cubes that they are without it.
  EXPECT_GE(cubes(result.mesh), 25u);
  std::set<std::array<int, 8>> different;
  for (auto hex : result.mesh.hexes) {
    std::sort(hex.begin(), hex.end());
    different.insert(hex);
  }
  EXPECT_EQ(different.size(), result.mesh.hexes.size());
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
