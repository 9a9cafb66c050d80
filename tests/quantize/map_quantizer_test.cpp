#include "hexfield/quantize/map_quantizer.hpp"

#include <gtest/gtest.h>

#include "hexfield/map/verify.hpp"
#include "hexfield/quantize/exact_seamless.hpp"
#include "hexfield/quantize/quantization.hpp"
#include "support/mapped_meshes.hpp"

using namespace hexfield;
using namespace hexfield::testing;

namespace {

struct Prepared {
  ExactSeamless exact;
  ConformingSpace space;
  std::vector<double> unknowns;
};

Prepared prepare(const MappedMesh& m, const Features& features) {
  Prepared p{make_exactly_seamless(m.mesh, features, m.map), {}, {}};
  EXPECT_EQ(p.exact.failure, ExactFailure::none);
  p.space = conforming_space(m.mesh, cut_graph(m.mesh, matchings_of(p.exact.map), singular_edges(p.exact.codes)),
                             alignments_of_map(m.mesh, features, p.exact.codes, p.exact.map));
  p.unknowns = unknowns_of(m.mesh, p.space, p.exact.map);
  return p;
}

std::vector<std::int64_t> real_lengths(const BlockComplex& c) {
  std::vector<std::int64_t> lengths;
  for (std::size_t a = 0; a < c.arcs.size(); ++a) lengths.push_back(std::llround(c.length(a)));
  return lengths;
}

}  // namespace

// An integer-grid map with the lengths that it has: the unknowns are those of the map itself.
TEST(MapQuantizer, LengthsOfAnIntegerMapGiveItsUnknowns) {
  MappedMesh box = scaled_box(3, 2, 2, Vec3(1, 2, 3));
  const Features features = box_features(box.mesh, Vec3(3, 2, 2));
  for (std::int64_t t = 0; t < 40; ++t)
    change_chart(box, TetId(t), static_cast<octahedral::Rotation>(t % 24), Vec3(t % 5, 2, -t % 3));
  const std::vector<std::pair<MappedMesh, Features>> cases = {{box, features},
                                                              {polygon_prism({3, 4, 5}, 2), {}},
                                                              {polygon_prism({3, 4, 5, 2, 6}, 2), {}},
                                                              {square_torus(6, 6, 2, 3), {}}};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    SCOPED_TRACE(i);
    const auto& [m, f] = cases[i];
    const Prepared p = prepare(m, f);
    const MapQuantizer quantizer(m.mesh, f, p.exact.codes, p.exact.map);
    const std::vector<std::int64_t> lengths = real_lengths(quantizer.complex());
    ASSERT_TRUE(check(quantizer.complex(), lengths).empty());
    const std::vector<double> integers = quantizer.integer_unknowns(p.space, lengths);
    ASSERT_EQ(integers.size(), p.space.num_integers);
    for (std::size_t k = 0; k < integers.size(); ++k) EXPECT_NEAR(integers[k], p.unknowns[p.space.num_reals + k], 1e-9);
  }
}

// The prism with other lengths: the map that the integers describe has the volume of the blocks.
TEST(MapQuantizer, IntegersDescribeTheBlocks) {
  const MappedMesh m = polygon_prism({3, 4, 5}, 2);
  const Prepared p = prepare(m, {});
  const MapQuantizer quantizer(m.mesh, {}, p.exact.codes, p.exact.map);
  std::vector<std::int64_t> lengths = real_lengths(quantizer.complex());
  for (auto& l : lengths) l = l == 4 ? 7 : (l == 2 ? 3 : l);
  ASSERT_TRUE(check(quantizer.complex(), lengths).empty());
  // Sides 3, 7, 5 and height 3.
  const std::int64_t section = 3 * 7 + 7 * 5 + 5 * 3;
  EXPECT_EQ(count_hexes(quantizer.complex(), lengths), 3 * section);
  const std::vector<double> integers = quantizer.integer_unknowns(p.space, lengths);
  std::vector<double> y = p.unknowns;
  std::copy(integers.begin(), integers.end(), y.begin() + static_cast<std::ptrdiff_t>(p.space.num_reals));
  const std::vector<double> x = coordinates(p.space, y);
  for (std::size_t k = 0; k < x.size(); ++k)
    if (p.space.integral[k] != 0) {
      EXPECT_EQ(x[k], std::nearbyint(x[k]));
    }
  // The inner real unknowns do not matter for the volume: the hull and the cut are integer.
  EXPECT_NEAR(parametric_volume(to_corner_map(p.space, x)), static_cast<double>(3 * section), 1e-9);
}

// In the prism every tet lies in one block: stretched, it has its share of the hexes.
TEST(MapQuantizer, StretchesTakeTheTetsToTheLengthsOfTheirBlocks) {
  MappedMesh m = polygon_prism({3, 4, 5}, 2);
  for (std::int64_t t = 0; t < static_cast<std::int64_t>(m.mesh.num_tets()); ++t)
    change_chart(m, TetId(t), static_cast<octahedral::Rotation>(t % 24), Vec3(t % 5, 2, -t % 3));
  const Prepared p = prepare(m, {});
  const MapQuantizer quantizer(m.mesh, {}, p.exact.codes, p.exact.map);
  std::vector<std::int64_t> lengths = real_lengths(quantizer.complex());
  for (const Vec3& s : quantizer.stretches(lengths)) EXPECT_LT((s - Vec3::Ones()).norm(), 1e-12);
  for (auto& l : lengths) l = l == 4 ? 7 : (l == 2 ? 3 : l);
  const std::vector<Vec3> stretches = quantizer.stretches(lengths);
  ASSERT_EQ(stretches.size(), m.mesh.num_tets());
  double volume = 0;
  for (std::size_t t = 0; t < stretches.size(); ++t) {
    const auto& f = p.exact.map.uvw[t];
    volume += (f[1] - f[0]).cross(f[2] - f[0]).dot(f[3] - f[0]) / 6 * stretches[t].prod();
  }
  EXPECT_NEAR(volume, static_cast<double>(count_hexes(quantizer.complex(), lengths)), 1e-9);
}
