#include "hexfield/mesh/input_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hexfield/mesh/manifold.hpp"
#include "support/meshes.hpp"

using namespace hexfield;
using hexfield::testing::kuhn_box;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using V = VertexId;

namespace {

struct Raw {
  std::vector<Vec3> points;
  std::vector<std::array<VertexId, 4>> tets;
  Features features;

  std::vector<Violation> check(const InputIds& ids = {}) const { return check_input(points, tets, features, ids); }
  std::string first() const {
    const auto found = check();
    return found.empty() ? "" : found[0].sentence;
  }
};

Raw box() {
  const TetMesh mesh = kuhn_box(2, 2, 2);
  return {mesh.points, mesh.tets, features_from_angles(mesh)};
}

// A second copy of the mesh beside the first, with vertices of its own.
void append(Raw& raw, const TetMesh& other, const Vec3& shift) {
  const auto n = static_cast<std::int64_t>(raw.points.size());
  for (const Vec3& p : other.points) raw.points.push_back(p + shift);
  for (auto tet : other.tets) {
    for (VertexId& v : tet) v = V(v.value + n);
    raw.tets.push_back(tet);
  }
}

}  // namespace

TEST(InputCheck, LegalMeshesHaveNoDefects) {
  Raw raw = box();
  EXPECT_EQ(raw.first(), "");
  append(raw, kuhn_box(1, 1, 1), {5, 0, 0});  // a component of its own
  raw.points.emplace_back(0.5, 0, 0);         // a point that no tet uses
  EXPECT_EQ(raw.first(), "");
  const Raw one = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{V(0), V(1), V(2), V(3)}}, {}};
  EXPECT_EQ(one.first(), "");
  for (double scale : {1e-60, 1e60}) {
    Raw scaled = box();
    for (Vec3& p : scaled.points) p *= scale;
    EXPECT_EQ(scaled.first(), "");
  }
  Raw moved = box();
  for (Vec3& p : moved.points) p += Vec3(1e6, -1e6, 1e6);
  EXPECT_EQ(moved.first(), "");
}

TEST(InputCheck, NoTets) { EXPECT_EQ(Raw{}.first(), "There are no tets."); }

TEST(InputCheck, BadCoordinates) {
  for (double x : {std::nan(""), HUGE_VAL, -1e101}) {
    Raw raw = box();
    raw.points[5].y() = x;
    EXPECT_THAT(raw.first(), StartsWith("Vertex 5 has a coordinate that is not a number or too large"));
    EXPECT_EQ(raw.check().size(), 1u);
    EXPECT_EQ(raw.check()[0].ids, std::vector<std::int64_t>{5});
  }
}

TEST(InputCheck, BadIds) {
  for (int id : {-1, -7, 27, 1 << 30}) {
    Raw raw = box();
    raw.tets[3][2] = V(id);
    EXPECT_EQ(raw.first(), "Tet 3 names a vertex that does not exist; there are 27 vertices.");
  }
  Raw raw = box();
  raw.tets[7][2] = raw.tets[7][0];
  EXPECT_THAT(raw.first(), HasSubstr("has a vertex twice: 1, 4, 1, 14."));
}

TEST(InputCheck, InvertedAndFlatTets) {
  Raw raw = box();
  std::swap(raw.tets[11][0], raw.tets[11][1]);
  auto found = raw.check();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0].sentence, StartsWith("Tet 11 at ("));
  EXPECT_THAT(found[0].sentence, HasSubstr("is inverted: its volume is -0.166667."));
  ASSERT_EQ(found[0].places.size(), 1u);

  raw = box();
  raw.points[13] = {1, 1, 0};  // the centre onto a side: flat tets below it
  EXPECT_THAT(raw.first(), HasSubstr("is flat: its volume is 0."));
  raw.points[13] = {1, 1, 1e-14};
  EXPECT_THAT(raw.first(), HasSubstr("is flat: its volume is "));
  raw.points[13] = {1, 1, 1e-8};
  EXPECT_EQ(raw.first(), "");
}

