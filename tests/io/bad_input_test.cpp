#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "hexfield/io/hex_io.hpp"
#include "hexfield/io/hexex_io.hpp"
#include "hexfield/io/tet_io.hpp"
#include "io/samples.hpp"

using namespace hexfield;
using samples::scratch_file;
using samples::write_text;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

namespace {

// The sentence of the Error(bad_input) that reading the file ends in.
std::string refusal(const std::filesystem::path& file) {
  try {
    if (file.extension() == ".hexex")
      read_hexex(file);
    else
      read_tet_mesh(file);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input) << error.what();
    return error.sentence();
  }
  return "accepted";
}

// Every sentence names the file, ends with a full stop and is one line.
void expect_refused(const std::string& name, const std::string& text, const std::vector<std::string>& words) {
  SCOPED_TRACE(text.substr(0, 300));
  const std::string sentence = refusal(write_text(name, text));
  EXPECT_THAT(sentence, AllOf(HasSubstr(name), Not(HasSubstr("\n"))));
  EXPECT_EQ(sentence.back(), '.');
  for (const std::string& word : words) EXPECT_THAT(sentence, HasSubstr(word));
}

// Legacy VTK file: a list of points and one of cells ("4 0 1 2 3"), their types and their tags.
struct VtkText {
  std::vector<std::string> points = {"0 0 0", "1 0 0", "0 1 0", "0 0 1", "1 1 1"};
  std::vector<std::string> cells = {"4 0 1 2 3", "4 4 2 1 3"};
  std::vector<int> types = {10, 10};
  std::vector<int> tags = {1, 1};
  int extra_points = 0, extra_cells = 0, extra_types = 0, extra_tags = 0;  // wrong counts

  VtkText& add(const std::string& cell, int type, int tag) {
    cells.push_back(cell);
    types.push_back(type);
    tags.push_back(tag);
    return *this;
  }
  std::string text() const {
    std::string s = "# vtk DataFile Version 2.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\n";
    s += fmt::format("POINTS {} double\n{}\n", static_cast<int>(points.size()) + extra_points, fmt::join(points, "\n"));
    std::size_t size = 0;
    for (const std::string& c : cells) size += static_cast<std::size_t>(std::count(c.begin(), c.end(), ' ')) + 1;
    s += fmt::format("CELLS {} {}\n{}\n", static_cast<int>(cells.size()) + extra_cells, size, fmt::join(cells, "\n"));
    s += fmt::format("CELL_TYPES {}\n{}\n", static_cast<int>(types.size()) + extra_types, fmt::join(types, "\n"));
    s += fmt::format("CELL_DATA {}\nSCALARS CellEntityIds int 1\nLOOKUP_TABLE default\n{}\n",
                     static_cast<int>(tags.size()) + extra_tags, fmt::join(tags, "\n"));
    return s;
  }
};

}  // namespace

TEST(BadInput, FilesThatCannotBeRead) {
  EXPECT_THAT(refusal(scratch_file("missing.vtk")), AllOf(HasSubstr("missing.vtk"), HasSubstr("no such file")));
  EXPECT_THAT(refusal(scratch_file("")), HasSubstr("directory"));
  expect_refused("empty.vtk", "", {"empty"});
  expect_refused("garbage.vtk", std::string("\x7f\0ELF\x02\x01\xff\xfe", 9), {"none of the formats"});
  expect_refused("garbage.mesh", std::string(100, '\xfe'), {"none of the formats"});
  expect_refused("words.vtk", "no mesh at all", {"begins with \"no\""});
}

TEST(BadInput, TheGoodFileOfTheseTestsIsAccepted) {
  EXPECT_EQ(refusal(write_text("good.vtk", VtkText().add("3 0 1 2", 5, 3).add("2 0 1", 3, 1).add("1 4", 1, 9).text())),
            "accepted");
}

