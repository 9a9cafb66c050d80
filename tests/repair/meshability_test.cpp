#include "hexfield/repair/meshability.hpp"

#include <gtest/gtest.h>

#include "hexfield/field/edge_codes.hpp"
#include "support/cones.hpp"
#include "support/repair_states.hpp"

using namespace hexfield;
using hexfield::testing::box_state;
using hexfield::testing::change_gauges;
using hexfield::testing::cone;
using hexfield::testing::Cone;
using hexfield::testing::shake;
using hexfield::testing::sphere_points;
using hexfield::testing::Triangle;
using hexfield::testing::vertex_at;
using hexfield::testing::zipper_state;

namespace {

// Judges a map without the code that made it: positive tets, one image per direction across faces, feature faces in
// coordinate planes, special edges on axes.
void expect_seamless(const FieldView& view, VertexId v, const std::vector<MappedTet>& map) {
  ASSERT_FALSE(map.empty());
  for (const MappedTet& m : map) {
    EXPECT_GT(m.directions[0].dot(m.directions[1].cross(m.directions[2])), 0);
    EXPECT_GT(m.images[0].dot(m.images[1].cross(m.images[2])), 0);
    for (std::size_t k = 0; k < 3; ++k)
      for (const auto& [keys, colour] : view.features.edges) {
        if (keys[0] != v && keys[1] != v) continue;
        const Vec3 e = (view.mesh.point(keys[0] == v ? keys[1] : keys[0]) - view.mesh.point(v)).normalized();
        if ((e - m.directions[k]).norm() < 1e-12) {
          EXPECT_NEAR(m.images[k].cwiseAbs().maxCoeff(), m.images[k].norm(), 1e-12);
        }
      }
    for (int f = 0; f < 4; ++f) {
      const HalfFaceId h(m.tet, f);
      if (view.mesh.vertices(m.tet)[static_cast<std::size_t>(f)] == v) continue;
      const Vec3 normal = outward_normal(view.mesh, h);
      const bool feature = view.mesh.is_boundary(h);
      const auto label = closest_label(view.field.frames[m.tet.index()], normal);
      for (std::size_t k = 0; k < 3; ++k) {
        if (std::abs(normal.dot(m.directions[k])) > 1e-9) continue;
        if (feature) {
          EXPECT_NEAR(m.images[k].dot(octahedral::direction(label)), 0, 1e-12);
          continue;
        }
        const Mat3& there = octahedral::matrix(octahedral::inverse(view.field.matching(h)));
        int met = 0;
        for (const MappedTet& o : map)
          for (std::size_t j = 0; j < 3; ++j)
            if (o.tet == view.mesh.opposite_half_face(h).tet() && (o.directions[j] - m.directions[k]).norm() < 1e-12) {
              EXPECT_NEAR((o.images[j] - there * m.images[k]).norm(), 0, 1e-12);
              ++met;
            }
        EXPECT_GE(met, 1);
      }
    }
  }
}

RepairState l_prism() {
  RepairState box = box_state(4, 4, 3);
  std::vector<std::array<VertexId, 4>> tets;
  for (std::size_t t = 0; t < box.mesh.num_tets(); ++t) {
    const Vec3 c = centroid(box.mesh, TetId(static_cast<std::int64_t>(t)));
    if (c.x() < 2 || c.y() < 2) tets.push_back(box.mesh.tets[t]);
  }
  RepairState state;
  state.mesh = build_tet_mesh(box.mesh.points, tets);
  complete_features(state.mesh, state.features);
  state.field.frames.assign(tets.size(), Quaternion::Identity());
  state.field.matchings.assign(tets.size(), {});
  state.target_length.assign(state.mesh.num_vertices(), 1.0);
  state.codes = compute_codes(state.mesh, state.features, state.field);
  return state;
}

}  // namespace

// spec-lmff section 12, facts 8 and 9.
TEST(Meshability, BoxesAndAnLPrismAreMeshable) {
  for (const RepairState& state : {box_state(3), l_prism()}) {
    const Meshability result = check_meshability(state);
    EXPECT_EQ(result.bad_edges.size(), 0u);
    EXPECT_EQ(result.bad_vertices.size(), 0u);
    EXPECT_GT(result.solved, 50u);
    EXPECT_LE(result.solved, result.vertices);
    EXPECT_EQ(result.edges, all_edges(state.mesh).size());
  }
  const RepairState prism = l_prism();
  int concave = 0;
  for (const auto& [edge, code] : prism.codes) concave += code == 1;
  EXPECT_EQ(concave, 3);
}

TEST(Meshability, MapsOfCornersAndEdgesObeyAllConstraints) {
  const RepairState state = l_prism();
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(4, 0, 3), Vec3(2, 2, 0), Vec3(2, 2, 1), Vec3(2, 0, 0), Vec3(1, 1, 3)}) {
    const VertexId v = vertex_at(state.mesh, p);
    std::vector<MappedTet> map;
    EXPECT_NE(vertex_verdict(state, v, {}, &map), VertexVerdict::not_meshable);
    expect_seamless(state, v, map);
  }
}

