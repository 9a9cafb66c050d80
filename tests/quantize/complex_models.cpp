#include <fmt/core.h>

#include <ctime>
#include <set>

#include "hexfield/quantize/exact_seamless.hpp"
#include "hexfield/quantize/motorcycle_complex.hpp"
#include "seamless_models.hpp"

using namespace hexfield;
using namespace hexfield::testing;

namespace {

std::int64_t euler_of(const TetMesh& mesh) {
  std::set<EdgeKey> edges;
  std::set<FaceKey> faces;
  std::set<VertexId> vertices;
  for (std::size_t t = 0; t < mesh.num_tets(); ++t) {
    for (VertexId v : mesh.tets[t]) vertices.insert(v);
    for (const auto& e : tet_edge_vertices)
      edges.insert(
          edge_key(mesh.tets[t][static_cast<std::size_t>(e[0])], mesh.tets[t][static_cast<std::size_t>(e[1])]));
    for (int i = 0; i < 4; ++i) faces.insert(mesh.key(HalfFaceId(TetId(t), i)));
  }
  return static_cast<std::int64_t>(vertices.size()) - static_cast<std::int64_t>(edges.size()) +
         static_cast<std::int64_t>(faces.size()) - static_cast<std::int64_t>(mesh.num_tets());
}

double user_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

TEST(ComplexModels, EveryMapIsCutIntoCuboids) {
  const auto models = seamless_models();
  if (models.empty()) GTEST_SKIP() << "no shared data beside the checkout";
  for (const auto& file : models) {
    SCOPED_TRACE(file.filename().string());
    const HexexInput input = read_packed(file);
    const double start = user_seconds();
    const ExactSeamless exact = make_exactly_seamless(input.mesh, input.features, input.map);
    ASSERT_EQ(exact.failure, ExactFailure::none);
    const double middle = user_seconds();
    try {
      const BlockComplex raw = motorcycle_complex(input.mesh, input.features, exact.codes, exact.map, {false});
      const double traced = user_seconds();
      const BlockComplex c = motorcycle_complex(input.mesh, input.features, exact.codes, exact.map);
      const double end = user_seconds();
      RecordProperty(file.stem().stem().string(),
                     fmt::format("{} blocks before, {} after reduction, {:.3f} s + {:.3f} s + {:.3f} s",
                                 raw.blocks.size(), c.blocks.size(), middle - start, traced - middle, end - traced));
      for (const BlockComplex* one : {&raw, &c}) {
        for (const Violation& v : check(*one)) ADD_FAILURE() << v.sentence;
        EXPECT_EQ(one->euler(), euler_of(input.mesh));
      }
    } catch (const Error& error) {
      ADD_FAILURE() << error.sentence();
    }
  }
}
