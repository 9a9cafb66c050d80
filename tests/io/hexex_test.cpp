#include "hexfield/io/hexex_io.hpp"

#include <gtest/gtest.h>

#include "io/samples.hpp"

using namespace hexfield;
using samples::scratch_file;
using samples::write_text;

namespace {

// Two tets that share a face; the second one's chart is turned and shifted.
std::string two_tets(const std::string& tail) {
  return "5\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 0 -1\n2\n"
         "0 1 2 3  0 0 0  1 0 0  0 1 0  0 0 1/3\n"
         "0 2 1 4  5/1 0 0  5 0 -1  5 1 0  10/4 0 0\n" +
         tail;
}

}  // namespace

TEST(Hexex, RationalsAreReadAsTheNearestDouble) {
  const HexexInput input = read_hexex(write_text("two.hexex", two_tets("")));
  EXPECT_EQ(input.map.uvw[0][3].z(), 1.0 / 3);
  EXPECT_EQ(input.map.uvw[1][3].x(), 2.5);
  EXPECT_TRUE(input.walls.empty());
  EXPECT_TRUE(input.features.points.empty());
}

TEST(Hexex, LongRationalsRoundCorrectly) {
  const std::string big = "49539595901075460000000000000000000000000000001/7000000000000000000000000000000000000";
  std::string text = two_tets("");
  text.replace(text.find("1/3"), 3, big);
  EXPECT_EQ(read_hexex(write_text("big.hexex", text)).map.uvw[0][3].z(), 7077085128.725066);
}

TEST(Hexex, TransitionsAreFoundFromTheCharts) {
  const HexexInput input = read_hexex(write_text("two.hexex", two_tets("")));
  const HalfFaceId h(TetId(0), 3);
  const auto r = input.map.rotation(h);
  const Vec3 t = transition_translation(input.mesh, input.map, h);
  for (VertexId v : input.mesh.face_vertices(h)) {
    const auto here = static_cast<std::size_t>(input.mesh.local_index(TetId(0), v));
    const auto there = static_cast<std::size_t>(input.mesh.local_index(TetId(1), v));
    EXPECT_LT((octahedral::apply(r, input.map.uvw[0][here]) + t - input.map.uvw[1][there]).norm(), 1e-14);
  }
  EXPECT_EQ(input.map.rotation(input.mesh.opposite_half_face(h)), octahedral::inverse(r));
  EXPECT_EQ(input.map.rotation(HalfFaceId(TetId(0), 0)), octahedral::identity);
}

TEST(Hexex, WallsAndFeaturesAreTakenInAnyCombination) {
  const std::string walls = "1\n0 1 2 0.5\n";
  const std::string features = "1 2 1\n3\n0 1\n0 2\n0 1 2\n";
  for (const bool with_walls : {false, true})
    for (const bool with_features : {false, true}) {
      const auto tail = (with_walls ? walls : "") + (with_features ? features : "");
      const HexexInput input = read_hexex(write_text("parts.hexex", two_tets(tail)));
      EXPECT_EQ(input.walls.size(), with_walls ? 1u : 0u);
      EXPECT_EQ(input.features.points.size(), with_features ? 1u : 0u);
      EXPECT_EQ(input.features.edges.size(), with_features ? 2u : 0u);
      EXPECT_EQ(input.features.faces.size(), with_features ? 1u : 0u);
    }
}

TEST(Hexex, TurnedTetsAreReported) {
  std::string text = two_tets("");
  text.replace(text.find("0 2 1 4  5/1 0 0  5 0 -1  5 1 0"), 31, "0 1 2 4  5/1 0 0  5 1 0  5 0 -1");
  const HexexInput input = read_hexex(write_text("turned.hexex", text));
  EXPECT_EQ(input.turned, std::vector<TetId>{TetId(1)});
  EXPECT_TRUE(check(input.mesh).empty());
  EXPECT_EQ(input.mesh.opposite_half_face(HalfFaceId(TetId(0), 3)).tet(), TetId(1));
}

TEST(Hexex, WhatIsWrittenIsReadBack) {
  const HexexInput input = read_hexex(write_text("two.hexex", two_tets("1 1 1\n3\n0 1\n0 1 2\n")));
  const auto file = scratch_file("again.hexex");
  write_hexex(file, input.mesh, input.map, input.features);
  const HexexInput again = read_hexex(file);
  samples::expect_same({again.mesh, again.features}, {input.mesh, input.features});
  EXPECT_EQ(again.map.uvw, input.map.uvw);
  EXPECT_EQ(again.map.rotations, input.map.rotations);
}
