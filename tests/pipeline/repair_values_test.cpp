#include "../src/pipeline/repair_values.hpp"

#include <gtest/gtest.h>

#include "support/repair_states.hpp"

using namespace hexfield;

TEST(RepairValues, AnIterateComesBackBitForBit) {
  RepairIterate iterate;
  iterate.state = hexfield::testing::zipper_state();
  const EdgeKey edge = iterate.state.codes.begin()->first;
  iterate.state.pairs[edge] = 3;
  iterate.state.kept.insert(edge);
  iterate.state.target_length[2] = 0.1;
  iterate.report.before = {2, 1, {{"zipper", 2}}};
  iterate.report.operations = {{"unzip free zipper nodes", 4}};
  iterate.report.seconds = {{"relocate", 0.1 + 0.2}};
  iterate.report.iterations = 5;
  iterate.compound_shrink = 4;
  iterate.stale_rounds = 1;
  iterate.fewest_defects = 7;
  iterate.verdicts.note(~std::uint64_t{0}, VertexVerdict::not_meshable);
  iterate.verdicts.note(1, VertexVerdict::meshable_when_split);
  const RepairIterate back = unpack_repair_iterate(pack(iterate));
  EXPECT_EQ(back.state.mesh.tets, iterate.state.mesh.tets);
  EXPECT_EQ(back.state.mesh.opposite, iterate.state.mesh.opposite);
  EXPECT_EQ(back.state.mesh.vertex_tet, iterate.state.mesh.vertex_tet);
  EXPECT_EQ(back.state.field.matchings, iterate.state.field.matchings);
  EXPECT_EQ(back.state.codes, iterate.state.codes);
  EXPECT_EQ(back.state.pairs, iterate.state.pairs);
  EXPECT_EQ(back.state.kept, iterate.state.kept);
  EXPECT_EQ(back.state.target_length, iterate.state.target_length);
  EXPECT_EQ(back.report.before.kinds, iterate.report.before.kinds);
  EXPECT_EQ(back.report.operations, iterate.report.operations);
  EXPECT_EQ(back.report.seconds, iterate.report.seconds);
  EXPECT_EQ(back.report.iterations, 5);
  EXPECT_EQ(back.compound_shrink, 4);
  EXPECT_EQ(back.stale_rounds, 1);
  EXPECT_EQ(back.fewest_defects, 7);
  EXPECT_EQ(back.verdicts.all(), iterate.verdicts.all());
}
