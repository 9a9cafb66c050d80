#pragma once

#include "hexfield/mesh/refine.hpp"
#include "support/repair_states.hpp"

/// Pyramids whose field converges to the apex, for tests of fully constrained sectors.
namespace hexfield::testing {

/// A pyramid over a regular polygon of n corners around the z-axis with its apex at (0, 0, height); the field is that
/// of a prism over the polygon, pulled together: one axis runs along the edges from the apex, one along the normal of
/// the face beside it. So no surface sector at the apex holds a quad, all its edges are convex, and where n is not 4 a
/// singular arc runs up the axis to it.
inline RepairState pyramid_state(int n, double height, int refinements = 2) {
  RepairState state;
  std::vector<Vec3> points{Vec3(0, 0, height), Vec3(0, 0, 0)};
  std::vector<std::array<VertexId, 4>> tets;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * M_PI * i / n;
    points.emplace_back(std::cos(angle), std::sin(angle), 0);
    tets.push_back({VertexId(0), VertexId(1), VertexId(2 + (i + 1) % n), VertexId(2 + i)});
  }
  state.mesh = build_tet_mesh(std::move(points), std::move(tets));
  state.features = features_from_angles(state.mesh, 30);
  for (int k = 0; k < refinements; ++k) refine_uniform(state.mesh, state.features);
  complete_features(state.mesh, state.features);
  const Vec3 apex(0, 0, height);
  for (std::size_t i = 0; i < state.mesh.num_tets(); ++i) {
    Vec3 middle = Vec3::Zero();
    for (VertexId v : state.mesh.vertices(TetId(static_cast<std::int64_t>(i)))) middle += state.mesh.point(v) / 4;
    const double wedge = 2 * M_PI / n, angle = std::atan2(middle.y(), middle.x()) + 2 * M_PI;
    const double out = (std::floor(angle / wedge) + 0.5) * wedge;
    const Vec3 w = (apex - middle).normalized();
    const Vec3 side = w.cross(Vec3(std::cos(out), std::sin(out), 0)).normalized();
    Eigen::Matrix3d frame;
    frame << side.cross(w), side, w;
    state.field.frames.emplace_back(frame);
  }
  state.field.matchings.assign(state.mesh.num_tets(), {});
  compute_matchings(state.mesh, state.field);
  state.target_length.assign(state.mesh.num_vertices(), 0.3);
  std::vector<TetId> all;
  for (std::size_t i = 0; i < state.mesh.num_tets(); ++i) all.emplace_back(static_cast<std::int64_t>(i));
  smooth_to_features(state, all, 20);
  state.codes = compute_codes(state.mesh, state.features, state.field);
  return state;
}

}  // namespace hexfield::testing
