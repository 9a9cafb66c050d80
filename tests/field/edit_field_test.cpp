#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "hexfield/field/edge_codes.hpp"
#include "hexfield/field/matchings.hpp"
#include "hexfield/mesh/edit_legality.hpp"
#include "support/meshes.hpp"

using namespace hexfield;
using octahedral::Rotation;

namespace {

// A field with many singular edges: identity frames in random charts, and some matchings multiplied by chance.
FrameField noisy_field(const TetMesh& mesh, std::mt19937& random) {
  FrameField field;
  field.frames.assign(mesh.num_tets(), Quaternion::Identity());
  compute_matchings(mesh, field);
  for (std::size_t i = 0; i < mesh.num_tets(); ++i)
    change_gauge(mesh, field, TetId(i), static_cast<Rotation>(random() % octahedral::order));
  for (std::size_t n = 0; n < mesh.num_tets() / 12; ++n) {
    const HalfFaceId h(static_cast<std::int64_t>(random() % (4 * mesh.num_tets())));
    const HalfFaceId o = mesh.opposite_half_face(h);
    if (!o.valid()) continue;
    auto& m = field.matchings[h.tet().index()][static_cast<std::size_t>(h.local())];
    m = octahedral::product(m, static_cast<Rotation>(random() % octahedral::order));
    field.matchings[o.tet().index()][static_cast<std::size_t>(o.local())] = octahedral::inverse(m);
  }
  return field;
}

// Conjugacy class of the monodromy of every inner edge: what a change of charts and start keeps.
std::map<EdgeKey, std::pair<double, bool>> classes(const TetMesh& mesh, const FrameField& field) {
  std::map<EdgeKey, std::pair<double, bool>> found;
  for (const auto& [e, t] : all_edges(mesh)) {
    const EdgeRing ring = edge_ring(mesh, t, e[0], e[1]);
    if (!ring.closed) continue;
    const Rotation m = monodromy(field, ring);
    found[e] = {octahedral::matrix(m).trace(), octahedral::is_axial(m)};
  }
  return found;
}

}  // namespace

TEST(FieldUnderEdits, CollapsesKeepMonodromiesOfEdgesThatDoNotMerge) {
  std::mt19937 random(3);
  TetMesh mesh = hexfield::testing::kuhn_box(4, 4, 4);
  FrameField field = noisy_field(mesh, random);
  FieldAttribute attribute(field);
  const Features none;
  int collapses = 0, compared = 0;
  for (int i = 0; i < 400 && collapses < 40; ++i) {
    const TetId t(static_cast<std::int64_t>(random() % mesh.num_tets()));
    if (!mesh.alive(t)) continue;
    const VertexId from = mesh.vertices(t)[random() % 4], to = mesh.vertices(t)[random() % 4];
    if (from == to || !collapse_keeps_topology(mesh, none, from, to) || !collapse_keeps_positive(mesh, from, to))
      continue;
    auto before = classes(mesh, field);
    collapse_edge(mesh, from, to, {&attribute});
    ++collapses;
    ASSERT_TRUE(check(mesh, field).empty());
    for (const auto& [e, c] : classes(mesh, field)) {
      EdgeKey old = e;
      if (!before.contains(old)) old = e[0] == to ? edge_key(from, e[1]) : edge_key(from, e[0]);
      ASSERT_TRUE(before.contains(old));
      const bool merged =
          (e[0] == to || e[1] == to) && before.contains(e) && before.contains(edge_key(from, e[0] == to ? e[1] : e[0]));
      if (merged) continue;
      EXPECT_EQ(c, before.at(old));
      compared += c.first < 3;
    }
  }
  EXPECT_EQ(collapses, 40);
  EXPECT_GT(compared, 1000);  // of singular edges
}

TEST(FieldUnderEdits, SwapsAtRegularEdgesKeepMonodromiesAndGiveRegularEdges) {
  std::mt19937 random(4);
  TetMesh mesh = hexfield::testing::kuhn_box(4, 4, 4);
  for (Vec3& p : mesh.points) p += 0.02 * Vec3::Random();
  FrameField field = noisy_field(mesh, random);
  FieldAttribute attribute(field);
  const Features none;
  int edge_swaps = 0, face_swaps = 0;
  for (int i = 0; i < 4000 && edge_swaps + face_swaps < 80; ++i) {
    const TetId t(static_cast<std::int64_t>(random() % mesh.num_tets()));
    if (!mesh.alive(t)) continue;
    const auto before = classes(mesh, field);
    const HalfFaceId h(t, static_cast<int>(random() % 4));
    const VertexId a = mesh.vertices(t)[random() % 4], b = mesh.vertices(t)[random() % 4];
    EdgeKey gone{};
    if (i % 2 == 0) {
      if (!can_swap_face(mesh, none, h)) continue;
      swap_face(mesh, h, {&attribute});
      ++face_swaps;
    } else {
      if (a == b) continue;
      gone = edge_key(a, b);
      const EdgeRing ring = edge_ring(mesh, t, a, b);
      if (!ring.closed || monodromy(field, ring) != octahedral::identity) continue;
      const auto around = ring_vertices(mesh, ring, a, b);
      RingTriangulation fan;
      for (int k = 1; k + 1 < static_cast<int>(around.size()); ++k) fan.triangles.push_back({0, k, k + 1});
      if (!swap_keeps_topology(mesh, none, ring, around, fan, a, b) || !swap_keeps_positive(mesh, around, fan, a, b))
        continue;
      swap_edge(mesh, t, a, b, fan, {&attribute});
      ++edge_swaps;
    }
    ASSERT_TRUE(check(mesh).empty());
    ASSERT_TRUE(check(mesh, field).empty());
    const auto after = classes(mesh, field);
    for (const auto& [e, c] : after) EXPECT_EQ(c, before.contains(e) ? before.at(e) : std::pair(3.0, true));
    for (const auto& [e, c] : before) EXPECT_TRUE(e == gone || after.contains(e));
  }
  EXPECT_GT(edge_swaps, 15);
  EXPECT_GT(face_swaps, 15);
}