// spec-lmff section 12, fact 10: a thin wedge with equal frames leaves no room for a quad.
TEST(Meshability, AFoldedSectorIsNotMeshable) {
  RepairState state;
  state.mesh = build_tet_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0.1}, {0, 1, -0.1}},
                              {{VertexId(0), VertexId(2), VertexId(1), VertexId(3)}});
  complete_features(state.mesh, state.features);
  state.field.frames.assign(1, Quaternion::Identity());
  state.field.matchings.assign(1, {});
  state.codes = compute_codes(state.mesh, state.features, state.field);
  EXPECT_EQ(state.codes.at(edge_key(VertexId(0), VertexId(1))), -2);
  EXPECT_FALSE(edge_meshable(state, edge_key(VertexId(0), VertexId(1))));
  EXPECT_FALSE(vertex_meshable(state, VertexId(0)));
}

// spec-lmff section 12, fact 17.
class MeshableCone : public ::testing::TestWithParam<Triangle> {};

TEST_P(MeshableCone, HasAMap) {
  const std::vector<Vec3> points = sphere_points(GetParam());
  for (int levels = 0; levels < 3; ++levels) {
    const Cone c = cone(points, levels);
    Triangle counts{};
    for (int d : c.degrees) ++counts[static_cast<std::size_t>(d - 3)];
    ASSERT_EQ(counts, GetParam());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const EdgeKey key = edge_key(c.apex, VertexId(static_cast<std::int64_t>(i) + 1));
      EXPECT_EQ(interior_code(c.state.mesh, c.state.field, ring_of(c.state.mesh, key[0], key[1]), key[0], key[1]),
                c.degrees[i] - 4);
      EXPECT_TRUE(edge_meshable(c.state, key));
    }
    for (unsigned seed = 0; seed < 4; ++seed) {
      Cone shaken = c;
      shake(shaken.state, 0.2 * seed, seed);
      change_gauges(shaken.state, seed);
      std::vector<MappedTet> map;
      EXPECT_NE(vertex_verdict(shaken.state, c.apex, {}, &map), VertexVerdict::not_meshable) << levels << " " << seed;
      expect_seamless(shaken.state, c.apex, map);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(SphereTriangulations, MeshableCone,
                         ::testing::Values(Triangle{4, 0, 0}, Triangle{2, 3, 0}, Triangle{0, 6, 0}, Triangle{2, 2, 2},
                                           Triangle{1, 3, 3}, Triangle{0, 4, 4}, Triangle{2, 0, 6}, Triangle{0, 3, 6},
                                           Triangle{0, 2, 8}, Triangle{0, 5, 2}, Triangle{0, 0, 12}));

TEST(Meshability, ZipperNodesHaveNoMapAndTheirArcsDo) {
  RepairState state = zipper_state();
  const Meshability result = check_meshability(state);
  EXPECT_TRUE(result.bad_edges.empty());
  ASSERT_EQ(result.bad_vertices.size(), 2u);
  EXPECT_EQ(result.bad_vertices[0], vertex_at(state.mesh, {1, 1, 1}));
  EXPECT_EQ(result.bad_vertices[1], vertex_at(state.mesh, {5, 3, 3}));
  change_gauges(state, 1);
  const Meshability again = check_meshability(state);
  EXPECT_EQ(again.bad_vertices, result.bad_vertices);
  EXPECT_TRUE(again.bad_edges.empty());
}

TEST(Meshability, ACodeThatTheMatchingsDoNotHaveIsNotMeshable) {
  RepairState state = zipper_state();
  const EdgeKey regular = edge_key(vertex_at(state.mesh, {2, 2, 2}), vertex_at(state.mesh, {3, 2, 2}));
  EXPECT_TRUE(edge_meshable(state, regular));
  state.codes[regular] = -1;
  EXPECT_FALSE(edge_meshable(state, regular));
  state.codes.erase(regular);
  state.codes[edge_key(vertex_at(state.mesh, {1, 1, 1}), vertex_at(state.mesh, {2, 1, 1}))] = compound_code;
  EXPECT_EQ(check_meshability(state).bad_edges.size(), 1u);
}

TEST(Meshability, AVerdictIsRememberedAsLongAsItsOneRing) {
  RepairState state = zipper_state();
  const VertexId zipper = vertex_at(state.mesh, {1, 1, 1}), inner = vertex_at(state.mesh, {2, 1, 1});
  std::optional<VerdictMemory::Key> of_zipper, of_inner, again;
  EXPECT_EQ(vertex_verdict(state, zipper, {}, nullptr, &of_zipper), VertexVerdict::not_meshable);
  EXPECT_EQ(vertex_verdict(state, inner, {}, nullptr, &of_inner), VertexVerdict::meshable);
  ASSERT_TRUE(of_zipper && of_inner);
  EXPECT_NE(*of_zipper, *of_inner);

  state.mesh.points[inner.index()] += Vec3(0.1, 0.05, -0.1);  // geometry does not matter
  vertex_verdict(state, inner, {}, nullptr, &again);
  EXPECT_EQ(again, of_inner);
  VerdictMemory memory;
  memory.note(*of_inner, VertexVerdict::not_meshable);  // a lie, to see that it is believed
  VertexMapOptions options;
  options.memory = &memory;
  EXPECT_EQ(vertex_verdict(state, inner, options), VertexVerdict::not_meshable);
  EXPECT_TRUE(memory.found().all().empty());

  split_edge(state, vertex_at(state.mesh, {3, 1, 1}), vertex_at(state.mesh, {3, 2, 1}));  // a side of the link
  EXPECT_EQ(vertex_verdict(state, inner, options, nullptr, &again), VertexVerdict::meshable);
  EXPECT_NE(again, of_inner);
}