TEST(InputCheck, AFileOfTheOtherOrientationIsTurned) {
  Raw raw = box();
  const auto tets = raw.tets;
  EXPECT_FALSE(orient_if_all_inverted(raw.points, raw.tets));
  EXPECT_EQ(raw.tets, tets);
  for (auto& tet : raw.tets) std::swap(tet[2], tet[3]);
  EXPECT_EQ(raw.check().size(), 48u);
  EXPECT_TRUE(orient_if_all_inverted(raw.points, raw.tets));
  EXPECT_EQ(raw.tets, tets);
  for (std::size_t t = 1; t < raw.tets.size(); ++t) std::swap(raw.tets[t][2], raw.tets[t][3]);
  EXPECT_FALSE(orient_if_all_inverted(raw.points, raw.tets));
  raw.tets[4][0] = V(99);
  EXPECT_FALSE(orient_if_all_inverted(raw.points, raw.tets));
  std::vector<std::array<VertexId, 4>> none;
  EXPECT_FALSE(orient_if_all_inverted(raw.points, none));
}

TEST(InputCheck, DoubledTetsAndOvercrowdedFaces) {
  Raw raw = box();
  raw.tets.push_back({raw.tets[9][1], raw.tets[9][2], raw.tets[9][0], raw.tets[9][3]});
  auto found = raw.check();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0].sentence, HasSubstr("has the same vertices as tet 9."));
  EXPECT_EQ(found[0].ids, std::vector<std::int64_t>{48});

  raw = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {0.1, 0.1, 2}},
         {{V(0), V(1), V(2), V(3)}, {V(0), V(2), V(1), V(4)}, {V(0), V(1), V(2), V(5)}},
         {}};
  EXPECT_EQ(raw.first(),
            "The face of vertices 0, 1, 2 at (0.333333, 0.333333, 0) belongs to more than two tets: 0, 1, 2.");
  EXPECT_EQ(raw.check()[0].ids, (std::vector<std::int64_t>{0, 1, 2}));
  raw.tets.erase(raw.tets.begin() + 1);
  EXPECT_THAT(raw.first(), HasSubstr("has the same side in the overlapping tets 0, 1."));
}

TEST(InputCheck, HangingVertices) {
  Raw raw;
  append(raw, kuhn_box(1, 1, 1), {0, 0, 0});
  append(raw, kuhn_box(1, 2, 1), {0, 0, 0});
  for (std::size_t i = 8; i < raw.points.size(); ++i)
    raw.points[i] = {1 + raw.points[i].x(), raw.points[i].y() / 2, raw.points[i].z()};
  // Weld the four common corners; the two in the middle of the common side hang.
  for (auto& tet : raw.tets)
    for (VertexId& v : tet)
      for (std::int64_t w = 0; w < 8; ++w)
        if (v.value >= 8 && raw.points[v.index()] == raw.points[V(w).index()]) v = V(w);
  const auto found = raw.check();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_THAT(found[0].sentence, StartsWith("Vertex 10 at (1, 0.5, 0) hangs: it lies inside the face of vertices"));
  EXPECT_THAT(found[1].sentence, StartsWith("Vertex 16 at (1, 0.5, 1) hangs"));
  EXPECT_EQ(found[1].places[0], Vec3(1, 0.5, 1));
  EXPECT_EQ(found[1].ids[0], 16);
}

TEST(InputCheck, CoincidentVerticesCrackTheMesh) {
  Raw raw;
  append(raw, kuhn_box(1, 1, 1), {0, 0, 0});
  append(raw, kuhn_box(1, 1, 1), {1, 0, 0});
  const auto found = raw.check();
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[0].sentence, "Vertices 1 and 8 lie both at (1, 0, 0), so the mesh has a crack there.");
  EXPECT_EQ(found[0].ids, (std::vector<std::int64_t>{1, 8}));
  for (std::size_t i = 8; i < 16; ++i) raw.points[i].x() += 1e-13;
  EXPECT_EQ(raw.check().size(), 4u);
  for (std::size_t i = 8; i < 16; ++i) raw.points[i].x() += 1e-6;
  EXPECT_EQ(raw.first(), "");
}

