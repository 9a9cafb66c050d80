#include "../src/pipeline/quantize_values.hpp"

#include <gtest/gtest.h>

#include "hexfield/base/error.hpp"

using namespace hexfield;

TEST(QuantizeValues, ComeBackBitForBit) {
  QuantizeResult result;
  result.kind = "ilp";
  result.integers.lengths = {3, 0, -1};
  result.integers.method = QuantizeMethod::ilp;
  result.integers.scale = 0.1 + 0.2;
  result.integers.objective = 1.0 / 3;
  result.integers.hexes = 12;
  result.integers.rounds = 2;
  result.integers.separations = 4;
  result.integers.sheets = 5;
  result.integers.proven_optimal = true;
  result.wanted = {2.9, 0.2, 0.3};
  result.unknowns = {1, 2, 0.1};
  result.stretches = {Vec3(0.1, 2, 1.0 / 3), Vec3(1, 1, 1)};
  result.largest_move = 1e-12;
  result.nodes = 8, result.arcs = 12, result.patches = 6, result.blocks = 1, result.euler = 1;
  result.seconds = {{"exact", 0.1 + 0.7}};
  result.notes = {"One \"sentence\".", "Another."};
  result.picture.points = {Vec3(0.1, 0.2, 0.3), Vec3(1, 2, 3), Vec3(4, 5, 6)};
  result.picture.triangles = {{0, 1, 2}};
  result.picture.walls = {{7, 0, -1, 1}};
  result.picture.lines = {{1, 2}, {0, 1}};
  result.picture.arcs = {{0, -1, 1, 3}, {1, 0, 0, 0}};
  const NamedArrays arrays = pack(result);
  const QuantizeResult back = unpack_quantize(arrays);
  EXPECT_EQ(back.kind, result.kind);
  EXPECT_EQ(back.integers.lengths, result.integers.lengths);
  EXPECT_EQ(back.integers.method, result.integers.method);
  EXPECT_EQ(back.integers.scale, result.integers.scale);
  EXPECT_EQ(back.integers.objective, result.integers.objective);
  EXPECT_EQ(back.integers.hexes, 12);
  EXPECT_EQ(back.integers.rounds, 2);
  EXPECT_EQ(back.integers.separations, 4u);
  EXPECT_EQ(back.integers.sheets, 5u);
  EXPECT_TRUE(back.integers.proven_optimal);
  EXPECT_EQ(back.wanted, result.wanted);
  EXPECT_EQ(back.unknowns, result.unknowns);
  EXPECT_EQ(back.stretches, result.stretches);
  EXPECT_EQ(back.largest_move, result.largest_move);
  EXPECT_EQ(back.nodes, 8);
  EXPECT_EQ(back.arcs, 12);
  EXPECT_EQ(back.patches, 6);
  EXPECT_EQ(back.blocks, 1);
  EXPECT_EQ(back.euler, 1);
  EXPECT_EQ(back.seconds, result.seconds);
  EXPECT_EQ(back.notes, result.notes);
  EXPECT_EQ(back.picture.points, result.picture.points);
  EXPECT_EQ(back.picture.triangles, result.picture.triangles);
  EXPECT_EQ(back.picture.walls, result.picture.walls);
  EXPECT_EQ(back.picture.lines, result.picture.lines);
  EXPECT_EQ(back.picture.arcs, result.picture.arcs);

  // Next to the first place is arc 1 (0.2 off), next to the second arc 0 (0.1 off).
  EXPECT_EQ(spacing_near(back, {Vec3(0.5, 1, 1.5), Vec3(4, 5, 6)}),
            "The arc at (0.1, 0.2, 0.3) is to hold 0 hexes where the map has room for 0.2.");
  EXPECT_EQ(spacing_near(back, {Vec3(4, 5, 6)}),
            "The arc at (1, 2, 3) is to hold 3 hexes where the map has room for 2.9.");
  EXPECT_EQ(spacing_near(back, {}), "");

  NamedArrays spoilt = arrays;
  spoilt.own_text("quantize_words", "{}");
  EXPECT_THROW(unpack_quantize(spoilt), Error);
  EXPECT_THROW(joined(arrays, arrays), Error);
}
