#include "hexfield/mesh/distributed.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "hexfield/mesh/partition.hpp"
#include "support/meshes.hpp"

using namespace hexfield;
using hexfield::testing::kuhn_box;

namespace {

int world_rank() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

int world_size() {
  int size = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  return size;
}

TetMesh on_root(TetMesh mesh) { return world_rank() == 0 ? std::move(mesh) : TetMesh(); }

// Two boxes that share nothing.
TetMesh two_boxes() {
  TetMesh mesh = kuhn_box(3, 2, 2);
  const TetMesh other = kuhn_box(2, 2, 1);
  std::vector<Vec3> points = mesh.points;
  auto tets = mesh.tets;
  for (const Vec3& p : other.points) points.push_back(p + Vec3(10, 0, 0));
  for (auto tet : other.tets) {
    for (VertexId& v : tet) v = VertexId(v.value + static_cast<std::int64_t>(mesh.num_vertices()));
    tets.push_back(tet);
  }
  return build_tet_mesh(points, tets);
}

// Every rank has the whole mesh in `global` to compare with.
void expect_right_shares(const TetMesh& global) {
  const DistributedMesh mesh(MPI_COMM_WORLD, on_root(global));
  const TetMesh& local = mesh.local();
  EXPECT_TRUE(check(local).empty());
  EXPECT_EQ(mesh.num_global_tets(), static_cast<std::int64_t>(global.num_tets()));
  EXPECT_EQ(mesh.num_global_vertices(), static_cast<std::int64_t>(global.num_vertices()));
  const auto ids = mesh.global_tets();
  ASSERT_EQ(ids.size(), local.num_tets());
  ASSERT_EQ(mesh.global_vertices().size(), local.num_vertices());
  const auto ghosts = ids.begin() + static_cast<std::ptrdiff_t>(mesh.num_owned());
  EXPECT_TRUE(std::is_sorted(ids.begin(), ghosts));
  EXPECT_TRUE(std::is_sorted(ghosts, ids.end()));

  std::vector<int> owners(global.num_tets(), 0);
  for (auto id = ids.begin(); id != ghosts; ++id) ++owners[static_cast<std::size_t>(*id)];
  MPI_Allreduce(MPI_IN_PLACE, owners.data(), static_cast<int>(owners.size()), MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  EXPECT_EQ(owners, std::vector<int>(global.num_tets(), 1));

  for (std::size_t t = 0; t < local.num_tets(); ++t) {
    const TetId global_tet(ids[t]);
    bool next_to_owned = false;
    for (int i = 0; i < 4; ++i) {
      const VertexId v = local.tets[t][static_cast<std::size_t>(i)];
      EXPECT_EQ(VertexId(mesh.global_vertices()[v.index()]), global.vertices(global_tet)[static_cast<std::size_t>(i)]);
      EXPECT_EQ(local.point(v), global.point(VertexId(mesh.global_vertices()[v.index()])));
      const HalfFaceId here = local.opposite_half_face(HalfFaceId(TetId(t), i));
      const HalfFaceId there = global.opposite_half_face(HalfFaceId(global_tet, i));
      if (here.valid()) {
        EXPECT_EQ(HalfFaceId(TetId(ids[here.tet().index()]), here.local()), there);
        next_to_owned |= here.tet().index() < mesh.num_owned();
      } else if (t < mesh.num_owned()) {
        EXPECT_FALSE(there.valid());
      } else if (there.valid()) {
        EXPECT_EQ(std::find(ids.begin(), ids.end(), there.tet().value), ids.end());
      }
    }
    if (t >= mesh.num_owned()) {
      EXPECT_TRUE(next_to_owned);
    }
  }
}

double value(std::int64_t tet, int k) { return static_cast<double>(tet) * 10 + k; }

void expect_values_travel(const TetMesh& global, int width) {
  const DistributedMesh mesh(MPI_COMM_WORLD, on_root(global));
  std::vector<double> root_values;
  if (world_rank() == 0)
    for (std::size_t t = 0; t < global.num_tets(); ++t)
      for (int k = 0; k < width; ++k) root_values.push_back(value(static_cast<std::int64_t>(t), k));
  std::vector<double> local = mesh.scatter_tets(root_values, width);
  const auto w = static_cast<std::size_t>(width);
  ASSERT_EQ(local.size(), w * mesh.local().num_tets());
  for (std::size_t i = 0; i < local.size(); ++i)
    EXPECT_EQ(local[i], value(mesh.global_tets()[i / w], static_cast<int>(i % w)));
  EXPECT_EQ(mesh.gather_tets(local, width), root_values);

  for (std::size_t i = 0; i < local.size(); ++i) local[i] = i < w * mesh.num_owned() ? -local[i] : 0.5;
  mesh.update_ghosts(local, width);
  for (std::size_t i = 0; i < local.size(); ++i)
    EXPECT_EQ(local[i], -value(mesh.global_tets()[i / w], static_cast<int>(i % w)));
}

}  // namespace

TEST(Distributed, EveryTetIsOwnedOnceAndGhostsHaveTheRightNeighbours) {
  expect_right_shares(kuhn_box(4, 3, 3));
  expect_right_shares(two_boxes());
}

TEST(Distributed, FewerTetsThanRanksLeaveEmptyShares) {
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  using V = VertexId;
  const TetMesh one = build_tet_mesh({points.begin(), points.begin() + 4}, {{V(0), V(1), V(2), V(3)}});
  const TetMesh two = build_tet_mesh(points, {{V(0), V(1), V(2), V(3)}, {V(1), V(2), V(3), V(4)}});
  for (const TetMesh& mesh : {TetMesh(), one, two, kuhn_box(1, 1, 1)}) {
    expect_right_shares(mesh);
    expect_values_travel(mesh, 3);
  }
  const DistributedMesh mesh(MPI_COMM_WORLD, on_root(one));
  EXPECT_EQ(mesh.num_owned(), world_rank() == 0 ? 1u : 0u);
  EXPECT_EQ(mesh.local().num_tets(), mesh.num_owned());
}

TEST(Distributed, ValuesTravelToAllTetsAndBack) {
  for (int width : {1, 4, 9}) expect_values_travel(kuhn_box(3, 3, 3), width);
  expect_values_travel(two_boxes(), 36);
}

TEST(Distributed, VerticesWithoutTetsAreInNoShare) {
  TetMesh mesh = kuhn_box(2, 2, 2);
  mesh.points.emplace_back(9, 9, 9);
  mesh.vertex_tet.emplace_back();
  expect_right_shares(mesh);
}

TEST(Distributed, SharesAreBalanced) {
  const TetMesh global = kuhn_box(6, 6, 6);
  const DistributedMesh mesh(MPI_COMM_WORLD, on_root(global));
  const double ideal = static_cast<double>(global.num_tets()) / world_size();
  EXPECT_NEAR(static_cast<double>(mesh.num_owned()), ideal, 0.05 * ideal);
}

TEST(Distributed, AMistakeOnOneRankIsTheSameErrorOnAll) {
  TetMesh mesh = kuhn_box(2, 1, 1);
  const DistributedMesh good(MPI_COMM_WORLD, on_root(mesh));
  EXPECT_THROW(good.scatter_tets({}, 3), Error);
  const std::size_t missing = world_rank() == world_size() - 1 ? 1 : 0;
  EXPECT_THROW(good.gather_tets(std::vector<double>(good.local().num_tets() - missing), 1), Error);
  mesh.tets[3].fill(VertexId());
  EXPECT_THROW(DistributedMesh(MPI_COMM_WORLD, on_root(mesh)), Error);
}

TEST(Partition, IsCompleteBalancedAndTheSameEveryTime) {
  const TetMesh mesh = kuhn_box(6, 5, 4);
  for (int parts : {1, 2, 3, 7, 12, 40}) {
    const auto part = partition_tets(mesh, parts);
    EXPECT_EQ(part, partition_tets(mesh, parts));
    std::vector<int> sizes(static_cast<std::size_t>(parts));
    for (int p : part) ++sizes.at(static_cast<std::size_t>(p));
    const double ideal = static_cast<double>(mesh.num_tets()) / parts;
    for (int size : sizes) EXPECT_NEAR(size, ideal, 0.35 * ideal);
  }
  const TetMesh small = kuhn_box(1, 1, 1);
  for (int parts : {2, 5, 6, 100}) {
    const auto part = partition_tets(small, parts);
    for (int p : part) EXPECT_TRUE(p >= 0 && p < parts);
    EXPECT_EQ(std::count(part.begin(), part.end(), 0), parts >= 6 ? 1 : (parts == 5 ? 2 : 3));
  }
}
