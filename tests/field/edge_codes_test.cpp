#include "hexfield/field/edge_codes.hpp"

#include <gtest/gtest.h>

#include <random>

#include "box_features.hpp"
#include "fans.hpp"
#include "hexfield/field/constraints.hpp"
#include "hexfield/field/matchings.hpp"
#include "hexfield/field/singularity_graph.hpp"

using namespace hexfield;
using hexfield::testing::fan;
using hexfield::testing::turning_field;

namespace {

const VertexId bottom(0), top(1);

EdgeCode code_of_fan(double degrees, int n) {
  const TetMesh mesh = fan(n, 360);
  const FrameField field = turning_field(mesh, n, degrees);
  return edge_code(mesh, {}, field, edge_ring(mesh, TetId(0), bottom, top), bottom, top);
}

octahedral::Rotation monodromy_of_fan(double degrees, int n) {
  const TetMesh mesh = fan(n, 360);
  return monodromy(turning_field(mesh, n, degrees), edge_ring(mesh, TetId(0), bottom, top));
}

void random_gauge(const TetMesh& mesh, FrameField& field, unsigned seed) {
  std::mt19937 random(seed);
  for (std::size_t i = 0; i < mesh.num_tets(); ++i)
    change_gauge(mesh, field, TetId(static_cast<std::int64_t>(i)), static_cast<octahedral::Rotation>(random() % 24));
}

}  // namespace

TEST(EdgeCodes, FansOfTurningFrames) {
  using namespace octahedral;
  EXPECT_EQ(code_of_fan(90, 6), -1);
  EXPECT_EQ(monodromy_of_fan(90, 6), inverse(quarter_turn(4)));  // R_z(-90 degrees)
  EXPECT_EQ(code_of_fan(-90, 6), 1);
  EXPECT_EQ(code_of_fan(0, 6), 0);
  EXPECT_EQ(code_of_fan(-270, 8), 3);
  EXPECT_EQ(monodromy_of_fan(-270, 8), monodromy_of_fan(90, 6));
  EXPECT_EQ(code_of_fan(-270, 5), -2);
  EXPECT_EQ(code_of_fan(360, 12), -4);
  EXPECT_EQ(monodromy_of_fan(360, 12), identity);
}

TEST(EdgeCodes, OutgoingLabelsNegateUnderReversalAndFollowTheIndex) {
  for (double degrees : {90.0, -90.0, -270.0}) {
    const int n = 8;
    const TetMesh mesh = fan(n, 360);
    const FrameField field = turning_field(mesh, n, degrees);
    const EdgeRing up = edge_ring(mesh, TetId(0), bottom, top);
    const EdgeRing down = edge_ring(mesh, TetId(0), top, bottom);
    const EdgeCode code = edge_code(mesh, {}, field, up, bottom, top);
    EXPECT_EQ(edge_code(mesh, {}, field, down, top, bottom), code);
    const auto label = outgoing_label(mesh, field, up, code, bottom, top);
    EXPECT_EQ(label, 4);
    EXPECT_EQ(outgoing_label(mesh, field, down, code, top, bottom), octahedral::negate(label));
    // monodromy = R_label(-2 pi I), I = -code / 4
    octahedral::Rotation expected = octahedral::identity;
    for (int k = 0; k < ((code % 4) + 4) % 4; ++k)
      expected = octahedral::product(expected, octahedral::quarter_turn(label));
    EXPECT_EQ(monodromy(field, up), expected);
  }
}

TEST(EdgeCodes, OpenSectorsBetweenFaces) {
  const struct {
    double angle, turn;
    int quads;
  } cases[] = {{180, 0, 2}, {90, 0, 1}, {270, 0, 3}, {60, -30, 1}, {60, 60, 0}, {20, 20, 0}, {350, -10, 4}};
  for (const auto& c : cases) {
    const int n = 6;
    const TetMesh mesh = fan(n, c.angle);
    FrameField field = turning_field(mesh, n, c.turn);
    random_gauge(mesh, field, 3);
    const EdgeRing ring = edge_ring(mesh, TetId(0), bottom, top);
    const auto found = sectors(mesh, {}, field, ring, bottom, top);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found[0].dihedral, c.angle * M_PI / 180, 1e-9);
    EXPECT_EQ(found[0].quads, c.quads) << c.angle << " degrees, frames turn by " << c.turn;
    EXPECT_EQ(edge_code(mesh, {}, field, ring, bottom, top), c.quads - 2);
  }
}

TEST(EdgeCodes, GaugeChangesAndCombingKeepCodesSectorsAndNodes) {
  for (double degrees : {90.0, -90.0, -270.0, 0.0}) {
    const TetMesh mesh = fan(8, 360);
    const Features features = hexfield::testing::sharp_features(mesh);
    FrameField field = turning_field(mesh, 8, degrees);
    const EdgeCodes codes = compute_codes(mesh, features, field);
    const auto graph = singularity_graph(mesh, features, field, codes);
    for (unsigned seed = 0; seed < 5; ++seed) {
      random_gauge(mesh, field, seed);
      EXPECT_TRUE(check(mesh, field).empty());
      EXPECT_EQ(compute_codes(mesh, features, field), codes);
      const auto again = singularity_graph(mesh, features, field, codes);
      ASSERT_EQ(again.nodes.size(), graph.nodes.size());
      for (std::size_t i = 0; i < graph.nodes.size(); ++i) EXPECT_EQ(again.nodes[i].kind, graph.nodes[i].kind);
    }
    comb(mesh, field);
    EXPECT_TRUE(check(mesh, field).empty());
    EXPECT_EQ(compute_codes(mesh, features, field), codes);
    int not_identity = 0;
    for (const auto& m : field.matchings)
      for (auto r : m) not_identity += r != octahedral::identity;
    EXPECT_LE(not_identity, 2);  // one cut face of the only closed ring, seen from both sides
  }
}

TEST(EdgeCodes, ConstraintsOfABoxNameAxesThatTheFrameHas) {
  const TetMesh mesh = hexfield::testing::kuhn_box(2, 2, 2);
  const Features features = hexfield::testing::sharp_features(mesh);
  FrameField field;
  field.frames.assign(mesh.num_tets(), Quaternion::Identity());
  compute_matchings(mesh, field);
  random_gauge(mesh, field, 9);
  const auto constraints = collect_constraints(mesh, features, field, compute_codes(mesh, features, field));
  std::size_t faces = 0, edges = 0;
  for (const AxisConstraint& c : constraints) {
    EXPECT_LT((field.frames[c.tet.index()] * octahedral::direction(c.label) - c.direction).norm(), 1e-12);
    faces += c.kind == AxisConstraint::Kind::feature_face;
    edges += c.kind == AxisConstraint::Kind::feature_edge;
  }
  EXPECT_EQ(faces, features.faces.size());
  EXPECT_GE(edges, features.edges.size());
}
