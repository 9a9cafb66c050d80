#include <gtest/gtest.h>

#include "hexfield/io/tet_io.hpp"
#include "io/samples.hpp"

using namespace hexfield;
using samples::write_text;

namespace {

const VertexId v0(0), v1(1), v2(2), v3(3);

// One tet with sparse node tags; `elements` are the lines of MSH 2.2 elements.
std::string msh22(int count, const std::string& elements) {
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Comments\nanything\n$EndComments\n"
         "$PhysicalNames\n2\n2 7 \"a \"quoted\" face\"\n3 9 \"body\"\n$EndPhysicalNames\n"
         "$Nodes\n5\n100 0 0 1\n3 0 0 0\n7 1 0 0\n8 0 1 0\n50 9 9 9\n$EndNodes\n$Elements\n" +
         std::to_string(count) + "\n" + elements + "$EndElements\n";
}

}  // namespace

TEST(Gmsh, PointsComeInTheOrderOfTheirTagsAndUnusedOnesAreDropped) {
  const TetInput input = read_tet_mesh(write_text("a.msh", msh22(1, "1 4 2 9 1 3 7 8 100\n")));
  ASSERT_EQ(input.mesh.num_vertices(), 4u);
  EXPECT_EQ(input.mesh.points[0], Vec3(0, 0, 0));
  EXPECT_EQ(input.mesh.points[3], Vec3(0, 0, 1));
  EXPECT_EQ(input.notes, std::vector<std::string>{"Points that no tet uses were dropped: 1."});
  EXPECT_EQ(input.features.tet_colours, std::vector<int>{9});
  EXPECT_EQ(input.features.names.at({3, 9}), "body");
  EXPECT_EQ(input.features.names.at({2, 7}), "a \"quoted\" face");
}

TEST(Gmsh, AMeshOfInvertedTetsOnlyIsTurned) {
  const TetInput input = read_tet_mesh(write_text("turned.msh", msh22(1, "1 4 2 9 1 3 8 7 100\n")));
  EXPECT_TRUE(check(input.mesh).empty());
  EXPECT_EQ(input.notes.size(), 2u);
}

TEST(Gmsh, ThePhysicalTagIsTheColourAndTheElementaryOneStandsIn) {
  const TetInput input = read_tet_mesh(write_text("b.msh", msh22(6,
                                                                 "1 4 2 9 1 3 7 8 100\n"
                                                                 "2 2 2 7 1 3 8 7\n"
                                                                 "3 2 2 -5 2 3 7 100\n"
                                                                 "4 2 2 0 3 7 8 100\n"
                                                                 "5 1 2 0 4 3 7\n"
                                                                 "6 15 2 0 0 3\n")));
  EXPECT_EQ(input.features.faces,
            (std::map<FaceKey, int>{{face_key(v0, v1, v2), 7}, {face_key(v0, v1, v3), 5}, {face_key(v1, v2, v3), 3}}));
  EXPECT_EQ(input.features.edges, (std::map<EdgeKey, int>{{edge_key(v0, v1), 4}}));
  EXPECT_TRUE(input.features.points.empty());
}

TEST(Gmsh, AnElementaryTagMovesOutOfTheWayOfPhysicalOnes) {
  const TetInput input = read_tet_mesh(write_text("c.msh", msh22(3,
                                                                 "1 4 2 9 1 3 7 8 100\n"
                                                                 "2 2 2 7 1 3 8 7\n"
                                                                 "3 2 2 0 7 3 7 100\n")));
  EXPECT_EQ(input.features.faces, (std::map<FaceKey, int>{{face_key(v0, v1, v2), 7}, {face_key(v0, v1, v3), 14}}));
}

TEST(Gmsh, EntitiesOfVersion41CarryThePhysicalTags) {
  const std::string text =
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 12 \"lid\"\n$EndPhysicalNames\n"
      "$Entities\n1 1 1 1\n4 0 0 0 1 8\n6 0 0 0 1 0 0 0 2 4 -4\n2 0 0 0 1 1 0 1 -12 1 6\n1 0 0 0 1 1 1 0 1 "
      "2\n$EndEntities\n"
      "$Nodes\n2 4 1 4\n2 2 1 3\n1\n2\n3\n0 0 0 0.5 0.5\n1 0 0 0.5 0.5\n0 1 0 0.5 0.5\n3 1 0 1\n4\n0 0 1\n$EndNodes\n"
      "$Elements\n4 4 1 4\n0 4 15 1\n1 1\n1 6 1 1\n2 1 2\n2 2 2 1\n3 1 3 2\n3 1 4 1\n4 1 2 3 4\n$EndElements\n"
      "$Periodic\n0\n$EndPeriodic\n";
  const TetInput input = read_tet_mesh(write_text("d.msh", text));
  EXPECT_EQ(input.features.points, (std::map<VertexId, int>{{v0, 8}}));
  EXPECT_EQ(input.features.edges, (std::map<EdgeKey, int>{{edge_key(v0, v1), 6}}));
  EXPECT_EQ(input.features.faces, (std::map<FaceKey, int>{{face_key(v0, v1, v2), 12}}));
  EXPECT_TRUE(input.features.tet_colours.empty());
  EXPECT_EQ(input.features.names, (std::map<std::pair<int, int>, std::string>{{{2, 12}, "lid"}}));
}

TEST(Medit, CornersAreFeaturesAndOtherReferencesOfVerticesAreNot) {
  const std::string text =
      "MeshVersionFormatted 1\n# a comment\nDimension\n3\nVertices\n5\n9 9 9 1\n0 0 0 4\n1 0 0 4\n0 1 0 0\n0 0 1 4\n"
      "RequiredVertices 1\n2\nCorners\n2\n2\n4\nEdges\n2\n2 3 0\n2 4 6\nRidges\n1\n1\nNormals\n1\n0 0 1\n"
      "Triangles\n1\n2 3 4 3\nTetrahedra\n1\n2 3 4 5 0\nEnd\nwhatever follows\n";
  const TetInput input = read_tet_mesh(write_text("e.mesh", text));
  EXPECT_EQ(input.mesh.num_vertices(), 4u);
  EXPECT_EQ(input.features.points, (std::map<VertexId, int>{{v0, 4}, {v2, 2}}));
  EXPECT_EQ(input.features.edges, (std::map<EdgeKey, int>{{edge_key(v0, v2), 6}}));
  EXPECT_EQ(input.features.faces, (std::map<FaceKey, int>{{face_key(v0, v1, v2), 3}}));
  EXPECT_TRUE(input.features.tet_colours.empty());
}
