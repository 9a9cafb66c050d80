#include "hexfield/repair/neighbourhood_loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

#include "hexfield/base/error.hpp"
#include "hexfield/base/parallel.hpp"
#include "support/repair_states.hpp"

using namespace hexfield;
using hexfield::testing::box_state;
using hexfield::testing::vertex_at;

namespace {

// One place per inner lattice point of a box of side 6.
std::vector<Place> inner_places(const TetMesh& mesh) {
  std::vector<Place> places;
  for (int k = 1; k < 6; ++k)
    for (int j = 1; j < 6; ++j)
      for (int i = 1; i < 6; ++i) places.push_back({{vertex_at(mesh, Vec3(i, j, k))}, 0});
  return places;
}

// Splits the first edge at the seed, in the order of the ids of its other end.
bool split_first_edge(Neighbourhood& copy, std::span<const VertexId> seeds) {
  for (const EdgeKey& e : edges_at(copy.local.mesh, seeds[0])) {
    if (!copy.edge_inside(e[0], e[1])) continue;
    split_edge(copy.local, e[0], e[1]);
    return true;
  }
  return false;
}

RepairState split_everywhere(int number) {
  const int before = threads();
  set_threads(number);
  RepairState state = box_state(6);
  const auto commits = for_places(state, inner_places(state.mesh), split_first_edge);
  for (char c : commits) EXPECT_EQ(c, 1);
  set_threads(before);
  return state;
}

}  // namespace

TEST(NeighbourhoodLoop, EveryPlaceIsWorkedOnOnceAndTheMeshStaysWhole) {
  const RepairState state = split_everywhere(2);
  EXPECT_EQ(state.mesh.num_vertices(), 7u * 7u * 7u + 125u);
  EXPECT_TRUE(check(state).empty());
}

TEST(NeighbourhoodLoop, TheResultDoesNotDependOnTheNumberOfThreads) {
  const RepairState one = split_everywhere(1);
  const RepairState two = split_everywhere(2);
  EXPECT_EQ(one.mesh.tets, two.mesh.tets);
  EXPECT_EQ(one.mesh.opposite, two.mesh.opposite);
  EXPECT_EQ(one.features.faces, two.features.faces);
}

TEST(NeighbourhoodLoop, WhatIsNotCommittedHasNotHappened) {
  RepairState state = box_state(4);
  const auto before = state.mesh.tets;
  const Place places[] = {{{vertex_at(state.mesh, Vec3(2, 2, 2))}, 1}};
  for_places(state, places, [](Neighbourhood& copy, std::span<const VertexId> seeds) {
    split_first_edge(copy, seeds);
    return false;
  });
  EXPECT_EQ(state.mesh.tets, before);
}

TEST(NeighbourhoodLoop, AStopIsHeardBeforeEveryPlace) {
  RepairState state = box_state(6);
  const auto places = inner_places(state.mesh);
  std::atomic<int> done = 0;
  state.watch = std::make_shared<RepairWatch>();
  state.watch->stop_requested = [&] { return done >= 3; };
  const auto operation = [&](Neighbourhood& copy, std::span<const VertexId> seeds) {
    ++done;
    copy.local.begin_operation(0);  // copies ask, too
    return split_first_edge(copy, seeds);
  };
  try {
    for_places(state, places, operation);
    FAIL() << "Nobody heard the stop.";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::stopped);
  }
  EXPECT_LT(done, 3 + threads());
}

TEST(NeighbourhoodLoop, TheWorkIsCountedAndItsBudgetEndsTheLoopForAnyNumberOfThreads) {
  const int before = threads();
  std::vector<long> work;
  std::vector<std::vector<char>> commits;
  for (int number : {1, 2}) {
    set_threads(number);
    RepairState state = box_state(6);
    state.watch = std::make_shared<RepairWatch>();
    state.watch->budget = 100;
    commits.push_back(for_places(state, inner_places(state.mesh), split_first_edge));
    EXPECT_TRUE(state.exhausted());
    work.push_back(state.watch->work);
  }
  set_threads(before);
  EXPECT_EQ(work[0], work[1]);
  EXPECT_EQ(commits[0], commits[1]);
  const auto changed = std::count(commits[0].begin(), commits[0].end(), 1);
  EXPECT_GT(changed, 0);    // the first round is worked off
  EXPECT_LT(changed, 125);  // the places that waited for it are not
}
