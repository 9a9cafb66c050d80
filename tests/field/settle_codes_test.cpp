#include "hexfield/field/settle_codes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hexfield/field/edge_codes.hpp"
#include "hexfield/field/matchings.hpp"
#include "support/meshes.hpp"

using namespace hexfield;
using namespace hexfield::testing;

namespace {

// A box whose y-edges have dihedral angles of `degrees` at x = 0, z = 0 and of 180 - degrees beside it, under a field
// that lies in the middle between the two slanted sides.
struct Slanted {
  TetMesh mesh;
  Features features;
  FrameField field;
  EdgeCodes codes;
};

Slanted slanted_box(double degrees) {
  Slanted state;
  state.mesh = kuhn_box(3, 3, 3);
  const double angle = degrees * M_PI / 180;
  for (Vec3& p : state.mesh.points) p = Vec3(p.x() + std::cos(angle) * p.z(), p.y(), std::sin(angle) * p.z());
  state.features = features_from_angles(state.mesh, 30);
  complete_features(state.mesh, state.features);
  const double middle = (90 - degrees) / 2 * M_PI / 180;
  state.field.frames.assign(state.mesh.num_tets(), Quaternion(Eigen::AngleAxisd(middle, Vec3::UnitY())));
  state.field.matchings.assign(state.mesh.num_tets(), {});
  state.codes = compute_codes(state.mesh, state.features, state.field);
  return state;
}

// The edge (0, y, 0)-(0, y + 1, 0).
EdgeKey edge_from(const Slanted& state, int y) {
  const auto at = [&](const Vec3& p) {
    return VertexId(std::ranges::find(state.mesh.points, p) - state.mesh.points.begin());
  };
  return edge_key(at(Vec3(0, y, 0)), at(Vec3(0, y + 1, 0)));
}

EdgeCode code_of(const Slanted& state, const EdgeKey& e) {
  const auto found = state.codes.find(e);
  return found == state.codes.end() ? 0 : found->second;
}

// Turns the frames across an inner face at that edge by a quarter about it.
void turn_beside(Slanted& state, int y = 1) {
  const auto [a, b] = edge_from(state, y);
  const HalfFaceId h = edge_ring(state.mesh, find_tet_with_edge(state.mesh, a, b), a, b).crossings[0];
  const HalfFaceId o = state.mesh.opposite_half_face(h);
  const auto turn = octahedral::quarter_turn(2);
  state.field.matchings[h.tet().index()][static_cast<std::size_t>(h.local())] = turn;
  state.field.matchings[o.tet().index()][static_cast<std::size_t>(o.local())] = octahedral::inverse(turn);
  state.codes = compute_codes(state.mesh, state.features, state.field);
}

}  // namespace

TEST(SettleCodes, ABluntEdgeGivesBackTheQuadThatOnePieceOfItTook) {
  for (double degrees : {50.0, 58.0}) {
    Slanted state = slanted_box(degrees);
    const EdgeCodes smooth = state.codes;
    turn_beside(state);
    ASSERT_NE(state.codes, smooth);
    EXPECT_EQ(settle_blunt_edges(state.mesh, state.features, state.field, state.codes), 1) << degrees;
    EXPECT_EQ(state.codes, smooth) << degrees;
    EXPECT_EQ(compute_codes(state.mesh, state.features, state.field), smooth) << degrees;
  }
}

// Pieces of the arc inside and pieces on the curve become one.
TEST(SettleCodes, ABluntCurveGetsOneCode) {
  Slanted state = slanted_box(50);
  for (int y : {0, 1}) turn_beside(state, y);
  ASSERT_NE(code_of(state, edge_from(state, 1)), code_of(state, edge_from(state, 2)));
  settle_blunt_edges(state.mesh, state.features, state.field, state.codes);
  for (int y : {0, 1}) EXPECT_EQ(code_of(state, edge_from(state, y)), code_of(state, edge_from(state, 2))) << y;
  EXPECT_EQ(compute_codes(state.mesh, state.features, state.field), state.codes);
}

TEST(SettleCodes, AngularEdgesAreLeftAlone) {
  Slanted state = slanted_box(85);
  turn_beside(state);
  const EdgeCodes turned = state.codes;
  EXPECT_EQ(settle_blunt_edges(state.mesh, state.features, state.field, state.codes), 0);
  EXPECT_EQ(state.codes, turned);
}