TEST(BadInput, WrongCounts) {
  VtkText points, cells, types, tags;
  points.extra_points = -1;
  expect_refused("points.vtk", points.text(), {"line 10", "\"1\" is no section"});
  points.extra_points = 1;
  expect_refused("points.vtk", points.text(), {"line 11", "\"CELLS\" is no number"});
  cells.extra_cells = 1;
  expect_refused("cells.vtk", cells.text(), {"ends inside cell 2 of 3"});
  cells.extra_cells = -1;
  expect_refused("cells.vtk", cells.text(), {"take 5 numbers but the header says 10"});
  types.extra_types = 1;
  expect_refused("types.vtk", types.text(), {"\"CELL_DATA\" is no integer"});
  tags.extra_tags = 1;
  expect_refused("tags.vtk", tags.text(), {"CELL_DATA is 3 but the file has 2"});
  points.extra_points = 2000000000;
  expect_refused("huge.vtk", points.text(), {"more than the", "cut off or the number is wrong"});
  expect_refused("negative.vtk", "# vtk DataFile Version 2.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS -3 double\n",
                 {"impossible"});
}

TEST(BadInput, ImpossibleSizesAreRefusedBeforeMemoryIsTaken) {
  const std::string vtk = "# vtk DataFile Version 5.1\nx\nASCII\nDATASET UNSTRUCTURED_GRID\n";
  std::string binary = vtk;
  binary.replace(binary.find("ASCII"), 5, "BINARY");
  expect_refused("a.vtk", binary + "POINTS 4611686018427387904 double\n", {"impossible"});
  expect_refused("b.vtk", binary + "POINTS 300000000000 double\n", {"more than the 0 bytes"});
  expect_refused("c.vtk", vtk + "CELLS 2 4000000000\n4 0 1 2 3\n", {"4000000000"});
  expect_refused("d.vtk", vtk + "CELLS 4 6\nOFFSETS vtktypeint64\n0 5 3 6\nCONNECTIVITY vtktypeint64\n0 1 2 3 4 5\n",
                 {"offset 2 of the cells is 3"});
  expect_refused("e.vtk", vtk + "FIELD f 1\na 4611686018427387904 4611686018427387904 int\n", {"impossible"});
  const std::string msh2 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  expect_refused("a.msh", msh2 + "$Nodes\n99999999999\n1 0 0 0\n", {"line 5", "99999999999"});
  expect_refused("b.msh", msh2 + "$Nodes\n0\n$EndNodes\n$Elements\n1\n1 15 999999999 1\n", {"999999999"});
  const std::string msh4 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
  expect_refused("c.msh", msh4 + "$Nodes\n1 9223372036854775807 1 1\n", {"9223372036854775807"});
  expect_refused("d.msh", msh4 + "$Entities\n99999999 0 0 0\n", {"99999999"});
  expect_refused("a.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices\n1000000000000\n", {"1000000000000"});
  expect_refused("a.hexex", "999999999999\n0 0 0\n", {"999999999999"});
}

// Found by mutated files: the sentence did not name the file.
TEST(BadInput, TheNumberOfComponentsOfScalars) {
  std::string text = VtkText().text();
  text.replace(text.find("int 1\n"), 5, "int 0.5");
  expect_refused("components.vtk", text, {"line 18", "\"0.5\" is no integer"});
}

TEST(BadInput, Coordinates) {
  VtkText file;
  file.points[4] = "1 nan 1";
  expect_refused("nan.vtk", file.text(), {"ertex 4", "nan"});
  file.points[4] = "1 1e300 1";
  expect_refused("huge.vtk", file.text(), {"ertex 4", "1e+300"});
  file.points[4] = "1 1e999 1";
  expect_refused("inf.vtk", file.text(), {"ertex 4", "inf"});
  file.points[4] = "1 one 1";
  expect_refused("word.vtk", file.text(), {"line 10", "\"one\" is no number"});
}

