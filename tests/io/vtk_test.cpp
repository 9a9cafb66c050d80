#include <gtest/gtest.h>

#include "hexfield/io/hex_io.hpp"
#include "hexfield/io/hexex_io.hpp"
#include "hexfield/io/tet_io.hpp"
#include "io/samples.hpp"

using namespace hexfield;
using samples::expect_same;
using samples::scratch_file;

TEST(LegacyVtk, TetsWithFeaturesComeBackUnchanged) {
  const TetInput input = samples::tagged_box();
  for (const bool binary : {false, true}) {
    const auto file = scratch_file("box.vtk");
    write_tet_mesh(file, input.mesh, input.features, {.format = {}, .binary = binary});
    TetInput expected = input;
    expected.features.names.clear();  // the format has none
    expect_same(read_tet_mesh(file), expected);
  }
}

TEST(LegacyVtk, HexesWithFeaturesComeBackUnchanged) {
  const HexMesh mesh = samples::tagged_hexes();
  for (const bool binary : {false, true}) {
    const auto file = scratch_file("hex.vtk");
    write_hex_mesh(file, mesh, {.format = {}, .binary = binary});
    HexMesh expected = mesh;
    expected.names.clear();
    expect_same(read_hex_mesh(file), expected);
  }
}

TEST(LegacyVtk, TheHexFileHasTheLayoutOfTheDesign) {
  const auto file = scratch_file("hex.vtk");
  write_hex_mesh(file, samples::tagged_hexes());
  const std::string text = hexfield::testing::bytes_of(file);
  EXPECT_TRUE(text.starts_with("# vtk DataFile Version 2.0\n"));
  EXPECT_NE(text.find("\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 12 double\n"), std::string::npos);
  EXPECT_NE(text.find("\nCELLS 7 36\n1 0\n"), std::string::npos);
  EXPECT_NE(text.find("\nCELL_TYPES 7\n1\n3\n3\n9\n9\n12\n12\nCELL_DATA 7\nSCALARS CellEntityIds int 1\n"
                      "LOOKUP_TABLE default\n"),
            std::string::npos);
}
