#pragma once

#include <string>

#include "hexfield/mesh/surface.hpp"
#include "hexfield/repair/repair_field.hpp"

namespace hexfield {

/// One repair under way: the steps of spec-lmff section 5.7 on an iterate, with their times and counts.
class Schedule {
 public:
  Schedule(RepairIterate& iterate, const FieldResult& input, const RepairOptions& options,
           const RepairControl& control);

  /// Edges, nodes and zipper nodes on features (Stage I).
  void repair_edges_and_vertices(bool first_stage);
  /// Free zipper nodes (Stage II).
  void repair_zippers();
  /// The mesh near arcs gets better, arcs move to where the field wants them, and the field near them follows the
  /// features only.
  void relocate();
  /// True when every special edge and every vertex of one is meshable; notes whether there is progress.
  bool meshable();
  /// Codes of one sign along every arc, special edges apart, all frames aligned.
  void finish();
  /// Offers the iterate for a checkpoint and hears wishes to stop: throws Error(stopped).
  void end_iteration();

 private:
  // Runs `work` and adds its seconds, and the number it returns, to the report.
  template <class Work>
  void timed(const std::string& kind, const Work& work);
  void isolate();
  void note_progress(int defects);
  void free_ends();
  void align_everywhere();

  RepairIterate& iterate_;
  RepairState& state_;
  const RepairOptions& options_;
  const RepairControl& control_;
  ClosestSurface surface_;
  ClosestCurve curves_;
  double volume_ = 0;
};

}  // namespace hexfield
