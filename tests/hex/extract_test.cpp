#include "hexfield/hex/extract.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "hexfield/base/parallel.hpp"
#include "hexfield/hex/sanitise.hpp"
#include "support/mapped_meshes.hpp"

using namespace hexfield;
using namespace hexfield::testing;

namespace {

std::set<std::array<int, 8>> vertex_sets(const HexMesh& mesh) {
  std::set<std::array<int, 8>> sets;
  for (auto hex : mesh.hexes) {
    std::sort(hex.begin(), hex.end());
    sets.insert(hex);
  }
  return sets;
}

double smallest_corner(const HexMesh& mesh) {
  constexpr int corners[8][4] = {{0, 1, 3, 4}, {1, 2, 0, 5}, {2, 3, 1, 6}, {3, 0, 2, 7},
                                 {4, 7, 5, 0}, {5, 4, 6, 1}, {6, 5, 7, 2}, {7, 6, 4, 3}};
  double smallest = 1;
  for (const auto& hex : mesh.hexes)
    for (const auto& c : corners) {
      const auto at = [&](int k) { return mesh.points[static_cast<std::size_t>(hex[static_cast<std::size_t>(c[k])])]; };
      const Vec3 a = (at(1) - at(0)).normalized();
      const Vec3 b = (at(2) - at(0)).normalized();
      smallest = std::min(smallest, a.cross(b).dot((at(3) - at(0)).normalized()));
    }
  return smallest;
}

void expect_same(const HexMesh& a, const HexMesh& b) {
  EXPECT_EQ(a.hexes, b.hexes);
  EXPECT_EQ(a.points, b.points);
  ASSERT_EQ(a.feature_quads.size(), b.feature_quads.size());
  for (std::size_t k = 0; k < a.feature_quads.size(); ++k)
    EXPECT_EQ(a.feature_quads[k].vertices, b.feature_quads[k].vertices);
}

}  // namespace

TEST(Extract, CubeOfAnyTetAndHexSizeHasNCubedHexes) {
  for (const auto& [cells, n] : {std::pair{1, 1}, {1, 5}, {2, 2}, {3, 2}, {4, 1}, {3, 7}}) {
    const MappedMesh m = scaled_box(cells, cells, cells, Vec3::Constant(static_cast<double>(n) / cells));
    const HexMesh hexes = extract_hex_mesh(m.mesh, box_features(m.mesh, Vec3::Constant(cells)), m.map);
    const auto count = static_cast<std::size_t>(n);
    EXPECT_EQ(hexes.hexes.size(), count * count * count);
    EXPECT_EQ(hexes.points.size(), (count + 1) * (count + 1) * (count + 1));
    EXPECT_EQ(vertex_sets(hexes).size(), hexes.hexes.size());
    EXPECT_NEAR(smallest_corner(hexes), 1, 1e-12);
    EXPECT_EQ(hexes.feature_points.size(), 8u);
    EXPECT_EQ(hexes.feature_lines.size(), 12 * count);
    EXPECT_EQ(hexes.feature_quads.size(), 6 * count * count);
  }
}

TEST(Extract, FeaturesLieWhereTheirColourSays) {
  const MappedMesh m = scaled_box(3, 3, 3, Vec3::Constant(4.0 / 3));
  const Features features = box_features(m.mesh, Vec3::Constant(3));
  const HexMesh hexes = extract_hex_mesh(m.mesh, features, m.map);
  const auto at = [&](int v) { return hexes.points[static_cast<std::size_t>(v)]; };
  for (const auto& quad : hexes.feature_quads) {
    const int axis = (quad.colour - 1) / 2;
    for (int v : quad.vertices) EXPECT_NEAR(at(v)[axis], (quad.colour - 1) % 2 * 3.0, 1e-12);
    const Vec3 normal =
        (at(quad.vertices[1]) - at(quad.vertices[0])).cross(at(quad.vertices[2]) - at(quad.vertices[0]));
    EXPECT_GT(normal[axis] * ((quad.colour - 1) % 2 == 0 ? -1 : 1), 0) << "not counter-clockwise from outside";
  }
  for (const auto& point : hexes.feature_points) {
    const auto same = [&](const auto& f) {
      return f.second == point.colour && m.mesh.point(f.first) == at(point.vertex);
    };
    EXPECT_TRUE(std::any_of(features.points.begin(), features.points.end(), same));
  }
  for (const auto& line : hexes.feature_lines) {
    EXPECT_NEAR((at(line.vertices[0]) - at(line.vertices[1])).norm(), 0.75, 1e-12);
    const auto holds = [&](const auto& f) {
      const Vec3 d = m.mesh.point(f.first[1]) - m.mesh.point(f.first[0]);
      const Vec3 middle = (at(line.vertices[0]) + at(line.vertices[1])) / 2 - m.mesh.point(f.first[0]);
      return f.second == line.colour && middle.cross(d).norm() < 1e-12;
    };
    EXPECT_TRUE(std::any_of(features.edges.begin(), features.edges.end(), holds));
  }
}

