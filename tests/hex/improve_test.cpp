#include "hexfield/hex/improve.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "../../src/hex/corner_energy.hpp"
#include "hexfield/base/parallel.hpp"
#include "hexfield/hex/check.hpp"
#include "hexfield/hex/extract.hpp"
#include "support/mapped_meshes.hpp"

using namespace hexfield;
using namespace hexfield::testing;

namespace {

double noise(unsigned& state) {
  state = state * 1664525U + 1013904223U;
  return static_cast<double>(state >> 8U) / (1U << 24U) - 0.5;
}

struct Box {
  MappedMesh m = scaled_box(3, 3, 3, Vec3::Constant(4.0 / 3));
  Features features = box_features(m.mesh, Vec3::Constant(3));
  HexMesh hexes = extract_hex_mesh(m.mesh, features, m.map);

  // Vertices inside the box, or on its sides too, moved by up to `size`.
  void shake(double size, bool sides) {
    unsigned state = 7;
    for (Vec3& p : hexes.points)
      for (int a = 0; a < 3; ++a) {
        const double d = size * noise(state);
        const bool inside = p[a] > 1e-9 && p[a] < 3 - 1e-9;
        const bool all_inside = p.minCoeff() > 1e-9 && p.maxCoeff() < 3 - 1e-9;
        if (inside && (sides || all_inside)) p[a] += d;
      }
  }
};

}  // namespace

TEST(CornerEnergy, GradientIsThatOfFiniteDifferences) {
  unsigned state = 3;
  for (int trial = 0; trial < 40; ++trial) {
    hex::Corner corner;
    corner.points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
    for (Vec3& p : corner.points)
      for (int a = 0; a < 3; ++a) p[a] += noise(state) * (trial % 2 == 0 ? 0.6 : 1.6);
    corner.scale = 0.8;
    corner.role = trial % 4;
    const hex::EnergyShape shape{1.0 + trial % 3, 0.3, 0.2};
    std::vector<hex::Corner> patch{corner};
    const Vec3 x = corner.points[static_cast<std::size_t>(corner.role)];
    Vec3 gradient;
    const double energy = patch_energy(patch, x, shape, &gradient);
    for (int a = 0; a < 3; ++a) {
      const Vec3 step = 1e-6 * Vec3::Unit(a);
      const double slope =
          (patch_energy(patch, x + step, shape, nullptr) - patch_energy(patch, x - step, shape, nullptr)) / 2e-6;
      EXPECT_NEAR(gradient[a], slope, 1e-5 * (energy + std::abs(slope)));
    }
  }
}

TEST(Improve, AShakenCubeBecomesRegularAndKeepsItsShape) {
  Box box;
  const HexMesh before = box.hexes;
  box.shake(0.5, true);
  ASSERT_LT(quality(box.hexes).min, 0.75);
  improve_hex_mesh(box.hexes, box.m.mesh, box.features, {}, {});
  EXPECT_GT(quality(box.hexes).min, 0.95);
  EXPECT_NEAR(volume(box.hexes), 27, 0.01);  // sides of hexes inside are not planar
  EXPECT_TRUE(check(box.hexes).empty());
  EXPECT_TRUE(check_against(box.hexes, box.m.mesh, box.features).violations.empty());
  for (const auto& p : box.hexes.feature_points)
    EXPECT_EQ(box.hexes.points[static_cast<std::size_t>(p.vertex)], before.points[static_cast<std::size_t>(p.vertex)]);
  for (const auto& q : box.hexes.feature_quads)
    for (int v : q.vertices)
      EXPECT_NEAR(box.hexes.points[static_cast<std::size_t>(v)][(q.colour - 1) / 2], (q.colour - 1) % 2 * 3.0, 1e-12);
}

TEST(Improve, TangledInteriorIsUntangled) {
  Box box;
  box.shake(2.5, false);
  ASSERT_GT(quality(box.hexes).not_positive, 10u);
  improve_hex_mesh(box.hexes, box.m.mesh, box.features, {}, {});
  EXPECT_EQ(quality(box.hexes).not_positive, 0u);
  EXPECT_TRUE(check(box.hexes).empty());
}

TEST(Improve, NoPositiveHexIsLostAtAnyTime) {
  Box box;
  box.shake(1.2, false);
  std::vector<char> positive(box.hexes.hexes.size());
  const auto mark = [&] {
    int lost = 0;
    for (std::size_t h = 0; h < positive.size(); ++h) {
      const bool now = scaled_jacobian(box.hexes, h) > 0;
      lost += positive[h] != 0 && !now ? 1 : 0;
      positive[h] = now;
    }
    return lost;
  };
  mark();
  Control control;
  int sweeps = 0;
  control.progress = [&](const std::string&, double) {
    EXPECT_EQ(mark(), 0);
    ++sweeps;
  };
  improve_hex_mesh(box.hexes, box.m.mesh, box.features, {}, control);
  EXPECT_GT(sweeps, 3);
}