TEST(InputCheck, FeaturesThatAreNoEntities) {
  Raw raw = box();
  raw.points.emplace_back(9, 9, 9);
  raw.features.points[V(27)] = 1;
  raw.features.points[V(99)] = 1;
  raw.features.edges[edge_key(V(0), V(26))] = 1;
  raw.features.edges[edge_key(V(-1), V(2))] = 1;
  raw.features.edges[{V(3), V(3)}] = 1;
  raw.features.faces[face_key(V(0), V(2), V(8))] = 1;
  raw.features.tet_colours.assign(47, 1);
  const auto found = raw.check();
  std::vector<std::string> sentences;
  for (const auto& violation : found) sentences.push_back(violation.sentence);
  EXPECT_EQ(sentences, (std::vector<std::string>{
                           "There are 47 tet colours for 48 tets.",
                           "The feature point of vertex 27 at (9, 9, 9) is no vertex of a tet.",
                           "The feature point of vertex 99 is no vertex of a tet.",
                           "The feature edge of vertices -1, 2 is no edge of a tet.",
                           "The feature edge of vertices 0, 26 at (1, 1, 1) is no edge of a tet.",
                           "The feature edge of vertices 3, 3 at (0, 1, 0) is no edge of a tet.",
                           "The feature face of vertices 0, 2, 8 at (1.33333, 0.666667, 0) is no face of a tet.",
                       }));
}

TEST(InputCheck, SentencesUseTheIdsOfTheFile) {
  Raw raw = box();
  std::swap(raw.tets[11][0], raw.tets[11][1]);
  raw.features.points[V(99)] = 1;
  const auto found = raw.check({[](std::int64_t v) { return v + 1; }, [](std::int64_t t) { return 1000 + t; }});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_THAT(found[0].sentence, StartsWith("Tet 1011 "));
  EXPECT_EQ(found[0].ids, std::vector<std::int64_t>{1011});
  EXPECT_THAT(found[1].sentence, HasSubstr("vertex 100"));
}

TEST(InputCheck, TheErrorCarriesTheFirstDefectAndTheirNumber) {
  EXPECT_NO_THROW(require_valid_input("a.vtk", {}));
  Raw raw = box();
  std::swap(raw.tets[2][0], raw.tets[2][1]);
  std::swap(raw.tets[40][0], raw.tets[40][1]);
  try {
    require_valid_input("a.vtk", raw.check());
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    EXPECT_THAT(error.sentence(), StartsWith("a.vtk: Tet 2 at ("));
    EXPECT_THAT(error.sentence(), HasSubstr("is inverted: its volume is -0.166667 (1 more defect was found)."));
    EXPECT_EQ(error.ids(), std::vector<std::int64_t>{2});
    EXPECT_EQ(error.places().size(), 1u);
  }
}

TEST(InputCheck, LongListsAreCut) {
  const TetMesh mesh = kuhn_box(6, 6, 6);
  Raw raw = {mesh.points, mesh.tets, {}};
  for (std::size_t t = 1; t < raw.tets.size(); ++t) std::swap(raw.tets[t][0], raw.tets[t][1]);
  const auto found = raw.check();
  ASSERT_EQ(found.size(), 1000u);
  EXPECT_THAT(found.back().sentence, HasSubstr("And 295 more inverted tets."));
}

TEST(Manifold, TouchingTetsAreFound) {
  EXPECT_TRUE(find_non_manifold(kuhn_box(2, 2, 2)).empty());
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {0, 0, -1}, {-1, 0, 0}};
  const TetMesh at_edge = build_tet_mesh(points, {{V(0), V(1), V(2), V(3)}, {V(0), V(1), V(4), V(5)}});
  ASSERT_TRUE(check(at_edge).empty());
  auto found = find_non_manifold(at_edge);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].sentence, "Edge 0, 1 at (0.5, 0, 0) is in 4 boundary faces.");
  const TetMesh at_vertex = build_tet_mesh(points, {{V(0), V(1), V(2), V(3)}, {V(0), V(6), V(5), V(4)}});
  found = find_non_manifold(at_vertex);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].ids, std::vector<std::int64_t>{0});
}