TEST(Extract, RotatedAndShiftedChartsGiveTheSameMesh) {
  MappedMesh m = scaled_box(2, 2, 2, Vec3::Constant(1.5));
  const Features features = box_features(m.mesh, Vec3::Constant(2));
  const HexMesh plain = extract_hex_mesh(m.mesh, features, m.map);
  for (std::size_t t = 0; t < m.mesh.num_tets(); ++t)
    change_chart(m, TetId(t), static_cast<octahedral::Rotation>((7 * t + 3) % 24),
                 Vec3(static_cast<double>(t % 5), -static_cast<double>(t % 7), static_cast<double>(3 * t % 11)));
  const HexMesh turned = extract_hex_mesh(m.mesh, features, m.map);
  EXPECT_EQ(turned.points.size(), plain.points.size());
  EXPECT_EQ(turned.feature_lines.size(), plain.feature_lines.size());
  EXPECT_EQ(turned.feature_quads.size(), plain.feature_quads.size());
  ASSERT_EQ(turned.hexes.size(), plain.hexes.size());
  EXPECT_NEAR(smallest_corner(turned), 1, 1e-12);
}

TEST(Extract, PrismsWithASingularLine) {
  struct Case {
    std::vector<int> lengths;
    int height;
  };
  for (const Case& c : {Case{{1, 1, 1}, 2},
                        {{2, 3, 4}, 3},
                        {{1, 1, 1, 1, 1}, 1},
                        {{2, 1, 3, 2, 4}, 2},
                        {{1, 2, 1, 2, 1, 2, 3, 1}, 2}}) {
    const MappedMesh m = polygon_prism(c.lengths, c.height);
    const HexMesh hexes = extract_hex_mesh(m.mesh, {}, m.map);
    int expected = 0;
    for (std::size_t i = 0; i < c.lengths.size(); ++i) expected += c.lengths[i] * c.lengths[(i + 1) % c.lengths.size()];
    EXPECT_EQ(hexes.hexes.size(), static_cast<std::size_t>(expected * c.height));
    EXPECT_EQ(vertex_sets(hexes).size(), hexes.hexes.size());
    EXPECT_GT(smallest_corner(hexes), 0);
  }
}

TEST(Extract, RefiningTheMapByKMultipliesTheHexesByKCubed) {
  MappedMesh m = polygon_prism({1, 2, 1}, 1);
  const std::size_t base = extract_hex_mesh(m.mesh, {}, m.map).hexes.size();
  for (std::size_t k : {2U, 3U, 7U}) {
    MappedMesh fine = m;
    for (auto& tet : fine.map.uvw)
      for (Vec3& p : tet) p *= static_cast<double>(k);
    EXPECT_EQ(extract_hex_mesh(fine.mesh, {}, fine.map).hexes.size(), base * k * k * k);
  }
}

TEST(Extract, TorusOfOneOrTwoHexesAroundKeepsItsSidesApart) {
  for (int nu : {1, 2, 3}) {
    const MappedMesh m = square_torus(8, nu, 2, 1);
    Features features;
    for (std::size_t t = 0; t < m.mesh.num_tets(); ++t)
      for (int i = 0; i < 4; ++i)
        if (m.mesh.is_boundary(HalfFaceId(TetId(t), i))) features.faces[m.mesh.key(HalfFaceId(TetId(t), i))] = 5;
    const HexMesh hexes = extract_hex_mesh(m.mesh, features, m.map);
    EXPECT_EQ(hexes.hexes.size(), static_cast<std::size_t>(2 * nu));
    EXPECT_EQ(hexes.points.size(), static_cast<std::size_t>(6 * nu));
    EXPECT_EQ(hexes.feature_quads.size(), static_cast<std::size_t>(6 * nu));
  }
}

