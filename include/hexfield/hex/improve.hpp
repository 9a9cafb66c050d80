#pragma once

#include "hexfield/base/control.hpp"
#include "hexfield/hex/hex_mesh.hpp"
#include "hexfield/mesh/features.hpp"

namespace hexfield {

/// Parameters of stage 8. A sweep visits every active vertex once.
struct ImproveOptions {
  int max_rounds = 50;            ///< sweeps that raise the minimum
  int max_untangle_rounds = 200;  ///< sweeps around non-positive hexes, only while there are any
  int smoothing_rounds = 5;       ///< sweeps over all vertices before the minimum is raised
  double shape_weight = 0.1;      ///< of the mean ratio beside the inverse scaled Jacobian; keeps edges from collapsing
  double good_enough = 0.7;  ///< hexes of at least this scaled Jacobian are not worked on when the minimum is raised
  /// maximise_minimum() ends the stage while the minimum is below this: nearly what a singular curve of valence 3
  /// allows.
  double maximise_below = 0.86;
  int maximise_steps = 40;         ///< of it, per sharpness; 0: none
  double maximise_sharpness = 16;  ///< its first sharpness
  double maximise_gain = 1e-4;     ///< its smallest gain of a step
};

/// Stage 8: raises the minimum scaled Jacobian by moving vertices: boundary vertices slide on the input
/// surface of their colour, curve vertices on their curve, feature vertices stay. A positive hex never
/// becomes non-positive. The same bytes for any number of threads. Not collective.
///
/// Each vertex takes Newton steps on an energy of the corners it touches: the inverse scaled Jacobian to a
/// power that grows from sweep to sweep, so that the worst corner decides, and the mean ratio; determinants
/// are regularised as by Garanzha et al., Foldover-free maps in 50 lines of code (2021), until all are
/// positive. Vertices of one colour class share no hex and move at once. Then maximise_minimum() moves all at once.
/// Throws Error(stopped) at the end of a sweep when the control asks for it; `hexes` is then the iterate.
void improve_hex_mesh(HexMesh& hexes, const TetMesh& mesh, const Features& features, const ImproveOptions& options,
                      const Control& control);

/// The same with no surface to keep: every vertex may go anywhere. Used for local meshes of singular nodes.
void improve_free_hex_mesh(HexMesh& hexes, const ImproveOptions& options, const Control& control);

/// Parameters of maximise_minimum().
struct MaximiseOptions {
  /// Of the smooth minimum, per unit of scaled Jacobian; doubled while the smooth minimum is more than 0.25 too low.
  double first_sharpness = 16;
  double last_sharpness = 4096;  ///< doubled until here; the smooth minimum is then within log(corners) / 4096
  int steps = 40;                ///< at most, per sharpness
  double gain = 1e-5;            ///< steps that raise the smooth minimum by less end a sharpness
  bool free_boundary = true;  ///< false: boundary vertices and those of features stay where they are, on a shape, too
};
/// Maximises the smallest corner scaled Jacobian over all movable vertices at once (spec-sheets section 8): minimises
/// (1/p) log sum exp(-p SJ) for growing p by Gauss-Newton steps (the corners linear, the outer function exact) with
/// damping, each solved by conjugate gradients. Edges below a fifth of the length of those around count, too, so that
/// none collapses. All hexes must be positive; the minimum never falls. The same bytes for any number of threads. Not
/// collective. Throws Error(stopped) between steps; `hexes` is then the best so far.
void maximise_minimum(HexMesh& hexes, const MaximiseOptions& options, const Control& control);

/// The same on a shape: boundary vertices slide on the surface of their colour, curve vertices on their curve, feature
/// vertices stay, as in improve_hex_mesh(); sides come to cut no deeper through the shape than 1e-3 of its diagonal, or
/// than they did.
void maximise_minimum(HexMesh& hexes, const TetMesh& mesh, const Features& features, const MaximiseOptions& options,
                      const Control& control);

}  // namespace hexfield
