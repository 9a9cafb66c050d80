#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "hexfield/base/control.hpp"
#include "hexfield/repair/meshability.hpp"
#include "hexfield/repair/repair_state.hpp"

namespace hexfield {

/// Parameters of stage 3. Defaults and sources: spec-lmff sections 5.7 and 10.
struct RepairOptions {
  int first_iterations = 8;      ///< iterations of Stage I: edges, nodes and constrained zipper nodes
  int second_rounds = 15;        ///< rounds of Stage II: free zipper nodes
  int patience = 3;              ///< rounds of Stage II without fewer defects that end it
  int inner_iterations = 6;      ///< relocations and remeshings per round of Stage II
  double alignment_weight = 10;  ///< of singular edges to the field, against the other energies of the relocation
  int post_remesh_rounds = 3;    ///< rounds of remeshing of the whole mesh at the end
  /// Work (RepairWatch::work) per tet of the input after which no more operations are begun; 0: no limit.
  int work_per_tet = 3000;
};

/// How many edges and vertices are not locally meshable, and the singular defects by kind.
struct DefectCounts {
  std::size_t edges = 0;
  std::size_t vertices = 0;
  std::map<std::string, std::size_t> kinds;
};

struct RepairReport {
  DefectCounts before, after;
  std::map<std::string, long> operations;  ///< done, by kind
  std::map<std::string, double> seconds;   ///< spent, by kind
  int iterations = 0;
  long work = 0;  ///< RepairWatch::work
};

/// What a repair has reached after some iterations; all it needs to go on.
struct RepairIterate {
  RepairState state;  ///< no tombstones
  RepairReport report;
  double compound_shrink = 1;  ///< weights that grow while defects of their kind stay
  double zipper_shrink = 1;
  VerdictMemory verdicts;   ///< on the one-rings of the last tests
  int stale_rounds = 0;     ///< rounds since there were fewest defects
  int fewest_defects = -1;  ///< negative: not counted yet
};

/// Safe points of the repair. Every member may be empty.
struct RepairControl {
  std::function<void(const std::string& what, double fraction)> progress;
  std::function<bool()> stop_requested;                  ///< asked from any thread, between small operations
  std::function<void(const RepairIterate&)> checkpoint;  ///< after every iteration
};

struct RepairResult {
  FieldResult field;
  RepairReport report;
};

/// Start of a repair: target lengths from the edges of the mesh, defects counted. Throws Error(stopped).
RepairIterate start_repair(FieldResult smooth, const RepairControl& control = {});

/// Stage 3: turns a smooth field into one that is locally meshable wherever it can (Liu and Bommes 2023, sections 4
/// and 5; spec-lmff section 5.7), on a refined mesh. Goes on from `iterate`. `input` is the mesh with features whose
/// surface and curves the result must keep. The result is the same for any number of threads. Where the work is spent
/// before the field is meshable, the result is what was reached. Throws Error(stopped)
/// when control.stop_requested() says so. Not collective: one rank holds the whole mesh.
RepairResult repair_field(RepairIterate iterate, const FieldResult& input, const RepairOptions& options,
                          const RepairControl& control);

}  // namespace hexfield