TEST(Improve, SameBytesForAnyNumberOfThreads) {
  Box one;
  Box three;
  one.shake(0.8, true);
  three.shake(0.8, true);
  const int before = threads();
  set_threads(1);
  improve_hex_mesh(one.hexes, one.m.mesh, one.features, {}, {});
  set_threads(3);
  improve_hex_mesh(three.hexes, three.m.mesh, three.features, {}, {});
  set_threads(before);
  EXPECT_EQ(one.hexes.points, three.hexes.points);
}

TEST(Improve, StopsAtTheEndOfASweep) {
  Box box;
  box.shake(0.5, true);
  Control control;
  control.stop_requested = [] { return true; };
  try {
    improve_hex_mesh(box.hexes, box.m.mesh, box.features, {}, control);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::stopped);
  }
}

TEST(HexCheck, NamesWhatIsBroken) {
  Box box;
  EXPECT_TRUE(check(box.hexes).empty());
  const auto says = [](const std::vector<Violation>& found, const std::string& part) {
    return std::any_of(found.begin(), found.end(),
                       [&](const Violation& v) { return v.sentence.find(part) != std::string::npos; });
  };
  HexMesh broken = box.hexes;
  broken.hexes.push_back(broken.hexes[5]);
  EXPECT_TRUE(says(check(broken), "same vertices"));
  broken = box.hexes;
  broken.points.emplace_back(0, 0, 0);
  EXPECT_TRUE(says(check(broken), "belongs to no hex"));
  broken = box.hexes;
  std::swap(broken.hexes[3][0], broken.hexes[3][6]);
  EXPECT_TRUE(says(check(broken), "scaled Jacobian"));
  broken = box.hexes;
  broken.hexes[2][4] = 100000;
  EXPECT_TRUE(says(check(broken), "out of range"));
  broken = box.hexes;
  broken.feature_lines[0].vertices[1] = broken.feature_lines[40].vertices[1];
  EXPECT_TRUE(says(check(broken), "no edge of a hex"));
  broken = box.hexes;  // two hexes that touch in an edge only
  broken.hexes = {broken.hexes[0]};
  for (const auto& hex : box.hexes.hexes) {
    int shared = 0;
    for (int v : hex) shared += static_cast<int>(std::count(broken.hexes[0].begin(), broken.hexes[0].end(), v));
    if (shared == 2 && broken.hexes.size() == 1) broken.hexes.push_back(hex);
  }
  ASSERT_EQ(broken.hexes.size(), 2u);
  EXPECT_TRUE(says(check(broken), "do not hang together"));
  EXPECT_TRUE(says(check(broken), "boundary faces instead of two"));
}

TEST(HexCheck, ComparesWithTheTets) {
  Box box;
  const HexAgainstTets same = check_against(box.hexes, box.m.mesh, box.features);
  EXPECT_TRUE(same.violations.empty());
  EXPECT_EQ(same.points.wanted, 8);
  EXPECT_EQ(same.curves.wanted, 12);
  EXPECT_EQ(same.surfaces.wanted, 6);
  EXPECT_EQ(same.hexes.euler_boundary, 2);
  EXPECT_EQ(same.tets.euler_volume, 1);
  EXPECT_NEAR(same.volume_ratio, 1, 1e-12);
  HexMesh worse = box.hexes;
  worse.hexes.pop_back();
  worse.feature_lines.pop_back();
  for (Vec3& p : worse.points) p *= 1.05;
  const HexAgainstTets found = check_against(worse, box.m.mesh, box.features);
  EXPECT_GT(found.points.wrong, 0);
  EXPECT_GT(found.curves.wrong, 0);
  EXPECT_GT(found.surfaces.wrong, 0);
  EXPECT_GT(found.volume_ratio, 1.06);
}

TEST(HexCheck, TopologyOfTorusAndOfPrism) {
  const MappedMesh torus = square_torus(8, 5, 2, 2);
  const MeshTopology ring = topology(extract_hex_mesh(torus.mesh, {}, torus.map));
  EXPECT_EQ(ring.euler_volume, 0);
  EXPECT_EQ(ring.euler_boundary, 0);
  EXPECT_EQ(ring.boundary_components, 1);
  EXPECT_EQ(ring.euler_volume, topology(torus.mesh).euler_volume);
  const MappedMesh prism = polygon_prism({1, 2, 1, 3, 1}, 2);
  const MeshTopology ball = topology(extract_hex_mesh(prism.mesh, {}, prism.map));
  EXPECT_EQ(ball.euler_volume, 1);
  EXPECT_EQ(ball.euler_boundary, 2);
  EXPECT_EQ(ball.components, 1);
}

TEST(HexCheck, PercentilesAreOrderedAndExact) {
  Box box;
  box.shake(0.4, true);
  const HexQuality q = quality(box.hexes);
  double least = 1;
  for (std::size_t h = 0; h < box.hexes.hexes.size(); ++h) least = std::min(least, scaled_jacobian(box.hexes, h));
  EXPECT_EQ(q.min, least);
  EXPECT_TRUE(std::is_sorted(q.percentiles.begin(), q.percentiles.end()));
  EXPECT_GE(q.percentiles.front(), q.min);
  EXPECT_LT(q.mean, 1);
}
