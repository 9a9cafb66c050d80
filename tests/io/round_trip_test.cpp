#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "hexfield/io/hex_io.hpp"
#include "hexfield/io/tet_io.hpp"
#include "io/samples.hpp"

using namespace hexfield;
using samples::expect_same;
using samples::scratch_file;

namespace {

struct Variant {
  std::string file;
  WriteOptions options;
  bool names;
};

// Every format that can be read back.
std::vector<Variant> variants() {
  return {{"mesh.vtk", {MeshFormat::vtk, false}, false},  {"meshb.vtk", {MeshFormat::vtk, true}, false},
          {"mesh.msh", {MeshFormat::msh41, false}, true}, {"meshb.msh", {MeshFormat::msh41, true}, true},
          {"old.msh", {MeshFormat::msh22, false}, true},  {"oldb.msh", {MeshFormat::msh22, true}, true},
          {"mesh.mesh", {std::nullopt, false}, false},    {"mesh.vtu", {MeshFormat::vtu, false}, true},
          {"meshb.vtu", {MeshFormat::vtu, true}, true}};
}

}  // namespace

TEST(RoundTrip, TetsSurviveEveryPairOfFormats) {
  for (const Variant& first : variants())
    for (const Variant& second : variants()) {
      SCOPED_TRACE(first.file + " -> " + second.file);
      TetInput input = samples::tagged_box();
      write_tet_mesh(scratch_file("1" + first.file), input.mesh, input.features, first.options);
      const TetInput once = read_tet_mesh(scratch_file("1" + first.file));
      if (!first.names) input.features.names.clear();
      expect_same(once, input);
      write_tet_mesh(scratch_file("2" + second.file), once.mesh, once.features, second.options);
      if (!second.names) input.features.names.clear();
      expect_same(read_tet_mesh(scratch_file("2" + second.file)), input);
    }
}

TEST(RoundTrip, HexesSurviveEveryPairOfFormats) {
  for (const Variant& first : variants())
    for (const Variant& second : variants()) {
      SCOPED_TRACE(first.file + " -> " + second.file);
      HexMesh mesh = samples::tagged_hexes();
      write_hex_mesh(scratch_file("1" + first.file), mesh, first.options);
      const HexMesh once = read_hex_mesh(scratch_file("1" + first.file));
      if (!first.names) mesh.names.clear();
      expect_same(once, mesh);
      write_hex_mesh(scratch_file("2" + second.file), once, second.options);
      if (!second.names) mesh.names.clear();
      expect_same(read_hex_mesh(scratch_file("2" + second.file)), mesh);
    }
}

TEST(RoundTrip, OneUnnamedVolumeHasNoColours) {
  TetInput input = samples::tagged_box();
  input.features.tet_colours.clear();
  input.features.names.clear();
  for (const Variant& v : variants()) {
    write_tet_mesh(scratch_file(v.file), input.mesh, input.features, v.options);
    expect_same(read_tet_mesh(scratch_file(v.file)), input);
  }
}

TEST(RoundTrip, OneVolumeKeepsItsNameAndColour) {
  TetInput input = samples::tagged_box();
  input.features.tet_colours.assign(input.mesh.num_tets(), 1);
  input.features.names = {{{3, 1}, "steel"}};
  write_tet_mesh(scratch_file("one.msh"), input.mesh, input.features);
  expect_same(read_tet_mesh(scratch_file("one.msh")), input);
}

TEST(RoundTrip, AnUnknownExtensionIsAMistakeOfUse) {
  try {
    write_hex_mesh(scratch_file("mesh.stl"), samples::tagged_hexes());
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(error.sentence().find("mesh.stl"), std::string::npos);
    EXPECT_NE(error.sentence().find("vtu"), std::string::npos);
  }
  EXPECT_FALSE(std::filesystem::exists(scratch_file("mesh.stl")));
}