TEST(BadInput, Tets) {
  VtkText file;
  file.cells[1] = "4 4 2 1 7";
  expect_refused("range.vtk", file.text(), {"corner 3 of cell 1", "5 vertices"});
  file.cells[1] = "4 4 2 1 -1";
  expect_refused("range.vtk", file.text(), {"corner 3 of cell 1"});
  file.cells[1] = "4 4 1 2 3";
  expect_refused("inverted.vtk", file.text(), {"Tet 1 at (0.5, 0.5, 0.5) is inverted"});
  file.cells[1] = "4 4 2 1 1";
  expect_refused("twice.vtk", file.text(), {"Tet 1", "a vertex twice"});
  file.cells[1] = "4 1 2 3 0";
  file.points[3] = "0.25 0.25 0";
  file.cells[0] = "4 0 1 2 4";
  expect_refused("flat.vtk", file.text(), {"Tet 1 at (0.3125, 0.3125, 0) is flat"});
  expect_refused("doubled.vtk", VtkText().add("4 2 0 1 3", 10, 1).text(), {"Tet 2", "same vertices as tet 0"});
  expect_refused("none.vtk", VtkText{.cells = {"3 0 1 2"}, .types = {5}, .tags = {1}}.text(), {"no tetrahedra"});
  VtkText three;
  three.points.emplace_back("2 2 2");
  expect_refused("three.vtk", three.add("4 5 2 1 3", 10, 1).text(), {"The face of vertices 1, 2, 3", "0, 1, 2"});
}

TEST(BadInput, HangingVertices) {
  VtkText file;
  file.points = {"0 0 0", "1 0 0", "0 1 0", "0 0 1", "0.25 0.25 0", "0 0 -1"};
  file.cells = {"4 0 1 2 3", "4 0 4 1 5", "4 1 4 2 5", "4 2 4 0 5"};
  file.types = {10, 10, 10, 10};
  file.tags = {1, 1, 1, 1};
  expect_refused("hanging.vtk", file.text(), {"ertex 4", "(0.25, 0.25, 0)"});
}

TEST(BadInput, FeaturesThatAreNoEntitiesOfTets) {
  expect_refused("face.vtk", VtkText().add("3 0 1 4", 5, 2).text(), {"vertices 0, 1, 4", "no face of a tet"});
  expect_refused("edge.vtk", VtkText().add("2 0 4", 3, 2).text(), {"vertices 0, 4 at (0.5, 0.5, 0.5)", "no edge"});
  VtkText file;
  file.points.emplace_back("3 3 3");
  expect_refused("point.vtk", file.add("1 5", 1, 2).text(), {"vertex 5 at (3, 3, 3)"});
  EXPECT_EQ(refusal(write_text("untagged.vtk", VtkText().add("2 0 4", 3, 0).text())), "accepted");
}

TEST(BadInput, OtherCellsAreNamed) {
  expect_refused("quad.vtk", VtkText().add("4 0 1 2 3", 9, 1).text(), {"cell 2 (quadrilateral)"});
  expect_refused("wedge.vtk", VtkText().add("6 0 1 2 3 4 0", 13, 1).text(), {"cell 2 has VTK type 13"});
  expect_refused("corners.vtk", VtkText().add("3 0 1 2", 10, 1).text(), {"cell 2 is a tetrahedron but has 3"});
  const std::string head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 0 0\n$EndNodes\n$Elements\n1\n";
  expect_refused("second.msh", head + "1 11 2 1 1 1 1 1 1 1 1 1 1 1 1\n$EndElements\n", {"line 10", "Gmsh type 11"});
  expect_refused("node.msh", head + "1 15 2 1 1 6\n$EndElements\n", {"element 1 names the node 6"});
  expect_refused("four.msh", "$MeshFormat\n4 0 8\n$EndMeshFormat\n", {"MSH version 4 is not known"});
  expect_refused("bytes.msh", "$MeshFormat\n4.1 0 4\n$EndMeshFormat\n", {"data size is 4"});
  expect_refused("flat.mesh", "MeshVersionFormatted 2\nDimension 2\n", {"the dimension is 2"});
  expect_refused("range.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices 1\n0 0 0 0\nEdges\n1\n1 2 1\n",
                 {"line 7", "line 1 names vertex 2"});
}

