#include <gtest/gtest.h>

#include "hexfield/io/debug_vtk.hpp"
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

namespace {

const VertexId v0(0), v1(1), v2(2);

const std::string tet_points = "POINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\n";

}  // namespace

TEST(LegacyVtk, Version51HasOffsetsAndMetadata) {
  const std::string text =
      "# vtk DataFile Version 5.1\nvtk output\nASCII\nDATASET UNSTRUCTURED_GRID\n"
      "FIELD FieldData 2\nTIME 1 1 double\n0.5\nMETADATA\nINFORMATION 0\n\nnote 1 1 string\nhello%20world\n" +
      tet_points +
      "METADATA\nINFORMATION 0\n\nCELLS 4 9\nOFFSETS vtktypeint64\n0 4 7 9\nCONNECTIVITY vtktypeint64\n"
      "0 1 2 3\n0 1 2\n0 1\nCELL_TYPES 3\n10\n5\n3\n\nPOINT_DATA 4\nSCALARS t float\nLOOKUP_TABLE default\n1 2 3 4\n"
      "CELL_DATA 3\nNORMALS n float\n0 0 1 0 0 1 0 0 1\nSCALARS quality double 1\nLOOKUP_TABLE mine\n.5 .5 .5\n"
      "LOOKUP_TABLE mine 2\n0 0 0 1 1 1 1 1\nFIELD FieldData 2\nother 1 3 int\n7 7 7\nfeature 1 3 vtktypeint64\n"
      "2 5 0\nMETADATA\nINFORMATION 0\n\n";
  const TetInput input = read_tet_mesh(samples::write_text("v51.vtk", text));
  EXPECT_EQ(input.features.tet_colours, std::vector<int>{2});
  EXPECT_EQ(input.features.faces, (std::map<FaceKey, int>{{face_key(v0, v1, v2), 5}}));
  EXPECT_TRUE(input.features.edges.empty());  // tag 0
}

TEST(LegacyVtk, TheFirstIntegerScalarIsTheColourWhereNoNameIsKnown) {
  const std::string text = "# vtk DataFile Version 2.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\n" + tet_points +
                           "CELLS 3 10\n4 0 1 2 3\n1 0\n2 1 2\nCELL_TYPES 3\n10\n1\n3\nCELL_DATA 3\n"
                           "SCALARS q float\nLOOKUP_TABLE default\n9 9 9\nSCALARS group int\nLOOKUP_TABLE default\n"
                           "1 3 -4\nSCALARS part int\nLOOKUP_TABLE default\n8 8 8\n";
  const TetInput input = read_tet_mesh(samples::write_text("first.vtk", text));
  EXPECT_EQ(input.features.points, (std::map<VertexId, int>{{v0, 3}}));
  EXPECT_TRUE(input.features.edges.empty());
  EXPECT_TRUE(input.features.tet_colours.empty());
}

TEST(LegacyVtk, PolyLinesAndPolyVerticesAreTakenApart) {
  const std::string text = "# vtk DataFile Version 4.2\nx\nASCII\nDATASET UNSTRUCTURED_GRID\n" + tet_points +
                           "CELLS 3 12\n4 0 1 2 3\n3 0 1 2\n2 0 2\nCELL_TYPES 3\n10\n4\n2\nCELL_DATA 3\n"
                           "SCALARS color double\nLOOKUP_TABLE default\n1 3 4.0\n";
  const TetInput input = read_tet_mesh(samples::write_text("poly.vtk", text));
  EXPECT_EQ(input.features.edges, (std::map<EdgeKey, int>{{edge_key(v0, v1), 3}, {edge_key(v1, v2), 3}}));
  EXPECT_EQ(input.features.points, (std::map<VertexId, int>{{v0, 4}, {v2, 4}}));
}

TEST(DebugVtk, MixedCellsWithScalars) {
  const auto file = samples::scratch_file("why.vtk");
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<DebugCell> cells = {{3}, {0, 1}, {0, 1, 2}, {0, 1, 2, 3}};
  const std::vector<DebugScalar> scalars = {{"code", {0, -1, 5, 2}}, {"id", {1, 2, 3, 4}}};
  write_vtk_debug(file, points, cells, scalars);
  const std::string text = hexfield::testing::bytes_of(file);
  EXPECT_NE(text.find("CELLS 4 14\n1 3\n2 0 1\n3 0 1 2\n4 0 1 2 3\nCELL_TYPES 4\n1\n3\n5\n10\nCELL_DATA 4\n"
                      "SCALARS code int 1\nLOOKUP_TABLE default\n0\n-1\n5\n2\n"
                      "SCALARS id int 1\nLOOKUP_TABLE default\n1\n2\n3\n4\n"),
            std::string::npos);
}
