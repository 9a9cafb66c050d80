#pragma once

#include <functional>
#include <vector>

#include "hexfield/mesh/surface.hpp"
#include "hexfield/repair/relocation_energy.hpp"
#include "hexfield/repair/repair_state.hpp"

namespace hexfield {

/// Weights of Liu and Bommes 2023, section 5.3, with the values of spec-lmff section 6; none has a unit. All but the
/// shape weights are divided by a tenth of the edge of a cube of the volume of the mesh.
struct RelocationOptions {
  double alignment = 10;         ///< w_a: singular edges along the field
  double compound_shrink = 1;    ///< w_s of compound edges off feature faces
  double zipper_shrink = 1;      ///< w_s of the two edges at zipper nodes off feature faces
  double curvature = 1;          ///< w_c: straight arcs
  double repulsion = 0.1;        ///< w_r: arcs of one unzipping keep a target length apart
  double tet_shape = 0.001;      ///< w_d; ten times that around repelled vertices
  double triangle_shape = 0.05;  ///< the same for feature triangles
  int max_iterations = 10;       ///< Newton steps
  double tolerance = 1e-4;       ///< relative decrease of the energy that ends them
  double volume = 0;             ///< of the whole mesh; 0: that of the state
  /// Says which vertices may move; empty: all. A vertex may move only if all its tets may change.
  std::function<bool(VertexId)> may_move;
};

struct RelocationReport {
  NewtonDescent newton;
  int vertices = 0;            ///< singular vertices that were free to move
  int shortened = 0;           ///< of them moved less than wished, so that no tet or feature triangle turns over
  int restored = 0;            ///< of them did not move at all for that reason
  std::vector<TetId> touched;  ///< tets with a vertex that moved, ascending: to be smoothed, codes to be updated
};

/// Moves the singular vertices so that arcs follow the field and get straight, compound edges and edges at zipper
/// nodes shrink, and arcs of one pair repel each other; all other vertices stay. Feature points stay, vertices of
/// feature curves move along them (only those that an arc inside the mesh meets), vertices of feature surfaces in
/// them: first tangentially, then projected to the surfaces and curves of the input. Every displacement is
/// shortened until its tets are positive. Frames of tets at feature faces and edges are turned onto their new
/// directions with the labels they had. Codes stay as they are: the caller updates them after smoothing.
/// Costs what the singular edges and their tets cost (and the volume, unless given). Not collective.
RelocationReport relocate_singularities(RepairState& state, const ClosestSurface& original_surface,
                                        const ClosestCurve& original_curves, const RelocationOptions& options = {});

}  // namespace hexfield
