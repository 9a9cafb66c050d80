#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hexfield/field/compute_field.hpp"
#include "hexfield/hex/improve.hpp"
#include "hexfield/map/compute_map.hpp"
#include "hexfield/repair/repair_field.hpp"

namespace hexfield {

/// Everything that a run is told; the defaults are those of the program. Keys of the fields: option_table.hpp.
struct RunOptions {
  std::filesystem::path input;
  std::filesystem::path output;

  double target_hexes = 10000;  ///< wanted number of hexes
  double edge_length = 0;       ///< wanted edge length of the hexes in input units; wins over target_hexes when > 0
  double feature_angle = 70;    ///< degrees between face normals that make a feature where the input has no tags
  FieldOptions field;
  RepairOptions repair;
  SeamlessOptions seamless;
  std::string quantizer = "pump";  ///< how stage quantize finds integers: "pump", "ilp" or "rounding" (in stage igm)
  int min_layers = 1;              ///< hexes along every feature and singular arc, and between those that must not meet
  std::string fallback = "none";   ///< "rounding": round where the quantizer's integers cannot be reached
  double ilp_time_limit = 120;     ///< seconds of one integer program
  IgmOptions igm;
  ImproveOptions improve;
  bool decompose = false;  ///< pull the singular nodes of the hex mesh apart where that raises its quality

  std::string from;                            ///< compute this stage and all that follow again; empty: no such wish
  std::string to;                              ///< end after this stage; empty: after the last
  bool resume = false;                         ///< take finished stages from the checkpoint of the output directory
  int threads = 0;                             ///< per rank; 0: the cores that the launcher gave to the rank
  double time_limit = 0;                       ///< seconds after which the run ends at a safe point; 0: none
  double checkpoint_interval = 30;             ///< seconds between checkpoints inside a long solve
  int tries = 4;                               ///< settings of the repair to try before the run gives up
  int seed = 0;                                ///< of anything random
  bool check = false;                          ///< check every value between the stages
  std::vector<std::string> formats = {"vtk"};  ///< of the hex mesh; vtk is always written
};

}  // namespace hexfield
