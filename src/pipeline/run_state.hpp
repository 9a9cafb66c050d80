#pragma once

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

#include "hexfield/field/compute_field.hpp"
#include "hexfield/hex/hex_mesh.hpp"
#include "hexfield/io/tet_io.hpp"
#include "hexfield/map/compute_map.hpp"
#include "hexfield/pipeline/options.hpp"
#include "hexfield/quantize/map_quantizer.hpp"
#include "quantize_values.hpp"
#include "safe_points.hpp"
#include "team.hpp"

namespace hexfield {

/// Entities that a verdict is about, for why.vtk; ids of the mesh of the field stage (or of the hex mesh for `hexes`).
struct Culprits {
  /// What is wrong with an entity: the scalar `kind` of why.vtk.
  enum Kind { inverted_tet = 1, wrong_angle = 2, bad_edge = 3, bad_node = 4, bad_hex = 5, place = 6, other = 7 };
  std::vector<std::pair<TetId, Kind>> tets;
  std::vector<std::pair<EdgeKey, Kind>> edges;
  std::vector<std::pair<VertexId, Kind>> nodes;
  std::vector<std::size_t> hexes;
  std::vector<Vec3> places;

  bool empty() const { return tets.empty() && edges.empty() && nodes.empty() && hexes.empty() && places.empty(); }
};

/// What `decompose` did to the hex mesh.
struct DecomposeReport {
  bool tried = false;
  bool taken = false;  ///< the smallest scaled Jacobian rose, and every feature is kept
  bool proven = false;
  int sheets = 0;
  int nodes_before = 0, nodes_after = 0;
  int measure_before = 0, measure_after = 0;
  double min_before = 0, min_after = 0;  ///< scaled Jacobian
};

/// Everything a run has reached. The values are complete on rank 0 and empty elsewhere.
struct RunState {
  Team& team;
  const RunOptions& options;
  Log& log;
  SafePoints& safe_points;

  TetInput input{};
  std::size_t input_tets = 0;  ///< of the input as it was read (rank 0)
  FieldResult field{};         ///< of stage field, then of stage repair
  RepairReport repair{};
  int attempt = 0;            ///< which setting is being tried (tries.hpp), on all ranks
  SeamlessResult seamless{};  ///< of stage seamless, made exact by stage quantize
  QuantizeResult quantization{};
  std::optional<MapQuantizer> quantizer{};  ///< of the exact map; where a stage needs it and it is empty, it is built
  IgmResult igm{};
  bool refined = false;  ///< stage igm has refined `field`, on rank 0
  HexMesh hexes{};
  DecomposeReport decomposition{};
  Culprits culprits{};
  nlohmann::ordered_json tries = nlohmann::ordered_json::array();  ///< those that failed (rank 0)
  std::string sentence{};           ///< the verdict when every stage has succeeded (rank 0)
  nlohmann::ordered_json report{};  ///< sections of report.json by the stages that made them (rank 0)
};

}  // namespace hexfield
