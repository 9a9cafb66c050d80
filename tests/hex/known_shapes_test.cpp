// The table of known answers of spec-quantization section 9: hexes of integer-grid maps.
#include <gtest/gtest.h>

#include "hexfield/hex/check.hpp"
#include "hexfield/hex/extract.hpp"
#include "support/block_maps.hpp"

using namespace hexfield;
using namespace hexfield::testing;

namespace {

struct Shape {
  const char* name;
  MappedMesh m;
  std::size_t hexes;
};

std::vector<Shape> shapes() {
  return {{"L", l_prism(3, 4, 2, 5, 6), 6 * (3 * 2 + 3 * 5 + 4 * 2)},
          {"U", slotted_box(3, 2, 4, 5, 2, 3), 5 * ((3 + 2 + 4) * 2 + (3 + 4) * 3)},
          {"cube without a corner", cube_without_corner(2, 3), 125 - 27},
          {"ball", ball(3, 4, 5, 2), 60 + 4 * (12 + 20 + 15)},
          {"smallest ball", ball(1, 1, 1, 1), 7},
          {"pentagonal prism", polygon_prism({3, 4, 5, 2, 6}, 2), 2 * (12 + 20 + 10 + 12 + 18)},
          {"disc torus", disc_torus({2, 3, 2, 4}, 3, 4, 2), 11 * (12 + 4 * 7)},
          {"square torus", square_torus(6, 5, 2, 3), 30}};
}

void expect_same_topology(const HexMesh& hexes, const TetMesh& mesh) {
  const MeshTopology a = topology(hexes), b = topology(mesh);
  EXPECT_EQ(a.components, b.components);
  EXPECT_EQ(a.boundary_components, b.boundary_components);
  EXPECT_EQ(a.euler_volume, b.euler_volume);
  EXPECT_EQ(a.euler_boundary, b.euler_boundary);
  EXPECT_EQ(a.boundary_edges_not_in_two_faces, 0);
}

}  // namespace

TEST(KnownShapes, MapsHoldTheHexesOfTheTable) {
  for (const Shape& s : shapes()) {
    SCOPED_TRACE(s.name);
    const HexMesh hexes = extract_hex_mesh(s.m.mesh, {}, s.m.map);
    EXPECT_EQ(hexes.hexes.size(), s.hexes);
    expect_same_topology(hexes, s.m.mesh);
  }
}

TEST(KnownShapes, RefinedAndShakenMapsHoldTheirHexes) {
  for (const Shape& s : shapes())
    for (const int k : {2, 3}) {
      SCOPED_TRACE(s.name);
      MappedMesh fine = s.m;
      for (auto& tet : fine.map.uvw)
        for (Vec3& p : tet) p *= k;
      shake(fine, 0.3);
      const HexMesh hexes = extract_hex_mesh(fine.mesh, {}, fine.map);
      EXPECT_EQ(hexes.hexes.size(), s.hexes * static_cast<std::size_t>(k * k * k));
      expect_same_topology(hexes, s.m.mesh);
    }
}

TEST(KnownShapes, ChartsDoNotMatter) {
  for (const Shape& s : shapes()) {
    SCOPED_TRACE(s.name);
    MappedMesh turned = s.m;
    for (std::size_t t = 0; t < turned.mesh.num_tets(); ++t)
      change_chart(turned, TetId(t), static_cast<octahedral::Rotation>((7 * t + 3) % 24),
                   Vec3(static_cast<double>(t % 5), -static_cast<double>(t % 7), static_cast<double>(3 * t % 11)));
    EXPECT_EQ(extract_hex_mesh(turned.mesh, {}, turned.map).hexes.size(), s.hexes);
  }
}
