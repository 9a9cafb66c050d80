#include <fmt/format.h>

#include "hexfield/base/error.hpp"
#include "hexfield/hex/check.hpp"
#include "stages.hpp"

namespace hexfield {
namespace {

using Json = nlohmann::ordered_json;

Json coverage_json(const HexAgainstTets::Coverage& coverage) {
  return {{"wanted", coverage.wanted}, {"wrong", coverage.wrong}};
}

Json quality_json(const HexQuality& quality) {
  Json percentiles = Json::object();
  for (std::size_t k = 0; k < quality.percentiles.size(); ++k) {
    percentiles[fmt::format("{}", HexQuality::percents[k])] = quality.percentiles[k];
  }
  return {{"min", quality.min},
          {"mean", quality.mean},
          {"percentiles", percentiles},
          {"not_positive", quality.not_positive}};
}

Json topology_json(const MeshTopology& topology) {
  return {{"components", topology.components},
          {"boundary_components", topology.boundary_components},
          {"euler_volume", topology.euler_volume},
          {"euler_boundary", topology.euler_boundary}};
}

void note_bad_hexes(RunState& state) {
  for (std::size_t h = 0; h < state.hexes.hexes.size(); ++h) {
    if (!(scaled_jacobian(state.hexes, h) > 0)) state.culprits.hexes.push_back(h);
  }
}

struct Judgement {
  std::vector<Violation> violations;
  /// Conforming, positive and of the right topology, whatever its shape: all that a coarse layout of blocks can be.
  bool sound = false;
};

/// Fills the section of the report.
Judgement describe(RunState& state) {
  const HexMesh& hexes = state.hexes;
  const HexQuality measured = quality(hexes);
  Judgement judgement;
  std::vector<Violation>& violations = judgement.violations;
  violations = check(hexes);
  const bool conforming = violations.empty();
  const HexAgainstTets against = check_against(hexes, state.field.mesh, state.field.features);
  judgement.sound = conforming && against.hexes == against.tets;
  violations.insert(violations.end(), against.violations.begin(), against.violations.end());
  state.report["hex"] = {{"count", hexes.hexes.size()},
                         {"scaled_jacobian", quality_json(measured)},
                         {"features",
                          {{"points", coverage_json(against.points)},
                           {"curves", coverage_json(against.curves)},
                           {"surfaces", coverage_json(against.surfaces)}}},
                         {"volume_ratio", against.volume_ratio},
                         {"topology", topology_json(against.hexes)},
                         {"sound", judgement.sound},
                         {"defects", violations.size()}};
  state.sentence = fmt::format(
      "A complete, valid hex mesh: {} hexes, smallest scaled Jacobian {:.3f}, {} feature points, {} curves and {} "
      "surfaces kept.",
      hexes.hexes.size(), measured.min, against.points.wanted, against.curves.wanted, against.surfaces.wanted);
  return judgement;
}

}  // namespace

void describe_hexes(RunState& state) { describe(state); }

void judge_hexes(RunState& state) {
  const Judgement judgement = describe(state);
  const std::vector<Violation>& violations = judgement.violations;
  if (violations.empty()) return;
  note_bad_hexes(state);
  std::vector<Vec3> places;
  for (const Violation& violation : violations) {
    places.insert(places.end(), violation.places.begin(), violation.places.end());
  }
  state.culprits.places = places;
  throw Error(
      ExitCode::bad_hex_mesh,
      fmt::format("{}: {} ({} defects in all).",
                  judgement.sound ? "The hex mesh is complete, conforming and positive, but too coarse for its shape"
                                  : "The hex mesh is not valid",
                  violations.front().sentence, violations.size()),
      violations.front().ids, places);
}

}  // namespace hexfield
