#include "hexfield/quantize/exact_seamless.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/mapped_meshes.hpp"

using namespace hexfield;
using namespace hexfield::testing;

namespace {

// Independent noise on every corner of every tet.
void perturb(CornerMap& map, double size) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> noise(-size, size);
  for (auto& tet : map.uvw)
    for (Vec3& p : tet) p += Vec3(noise(random), noise(random), noise(random));
}

}  // namespace

TEST(ExactSeamless, NoiseOnEveryCornerIsRemoved) {
  MappedMesh box = scaled_box(3, 2, 2, Vec3(1.3, 0.7, 1.9));
  const Features features = box_features(box.mesh, Vec3(3, 2, 2));
  change_chart(box, TetId(5), octahedral::quarter_turn(2), Vec3(4, -2, 1));
  MappedMesh prism = polygon_prism({3, 4, 5}, 2);
  MappedMesh pentagon = polygon_prism({3, 4, 5, 2, 3}, 2);
  MappedMesh torus = square_torus(6, 5, 2, 3);
  for (auto [m, f] : {std::pair<MappedMesh*, Features>{&box, features}, {&prism, {}}, {&pentagon, {}}, {&torus, {}}}) {
    perturb(m->map, 1e-7);
    const ExactSeamless exact = make_exactly_seamless(m->mesh, f, m->map);
    ASSERT_EQ(exact.failure, ExactFailure::none);
    EXPECT_LT(exact.largest_move, 1e-5);
    EXPECT_TRUE(check_exactly_seamless(m->mesh, f, exact.codes, exact.map).empty());
    // The noisy map itself does not pass.
    EXPECT_FALSE(check_exactly_seamless(m->mesh, f, exact.codes, m->map).empty());
  }
}

TEST(ExactSeamless, AnExactMapIsKept) {
  const MappedMesh prism = polygon_prism({3, 4, 5}, 2);
  const ExactSeamless exact = make_exactly_seamless(prism.mesh, {}, prism.map);
  ASSERT_EQ(exact.failure, ExactFailure::none);
  EXPECT_EQ(exact.largest_move, 0);
  // The axis, six edges around each end and three uprights; one mesh edge each.
  EXPECT_EQ(exact.codes.size(), 1u + 2 * 6u + 3u);
}

TEST(ExactSeamless, AnInvertedTetIsNamed) {
  MappedMesh box = scaled_box(2, 2, 2, Vec3(1, 1, 1));
  std::swap(box.map.uvw[9][1], box.map.uvw[9][2]);
  const ExactSeamless exact = make_exactly_seamless(box.mesh, {}, box.map);
  EXPECT_EQ(exact.failure, ExactFailure::inverted_input);
  ASSERT_EQ(exact.violations.size(), 1u);
  EXPECT_EQ(exact.violations[0].ids, std::vector<std::int64_t>{9});
  EXPECT_TRUE(exact.map.uvw.empty());
}

TEST(ExactSeamless, ABrokenTransitionIsRefused) {
  MappedMesh box = scaled_box(3, 3, 3, Vec3(1, 1, 1));
  // Half the box moves sideways along the middle plane: no piece knows, the faces between do not fit.
  for (std::size_t t = 0; t < box.mesh.num_tets(); ++t)
    if (centroid(box.mesh, TetId(t)).x() < 1)
      for (Vec3& p : box.map.uvw[t]) p.y() *= 1.05;
  const ExactSeamless exact = make_exactly_seamless(box.mesh, {}, box.map);
  EXPECT_EQ(exact.failure, ExactFailure::not_seamless);
  EXPECT_FALSE(exact.violations.empty());
}

TEST(ExactSeamless, CheckFindsOneWrongBit) {
  MappedMesh box = scaled_box(2, 2, 2, Vec3(1.3, 0.7, 1.9));
  const ExactSeamless exact = make_exactly_seamless(box.mesh, {}, box.map);
  ASSERT_EQ(exact.failure, ExactFailure::none);
  SeamlessMap wrong = exact.map;
  wrong.uvw[20][2].x() = std::nextafter(wrong.uvw[20][2].x(), 100.0);
  EXPECT_FALSE(check_exactly_seamless(box.mesh, {}, exact.codes, wrong).empty());
}
