#include <fmt/format.h>

#include <Eigen/SVD>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "hexfield/base/error.hpp"
#include "hexfield/io/checkpoint_values.hpp"
#include "hexfield/io/hexex_io.hpp"
#include "hexfield/map/cut_graph.hpp"
#include "hexfield/map/verify.hpp"
#include "hexfield/mesh/input_check.hpp"
#include "hexfield/mesh/manifold.hpp"
#include "quantize_values.hpp"
#include "stages.hpp"

namespace hexfield {
namespace {

/// The field whose matchings the map has: per tet the rotation closest to the transposed Jacobian.
FrameField field_of_map(const TetMesh& mesh, const SeamlessMap& map) {
  FrameField field;
  field.matchings = matchings_of(map);
  for (std::size_t t = 0; t < mesh.num_tets(); ++t) {
    Mat3 edges, images;
    for (int k = 0; k < 3; ++k) {
      const auto c = static_cast<std::size_t>(k + 1);
      edges.col(k) = mesh.point(mesh.tets[t][c]) - mesh.point(mesh.tets[t][0]);
      images.col(k) = map.uvw[t][c] - map.uvw[t][0];
    }
    const Mat3 jacobian = images * edges.inverse();
    const Eigen::JacobiSVD<Mat3> svd(jacobian.transpose(), Eigen::ComputeFullU | Eigen::ComputeFullV);
    Mat3 rotation = svd.matrixU() * svd.matrixV().transpose();
    if (rotation.determinant() < 0) rotation = -rotation;
    field.frames.emplace_back(Quaternion(rotation).normalized());
  }
  return field;
}

Vec3 unit_normal(const TetMesh& mesh, HalfFaceId h) {
  const auto v = mesh.face_vertices(h);
  return (mesh.point(v[1]) - mesh.point(v[0])).cross(mesh.point(v[2]) - mesh.point(v[0])).normalized();
}

/// The boundary is a feature, in the colour of the listed features: a curve between two colours would be one that the
/// map knows nothing of. Where a file lists none at all, the edges of the boundary that are sharper than `degrees` and
/// that its map bends are curves, so that the hexes keep them.
Features tagged(const TetMesh& mesh, Features features, const EdgeCodes& codes, double degrees) {
  const bool none = features.points.empty() && features.edges.empty() && features.faces.empty();
  std::map<EdgeKey, Vec3> first_normal;
  for (std::size_t i = 0; i < 4 * mesh.num_tets(); ++i) {
    const HalfFaceId h{static_cast<std::int64_t>(i)};
    if (!mesh.is_boundary(h)) continue;
    features.faces.emplace(mesh.key(h), 1);
    if (!none) continue;
    const auto v = mesh.face_vertices(h);
    const Vec3 normal = unit_normal(mesh, h);
    for (std::size_t k = 0; k < 3; ++k) {
      const EdgeKey edge = edge_key(v[k], v[(k + 1) % 3]);
      const auto [other, fresh] = first_normal.emplace(edge, normal);
      if (fresh || codes.count(edge) == 0) continue;
      if (other->second.dot(normal) < std::cos(degrees * std::numbers::pi / 180)) features.edges[edge] = 1;
    }
  }
  // None is added by angle, for the same reason.
  complete_features(mesh, features, 180);
  return features;
}

void read_map(RunState& state) {
  const std::string file = state.options.input.string();
  HexexInput input = read_hexex(state.options.input);
  require_valid_input(file, check_input(input.mesh.points, input.mesh.tets, input.features));
  require_valid_input(file, find_non_manifold(input.mesh));
  if (!input.turned.empty())
    state.log.warning(
        fmt::format("{} tets of {} were listed with negative volume; they are turned.", input.turned.size(), file));
  FieldResult& f = state.field;
  f.mesh = std::move(input.mesh);
  f.codes = codes_of_map(f.mesh, input.map);
  f.features = tagged(f.mesh, std::move(input.features), f.codes, state.options.feature_angle);
  f.field = field_of_map(f.mesh, input.map);
  state.seamless.report = verify_map(f.mesh, f.features, f.codes, input.map);
  state.seamless.map = std::move(input.map);
}

// How far transitions and alignments may miss is for the stage that makes them exact.
void judge_map(RunState& state) {
  const FieldResult& f = state.field;
  state.report["input"]["tets"] = f.mesh.num_tets();
  state.report["input"]["vertices"] = f.mesh.num_vertices();
  judge_field(state);
  judge_seamless_within(state, std::numeric_limits<double>::infinity());
}

}  // namespace

Stage map_stage() {
  Stage stage;
  stage.name = "map";
  stage.compute = [](RunState& state, const std::string&, Progress& progress) {
    state.team.on_root([&] {
      progress.report("reading " + state.options.input.string(), -1);
      read_map(state);
    });
  };
  stage.pack = [](const RunState& state) { return joined(pack(state.field), pack(state.seamless)); };
  stage.unpack = [](RunState& state, const NamedArrays& arrays) {
    state.field = unpack_field(arrays);
    state.seamless = unpack_seamless(arrays, state.field.mesh.num_tets());
  };
  stage.judge = judge_map;
  stage.check = [](const RunState& state) { return check(state.field.mesh); };
  return stage;
}

}  // namespace hexfield
