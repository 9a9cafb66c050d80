#include <fmt/core.h>

#include <boost/multiprecision/gmp.hpp>

#include "hexfield/quantize/exact_seamless.hpp"
#include "seamless_models.hpp"

using namespace hexfield;
using namespace hexfield::testing;

namespace {

using Rational = boost::multiprecision::mpq_rational;
using Point = std::array<Rational, 3>;

Point exact(const Vec3& x) { return {Rational(x[0]), Rational(x[1]), Rational(x[2])}; }
Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

// R d, from the matrix, in rationals.
Point turned(octahedral::Rotation r, const Point& d) {
  const Mat3& m = octahedral::matrix(r);
  Point y;
  for (int i = 0; i < 3; ++i) {
    y[static_cast<std::size_t>(i)] = 0;
    for (int k = 0; k < 3; ++k)
      if (m(i, k) != 0) y[static_cast<std::size_t>(i)] += (m(i, k) > 0 ? 1 : -1) * d[static_cast<std::size_t>(k)];
  }
  return y;
}

const Vec3& corner(const TetMesh& mesh, const CornerMap& map, TetId t, VertexId v) {
  return map.uvw[t.index()][static_cast<std::size_t>(mesh.local_index(t, v))];
}

int varying(const Vec3& a, const Vec3& b) { return (a[0] != b[0]) + (a[1] != b[1]) + (a[2] != b[2]); }

}  // namespace

// Nothing here is shared with the module: rationals, and alignments from the tags and the file alone.
TEST(ExactModels, EveryMapBecomesExact) {
  const auto models = seamless_models();
  if (models.empty()) GTEST_SKIP() << "no shared data beside the checkout";
  EXPECT_EQ(models.size(), 32u);
  for (const auto& file : models) {
    SCOPED_TRACE(file.filename().string());
    const HexexInput input = read_packed(file);
    const ExactSeamless result = make_exactly_seamless(input.mesh, input.features, input.map);
    ASSERT_EQ(result.failure, ExactFailure::none) << (result.violations.empty() ? "" : result.violations[0].sentence);
    RecordProperty(file.stem().stem().string(), fmt::format("{:.2g}", result.largest_move));
    EXPECT_LT(result.largest_move, 1e-5);
    EXPECT_TRUE(check_exactly_seamless(input.mesh, input.features, result.codes, result.map).empty());
    const TetMesh& mesh = input.mesh;
    std::size_t broken = 0, flat = 0, misaligned = 0;
    for (std::size_t i = 0; i < 4 * mesh.num_tets(); ++i) {
      const HalfFaceId h{static_cast<std::int64_t>(i)};
      const auto v = mesh.face_vertices(h);
      const auto at = [&](TetId t, std::size_t k) { return corner(mesh, result.map, t, v[k]); };
      if (mesh.is_boundary(h) || input.features.faces.contains(mesh.key(h))) {
        bool constant = false;
        for (int a = 0; a < 3; ++a)
          constant = constant || (at(h.tet(), 0)[a] == at(h.tet(), 1)[a] && at(h.tet(), 0)[a] == at(h.tet(), 2)[a]);
        misaligned += !constant;
      }
      if (mesh.is_boundary(h)) continue;
      const TetId o = mesh.opposite_half_face(h).tet();
      for (std::size_t k = 1; k < 3; ++k)
        broken += turned(result.map.rotation(h), minus(exact(at(h.tet(), k)), exact(at(h.tet(), 0)))) !=
                  minus(exact(at(o, k)), exact(at(o, 0)));
    }
    for (std::size_t t = 0; t < mesh.num_tets(); ++t) {
      std::array<Point, 3> e;
      for (std::size_t k = 0; k < 3; ++k) e[k] = minus(exact(result.map.uvw[t][k + 1]), exact(result.map.uvw[t][0]));
      const Rational det = e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
                           e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                           e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
      flat += det <= 0;
      for (const auto& pair : tet_edge_vertices) {
        const auto a = static_cast<std::size_t>(pair[0]), b = static_cast<std::size_t>(pair[1]);
        const EdgeKey key = edge_key(mesh.tets[t][a], mesh.tets[t][b]);
        if (input.features.edges.contains(key) || result.codes.contains(key))
          misaligned += varying(result.map.uvw[t][a], result.map.uvw[t][b]) != 1;
      }
    }
    EXPECT_EQ(broken, 0u);
    EXPECT_EQ(flat, 0u);
    EXPECT_EQ(misaligned, 0u);
  }
}
