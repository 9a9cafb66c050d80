#include <gtest/gtest.h>

#include "hexfield/field/frame_field.hpp"
#include "hexfield/mesh/refine.hpp"
#include "support/meshes.hpp"

using namespace hexfield;

// DESIGN section 3: 10 million tets with their field in 1.5 GB.
TEST(Memory, MeshFieldAndMatchingsTakeAtMost150BytesPerTet) {
  TetMesh mesh = hexfield::testing::kuhn_box(3, 3, 3);
  Features none;
  refine_uniform(mesh, none);
  FrameField field;
  field.frames.resize(mesh.num_tets());
  field.matchings.resize(mesh.num_tets());
  auto bytes = [](const auto& values) { return static_cast<double>(values.size() * sizeof(values[0])); };
  const double total = bytes(mesh.points) + bytes(mesh.vertex_tet) + bytes(mesh.tets) + bytes(mesh.opposite) +
                       bytes(field.frames) + bytes(field.matchings);
  const double per_tet = total / static_cast<double>(mesh.num_tets());
  EXPECT_LE(per_tet, 150);
  EXPECT_LE(per_tet, 80);  // 16 + 16 for the mesh, 32 + 4 for the field, and the share of the vertices
}