TEST(BadInput, HexexFiles) {
  const std::string points = "4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  const std::string tets = "1\n0 1 2 3 0 0 0 1 0 0 0 1 0 0 0 1\n";
  EXPECT_EQ(refusal(write_text("good.hexex", points + tets)), "accepted");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = points + tets;
    return text.replace(text.rfind(from), from.size(), to);
  };
  expect_refused("zero.hexex", with("1\n", "1/0\n"), {"line 7", "zero below the line"});
  expect_refused("fraction.hexex", with("1\n", "1/2/3\n"), {"no fraction"});
  expect_refused("nan.hexex", with("1\n", "nan\n"), {"no finite number"});
  expect_refused("range.hexex", with("0 1 2 3", "0 1 2 4"), {"line 7", "vertex 4 does not exist"});
  expect_refused("twice.hexex", with("0 1 2 3", "0 1 2 2"), {"line 7", "tet 0 has a vertex twice"});
  expect_refused("three.hexex", points + "3\n" + tets.substr(2) + tets.substr(2) + tets.substr(2),
                 {"more than two tets", "0, 1, 2"});
  expect_refused("none.hexex", points + "0\n", {"no tetrahedra"});
  expect_refused("more.hexex", points + tets + "0 0 0\n7\n", {"goes on"});
  expect_refused("edge.hexex", points + tets + "0 1 0\n1 1\n", {"feature edge 0 (1, 1)"});
  expect_refused("cut.hexex", points + "3\n0 1 2 3 0 0 0\n", {"cut off"});
}

TEST(BadInput, EveryTruncationIsRefusedOrReadWithoutACrash) {
  const TetInput box = samples::tagged_box();
  const struct {
    const char* name;
    WriteOptions options;
  } files[] = {{"cut.vtk", {std::nullopt, false}},  {"cutb.vtk", {std::nullopt, true}},
               {"cut.msh", {std::nullopt, false}},  {"cutb.msh", {std::nullopt, true}},
               {"cut.msh2", {std::nullopt, false}}, {"cutb.msh2", {std::nullopt, true}},
               {"cut.mesh", {std::nullopt, false}}};
  for (const auto& [name, options] : files) {
    write_tet_mesh(scratch_file(name), box.mesh, box.features, options);
    const std::string whole = hexfield::testing::bytes_of(scratch_file(name));
    std::size_t accepted = 0;
    for (std::size_t length = 0; length < whole.size(); length += 7)
      if (refusal(write_text(name, whole.substr(0, length))) == "accepted") ++accepted;
    EXPECT_LE(accepted, 3u) << name;  // only the last line break, or Medit's End, can be missing
  }
}

TEST(BadInput, AHexMeshIsNoTetMeshAndTheOtherWayRound) {
  write_hex_mesh(scratch_file("hexes.vtk"), samples::tagged_hexes());
  EXPECT_THAT(refusal(scratch_file("hexes.vtk")), HasSubstr("(hexahedron) at"));
  const TetInput box = samples::tagged_box();
  write_tet_mesh(scratch_file("tets.vtk"), box.mesh, box.features);
  EXPECT_THROW(read_hex_mesh(scratch_file("tets.vtk")), Error);
}

TEST(BadInput, CheckListsEveryDefectByTheIdsOfTheFile) {
  VtkText file;
  file.add("4 2 0 1 3", 10, 1).add("3 0 1 4", 5, 2).add("2 0 4", 3, 2);
  const auto found = check_tet_file(write_text("many.vtk", file.text()));
  EXPECT_EQ(found.size(), 3u);
  EXPECT_TRUE(check_tet_file(write_text("good.vtk", VtkText().text())).empty());
}