TEST(Extract, InteriorFeatureSurfacesAndCurvesAreCarriedOnce) {
  const MappedMesh m = scaled_box(4, 3, 3, Vec3(1, 4.0 / 3, 4.0 / 3));
  Features features;
  for (std::size_t t = 0; t < m.mesh.num_tets(); ++t)
    for (int i = 0; i < 4; ++i) {
      const auto v = m.mesh.face_vertices(HalfFaceId(TetId(t), i));
      if (std::all_of(v.begin(), v.end(), [&](VertexId x) { return m.mesh.point(x).x() == 2; }))
        features.faces[m.mesh.key(HalfFaceId(TetId(t), i))] = 9;
    }
  features.tet_colours.assign(m.mesh.num_tets(), 0);
  for (std::size_t t = 0; t < m.mesh.num_tets(); ++t)
    features.tet_colours[t] = centroid(m.mesh, TetId(t)).x() < 2 ? 4 : 5;
  const HexMesh hexes = extract_hex_mesh(m.mesh, features, m.map);
  EXPECT_EQ(hexes.feature_quads.size(), 16u);
  EXPECT_EQ(std::count(hexes.hex_colours.begin(), hexes.hex_colours.end(), 4), 32);
  EXPECT_EQ(std::count(hexes.hex_colours.begin(), hexes.hex_colours.end(), 5), 32);
}

TEST(Extract, SameBytesForAnyNumberOfThreads) {
  const MappedMesh m = square_torus(40, 17, 5, 6);
  const int before = threads();
  set_threads(1);
  const HexMesh one = extract_hex_mesh(m.mesh, {}, m.map);
  set_threads(3);
  const HexMesh three = extract_hex_mesh(m.mesh, {}, m.map);
  set_threads(before);
  expect_same(one, three);
  EXPECT_EQ(one.hexes.size(), 17u * 30);
}

TEST(Extract, NoisyMapsAreMadeExact) {
  MappedMesh m = polygon_prism({2, 3, 4}, 3);
  unsigned state = 1;
  for (auto& tet : m.map.uvw)
    for (Vec3& p : tet)
      for (int a = 0; a < 3; ++a)
        p[a] += 1e-9 * (static_cast<double>((state = state * 1664525U + 1013904223U) >> 8U) / (1U << 24U) - 0.5);
  const SanitisedMap exact = sanitise_igm(m.mesh, {}, m.map);
  EXPECT_TRUE(exact.violations.empty());
  EXPECT_GT(exact.largest_move, 0);
  EXPECT_LT(exact.largest_move, 2e-9);
  EXPECT_EQ(extract_hex_mesh(m.mesh, {}, m.map).hexes.size(), 26u * 3);
  for (std::size_t t = 0; t < m.mesh.num_tets(); ++t)
    for (int i = 0; i < 4; ++i) {
      const HalfFaceId h(TetId(t), i);
      if (m.mesh.is_boundary(h)) continue;
      const Vec3 translation = transition_translation(m.mesh, exact.map, h);
      EXPECT_EQ(translation, translation.array().round().matrix());
    }
}

TEST(Extract, AnInvertedTetIsRefusedByName) {
  MappedMesh m = scaled_box(2, 2, 2, Vec3::Constant(2));
  const VertexId centre(13);
  for (std::size_t t = 0; t < m.mesh.num_tets(); ++t)
    for (std::size_t k = 0; k < 4; ++k)
      if (m.mesh.tets[t][k] == centre) m.map.uvw[t][k] = Vec3(4.5, 2, 2);
  try {
    extract_hex_mesh(m.mesh, {}, m.map);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_hex_mesh);
    ASSERT_FALSE(error.ids().empty());
    EXPECT_EQ(error.ids().size(), error.places().size());
    const auto& c = m.map.uvw[static_cast<std::size_t>(error.ids()[0])];
    EXPECT_LE((c[1] - c[0]).cross(c[2] - c[0]).dot(c[3] - c[0]), 0);
    EXPECT_THAT(error.sentence(), ::testing::HasSubstr("is inverted or flat"));
  }
}

TEST(Extract, BoundaryOffTheLatticeAndBrokenSeamsAreRefused) {
  MappedMesh m = scaled_box(2, 2, 2, Vec3::Constant(1.1));
  EXPECT_THROW(extract_hex_mesh(m.mesh, {}, m.map), Error);
  m = scaled_box(2, 2, 2, Vec3::Constant(1));
  m.map.uvw[5][1].x() += 0.25;
  EXPECT_THROW(extract_hex_mesh(m.mesh, {}, m.map), Error);
  m = scaled_box(2, 2, 2, Vec3::Constant(1));
  m.map.uvw[5][1].x() = std::nan("");
  EXPECT_THROW(extract_hex_mesh(m.mesh, {}, m.map), Error);
}
