#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "hexfield/hex/hex_mesh.hpp"
#include "hexfield/io/tet_io.hpp"
#include "support/meshes.hpp"
#include "support/scratch.hpp"

namespace hexfield::samples {

/// A place for a file of this process that the test may overwrite.
inline std::filesystem::path scratch_file(const std::string& name) {
  static const hexfield::testing::ScratchDirectory folder;
  return folder / name;
}

inline std::filesystem::path write_text(const std::string& name, const std::string& text) {
  const auto file = scratch_file(name);
  hexfield::testing::write_bytes(file, text);
  return file;
}

/// The box [0, 2] x [0, 1] x [0, 1] with two materials, two feature points, a curve and two surfaces, all named
/// but one; its coordinates are no short decimals.
inline TetInput tagged_box() {
  TetInput input{hexfield::testing::kuhn_box(2, 1, 1), {}};
  for (Vec3& p : input.mesh.points) p = Vec3(p.x() / 3 + 0.1, p.y() * 1e-2, p.z() * 12.345678);
  const auto v = [](int i) { return VertexId(i); };
  Features& f = input.features;
  f.points = {{v(0), 5}, {v(2), 7}};
  f.edges = {{edge_key(v(0), v(1)), 3}, {edge_key(v(1), v(2)), 3}, {edge_key(v(0), v(3)), 9}};
  for (std::size_t i = 0; i < 4 * input.mesh.num_tets(); ++i) {
    const HalfFaceId h{static_cast<std::int64_t>(i)};
    const double nx = outward_normal(input.mesh, h).x();
    if (input.mesh.is_boundary(h) && std::abs(nx) > 0.9) f.faces.emplace(input.mesh.key(h), nx > 0 ? 11 : 2);
  }
  for (std::size_t t = 0; t < input.mesh.num_tets(); ++t)
    f.tet_colours.push_back(centroid(input.mesh, TetId(static_cast<std::int64_t>(t))).x() < 0.1 + 1.0 / 3 ? 1 : 4);
  f.names = {{{1, 3}, "long edge"}, {{2, 11}, "out"}, {{2, 2}, "in & <back>"}, {{3, 1}, "steel"}, {{3, 4}, "air"}};
  return input;
}

/// Two unit cubes side by side with a feature vertex, two lines, two quads and two materials.
inline HexMesh tagged_hexes() {
  HexMesh mesh;
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 3; ++i) mesh.points.emplace_back(i / 3.0, j, k);
  for (int i = 0; i < 2; ++i) mesh.hexes.push_back({i, i + 1, i + 4, i + 3, i + 6, i + 7, i + 10, i + 9});
  mesh.hex_colours = {2, 6};
  mesh.feature_points = {{0, 5}};
  mesh.feature_lines = {{{0, 1}, 3}, {{1, 2}, 3}};
  mesh.feature_quads = {{{0, 6, 9, 3}, 8}, {{2, 5, 11, 8}, 1}};
  mesh.names = {{{0, 5}, "tip"}, {{2, 8}, "inlet"}, {{3, 2}, "steel"}};
  return mesh;
}

inline void expect_same(const TetInput& got, const TetInput& expected) {
  EXPECT_EQ(got.mesh.points, expected.mesh.points);
  EXPECT_EQ(got.mesh.tets, expected.mesh.tets);
  EXPECT_EQ(got.mesh.opposite, expected.mesh.opposite);
  EXPECT_EQ(got.features.points, expected.features.points);
  EXPECT_EQ(got.features.edges, expected.features.edges);
  EXPECT_EQ(got.features.faces, expected.features.faces);
  EXPECT_EQ(got.features.tet_colours, expected.features.tet_colours);
  EXPECT_EQ(got.features.names, expected.features.names);
}

inline void expect_same(const HexMesh& got, const HexMesh& expected) {
  EXPECT_EQ(got.points, expected.points);
  EXPECT_EQ(got.hexes, expected.hexes);
  EXPECT_EQ(got.hex_colours, expected.hex_colours);
  EXPECT_EQ(got.names, expected.names);
  const auto same = [](const auto& a, const auto& b, auto member) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(member(a[i]), member(b[i]));
      EXPECT_EQ(a[i].colour, b[i].colour);
    }
  };
  same(got.feature_points, expected.feature_points, [](const HexMesh::Point& p) { return p.vertex; });
  same(got.feature_lines, expected.feature_lines, [](const HexMesh::Line& l) { return l.vertices; });
  same(got.feature_quads, expected.feature_quads, [](const HexMesh::Quad& q) { return q.vertices; });
}

}  // namespace hexfield::samples
