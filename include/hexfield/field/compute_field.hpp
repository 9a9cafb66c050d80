#pragma once

#include <mpi.h>

#include <cstdint>

#include "hexfield/base/control.hpp"
#include "hexfield/field/frame_field.hpp"
#include "hexfield/mesh/features.hpp"

namespace hexfield {

/// Parameters of stage 2. Defaults and sources: spec-lmff sections 1, 2 and 4.
struct FieldOptions {
  double normal_deviation_degrees = 70;    ///< a vertex whose feature normals differ more stays unconstrained
  double singular_face_edge_factor = 0.6;  ///< split singular faces' edges longer than this times the mean edge
  int max_singular_splits = 20000;
  int alignment_sweeps = 100;              ///< sweeps of Algorithm 1 before and after matchings are fixed
  int max_smoothing_iterations = 300;      ///< nonlinear iterations of the octahedral field
  int max_tet_smoothing_iterations = 200;  ///< nonlinear iterations of the field per tet, after the transfer
  int tet_smoothing_layers = 8;            ///< rings around singular edges where the field per tet is smoothed
  double smoothing_tolerance = 1e-4;       ///< relative decrease of the smoothness energy that ends them
};

/// Everything stage 2 makes; complete on rank 0, empty on the others.
struct FieldResult {
  TetMesh mesh;  ///< the input, pre-split and with singular faces refined; no tombstones
  Features features;
  FrameField field;
  EdgeCodes codes;
};

/// Stage 2: smooth feature-aligned octahedral field with fixed matchings. `mesh` and `features` are read
/// on rank 0; rank 0 holds the whole mesh, the solves and Algorithm 1 are distributed. Collective.
FieldResult compute_field(MPI_Comm comm, TetMesh mesh, Features features, const FieldOptions& options,
                          const Control& control);

}  // namespace hexfield
